//! Euler-Lagrange in numbers: energies evaluated as they are written, on numbers that carry their derivatives.

use nalgebra::DMatrix;
use robot_model_spec::model::{Energies, Function};
use robot_model_spec::polynomial::{Polynomial, Ring, expand_energies};

use super::jet::{E1, E2, Jet};
use crate::states::State;

/// A robot that says its energies.
#[derive(Debug, Clone, Copy)]
pub struct EnergyTwin<'a> {
    energies: &'a Energies,
}

/// Coordinates and rates with infinitesimals in the directions that are asked for.
struct Point {
    q: Vec<Jet>,
    dq: Vec<Jet>,
}

impl<'a> EnergyTwin<'a> {
    /// The twin of these energies.
    #[must_use]
    pub fn new(energies: &'a Energies) -> Self {
        Self { energies }
    }

    /// `(T, V)`; `standard` has one value per product of parameters.
    fn evaluate(self, standard: &[f64], mut point: Point) -> (Jet, Jet) {
        expand(self.energies, &mut point, standard)
    }

    /// `d/dt dT/d(dq_i) - dL/dq_i`
    #[must_use]
    pub fn torque(self, standard: &[f64], state: &State) -> Vec<f64> {
        (0..state.q.len())
            .map(|i| {
                let mut moving = point(state);
                for j in 0..state.q.len() {
                    moving.q[j] = moving.q[j].plus(E2, state.dq[j]);
                    moving.dq[j] = moving.dq[j].plus(E2, state.ddq[j]);
                }
                moving.dq[i] = moving.dq[i].plus(E1, 1.0);
                let momentum_rate = self.evaluate(standard, moving).0.0[E1 | E2];
                let mut displaced = point(state);
                displaced.q[i] = displaced.q[i].plus(E1, 1.0);
                let (kinetic, potential) = self.evaluate(standard, displaced);
                momentum_rate - kinetic.0[E1] + potential.0[E1]
            })
            .collect()
    }

    /// Second derivatives of `T` in the rates.
    #[must_use]
    pub fn mass_matrix(self, standard: &[f64], state: &State) -> DMatrix<f64> {
        let dof = state.q.len();
        DMatrix::from_fn(dof, dof, |i, j| {
            let mut point = point(state);
            point.dq[i] = point.dq[i].plus(E1, 1.0);
            point.dq[j] = point.dq[j].plus(E2, 1.0);
            self.evaluate(standard, point).0.0[E1 | E2]
        })
    }

    /// `V`, J.
    #[must_use]
    pub fn potential_energy(self, standard: &[f64], state: &State) -> f64 {
        self.evaluate(standard, point(state)).1.0[0]
    }
}

fn point(state: &State) -> Point {
    let jets = |values: &[f64]| values.iter().map(|x| Jet::number(*x)).collect();
    Point {
        q: jets(&state.q),
        dq: jets(&state.dq),
    }
}

fn expand(energies: &Energies, point: &mut Point, standard: &[f64]) -> (Jet, Jet) {
    let expanded = expand_energies(point, energies).expect("checked");
    let sum = |energy: &Polynomial<Jet>| {
        let terms = energies.monomials.iter().zip(standard);
        terms
            .filter_map(|(monomial, value)| {
                Some(energy.get(monomial).copied()? * Jet::number(*value))
            })
            .fold(Jet::number(0.0), |sum, term| sum + term)
    };
    (sum(&expanded.kinetic), sum(&expanded.potential))
}

/// `e3` is the direction of time: a coordinate is `q + dq e3`, so that the slope of `e3` is a rate.
impl Ring for Point {
    type Element = Jet;

    fn number(&mut self, value: f64) -> Jet {
        Jet::number(value)
    }

    fn as_number(&self, x: &Jet) -> Option<f64> {
        x.0[1..].iter().all(|x| *x == 0.0).then_some(x.0[0])
    }

    fn coordinate(&mut self, joint: usize) -> Jet {
        self.q[joint] + self.dq[joint].times_e3()
    }

    fn rate(&mut self, joint: usize) -> Jet {
        self.dq[joint]
    }

    fn add(&mut self, x: &Jet, y: &Jet) -> Jet {
        *x + *y
    }

    fn mul(&mut self, x: &Jet, y: &Jet) -> Jet {
        *x * *y
    }

    fn power(&mut self, x: &Jet, y: &Jet) -> Option<Jet> {
        Some(x.power(self.as_number(y)?))
    }

    fn call(&mut self, function: Function, x: &Jet) -> Option<Jet> {
        Some(x.call(function))
    }

    fn derivative(&mut self, x: &Jet) -> Option<Jet> {
        Some(x.slope_of_e3())
    }

    fn is_zero(&self, x: &Jet) -> bool {
        x.0.iter().all(|x| *x == 0.0)
    }
}
