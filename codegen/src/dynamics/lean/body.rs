//! A link's inertial parameters in the form that is computed with.

use crate::dynamics::inertia::{LinkParameters, Turn};
use crate::dynamics::vector::{self, Matrix, Vector};
use crate::expr::{Dag, ExprId};

/// What the second moments of a body are written as.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Form {
    /// `I = int (r . r) 1 - r r^T dm`, as parameters give it.
    Inertia,
    /// `S = int r r^T dm = tr(I)/2 1 - I`: fewer products, but an argument of the function has to be rewritten first.
    SecondMoments,
}

/// Mass, first moments and second moments about the origin of a link's frame.
#[derive(Clone, Copy)]
pub struct Body {
    pub mass: ExprId,
    pub first: Vector,
    /// Symmetric.
    pub second: Matrix,
    pub form: Form,
}

impl Body {
    /// `along` is the axis whose entry gets the fewest operations.
    pub fn new(dag: &mut Dag, link: &LinkParameters, form: Form, along: usize) -> Self {
        let &[mass, mx, my, mz, xx, xy, xz, yy, yz, zz] = link;
        let second = match form {
            Form::Inertia => [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]],
            Form::SecondMoments => {
                let [xy, xz, yz] = [xy, xz, yz].map(|x| dag.neg(x));
                let [xx, yy, zz] = squares(dag, [xx, yy, zz], along);
                [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]
            }
        };
        Self {
            mass,
            first: [mx, my, mz],
            second,
            form,
        }
    }

    /// The ten parameters of a body that is written with its inertia.
    pub fn parameters(&self) -> LinkParameters {
        debug_assert_eq!(self.form, Form::Inertia);
        let [mx, my, mz] = self.first;
        let [[xx, xy, xz], [_, yy, yz], [_, _, zz]] = self.second;
        [self.mass, mx, my, mz, xx, xy, xz, yy, yz, zz]
    }

    /// With two more masses on an axis of the frame, whose second moment is `moment`.
    pub fn add_dumbbell(&mut self, dag: &mut Dag, axis: usize, moment: ExprId) {
        for k in 0..3 {
            let feels = match self.form {
                Form::SecondMoments => k == axis,
                Form::Inertia => k != axis,
            };
            if feels {
                self.second[k][k] = dag.add(self.second[k][k], moment);
            }
        }
    }

    /// With a mass more at `r`.
    pub fn add_mass(&mut self, dag: &mut Dag, mass: ExprId, r: Vector) {
        let moment = vector::scale(dag, mass, r);
        self.mass = dag.add(self.mass, mass);
        self.first = vector::add(dag, self.first, moment);
        self.add_second(dag, moment, r);
    }

    /// With two more masses of opposite sign along an axis of the frame, at `r`: their first moment is `moment`.
    pub fn add_dipole(&mut self, dag: &mut Dag, moment: Vector, r: Vector) {
        self.first = vector::add(dag, self.first, moment);
        let twice = r.map(|x| dag.scale(2.0, x));
        self.add_second(dag, moment, twice);
    }

    /// Adds the symmetric part of `a b^T` to the second moments.
    fn add_second(&mut self, dag: &mut Dag, a: Vector, b: Vector) {
        let p = symmetric_product(dag, a, b);
        for i in 0..3 {
            for j in 0..3 {
                let more = match self.form {
                    Form::SecondMoments => p[i][j],
                    Form::Inertia if i == j => {
                        dag.add(p[(i + 1) % 3][(i + 1) % 3], p[(i + 2) % 3][(i + 2) % 3])
                    }
                    Form::Inertia => dag.neg(p[i][j]),
                };
                self.second[i][j] = dag.add(self.second[i][j], more);
            }
        }
    }

    /// About another point; masses are at `r + t` from it.
    ///
    /// With `s` the sum of the old first moments and the new ones, `P = (s t^T + t s^T) / 2`: `S' = S + P` and
    /// `I' = I + tr(P) 1 - P`.
    pub fn seen_from(&self, dag: &mut Dag, t: Vector) -> Self {
        let shift = vector::scale(dag, self.mass, t);
        let first = vector::add(dag, self.first, shift);
        let s = vector::add(dag, self.first, first);
        let mut moved = Self { first, ..*self };
        moved.add_second(dag, s, t);
        moved
    }

    /// In the axes of the parent.
    pub fn turned(&self, dag: &mut Dag, rotation: &Matrix, turn: &Turn) -> Self {
        Self {
            first: vector::apply(dag, rotation, self.first),
            second: turn.matrix(dag, &self.second),
            ..*self
        }
    }
}

/// `(a b^T + b a^T) / 2`
fn symmetric_product(dag: &mut Dag, a: Vector, b: Vector) -> Matrix {
    let halves = b.map(|x| dag.scale(0.5, x));
    std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            let (left, right) = (dag.mul(a[i], halves[j]), dag.mul(halves[i], a[j]));
            dag.add(left, right)
        })
    })
}

/// The diagonal of `S` from that of `I`: `S_ii + S_kk = I_jj` and so on, around.
fn squares(dag: &mut Dag, inertia: [ExprId; 3], along: usize) -> [ExprId; 3] {
    let (mut i, mut j, k) = ((along + 1) % 3, (along + 2) % 3, along);
    if dag.is_zero(inertia[i]) {
        // Then S_kk below is -S_ii.
        (i, j) = (j, i);
    }
    let mut squares = inertia;
    let others = dag.add(inertia[j], inertia[k]);
    let difference = dag.sub(others, inertia[i]);
    squares[i] = dag.scale(0.5, difference);
    squares[j] = dag.sub(inertia[k], squares[i]);
    squares[k] = dag.sub(inertia[j], squares[i]);
    squares
}
