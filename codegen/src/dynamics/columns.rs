//! The regressor of a chain, link by link: what a unit of each inertial parameter takes of the joints.
//!
//! In: a [`Chain`]. Out: [`Columns`]. The wrench of a column is carried inward from joint to joint, the axes of the joints outward
//! from link to link, and both meet on the way ([`search`]). Three columns of a link may fall out, since a mass on a joint's
//! axis moves with the parent as well as with the link: its columns are those of the parent, and the joint itself feels
//! nothing of it.

mod search;

use super::chain::Chain;
use super::frame::{Frame, MainAxis};
use super::lean::{Body, Choice, Form, LeanChain};
use super::rigid::Terms;
use super::twist::{self, Twist};
use super::vector::{self, Vector};
use crate::expr::{Dag, ExprId};

/// `[element][joint]` of a link: the torque of each joint per unit of each inertial parameter.
pub type Columns = [Vec<ExprId>; 10];

/// Force and moment about the origin of a frame.
pub type Wrench = (Vector, Vector);

/// Numbers for the ten parameters, in the order of `InertialElement::ALL`.
type Numbers = [f64; 10];

const M: usize = 0;
/// The first moment along each axis.
const FIRST: [usize; 3] = [1, 2, 3];
/// The inertia, `[row][column]`.
const SECOND: [[usize; 3]; 3] = [[4, 5, 6], [5, 7, 8], [6, 8, 9]];

/// How columns are found; all ways have the same values.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Way {
    /// Whether three columns of a link are put together from the parent's.
    pub from_parents: bool,
    /// Per link where the wrenches of its columns meet the axes of the joints that are still to come.
    pub meets: Vec<Meet>,
}

/// Where wrenches, on their way to the base, meet axes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Meet {
    /// In the frame of this link, the columns' own or one before it.
    pub link: usize,
    /// About the point of its joint, and not about its origin.
    pub at_joint: bool,
}

/// `tau = sum over links and elements of columns[link][element] * parameter`. Columns of `wanted` links and elements are
/// found rather than put together from others.
pub fn columns(
    dag: &mut Dag,
    chain: &Chain,
    way: &Way,
    wanted: &dyn Fn(usize, usize) -> bool,
) -> Vec<Columns> {
    let mut lean = LeanChain::new(dag, chain, &Choice::plain(chain.frames.len()));
    lean.slide_joint_points(dag);
    let motions = lean.forward(dag, Terms::All);
    let twists = twist::of_links(dag, &lean.frames);
    let inward = Inward {
        frames: &lean.frames,
        twists: &twists,
    };
    let mut columns: Vec<Columns> = Vec::with_capacity(motions.len());
    for (link, (motion, &meet)) in motions.iter().zip(&way.meets).enumerate() {
        let on_axis = OnAxis::of(dag, &chain.frames[link], |element| wanted(link, element))
            .filter(|_| way.from_parents);
        let zero = dag.zero();
        let mut own: Columns = std::array::from_fn(|_| vec![zero; motions.len()]);
        let together = columns.last().zip(on_axis);
        let pivots = together
            .as_ref()
            .map_or([usize::MAX; 3], |(_, on_axis)| on_axis.pivots);
        for element in (0..10).filter(|element| !pivots.contains(element)) {
            let body = unit(dag, element);
            let wrench = motion.wrench(dag, &body);
            inward.carry(dag, link, meet, wrench, &mut own[element]);
        }
        if let Some((_, on_axis)) = &together
            && link > meet.link
        {
            let [along, across, other] = on_axis.squares;
            let frame = &lean.frames[link];
            // The wrench of `along` and that of `across` are together that of a dumbbell, which has fewer terms to turn.
            let body = dumbbell(dag, other);
            let wrench = motion.wrench(dag, &body);
            let (_, dumbbell) = frame.transmit(dag, wrench);
            let body = unit(dag, SECOND[along][along]);
            let wrench = motion.wrench(dag, &body);
            let (_, along) = frame.transmit(dag, wrench);
            let handed = (dumbbell.0, vector::sub(dag, dumbbell.1, along.1));
            let column = &mut own[SECOND[across][across]];
            inward.carry(dag, link - 1, meet, handed, column);
        }
        if let Some((parent, on_axis)) = &together {
            on_axis.complete(dag, parent, &mut own, link);
        }
        columns.push(own);
    }
    columns
}

/// The way of wrenches to the base.
struct Inward<'a> {
    frames: &'a [Frame],
    /// Per link those of the joints up to its own.
    twists: &'a [Vec<Twist>],
}

impl Inward<'_> {
    /// Carries the wrench of a column from the link of `joint` to where it meets the axes of the joints before.
    fn carry(
        &self,
        dag: &mut Dag,
        joint: usize,
        meet: Meet,
        mut wrench: Wrench,
        column: &mut [ExprId],
    ) {
        for joint in (meet.link + 1..=joint).rev() {
            (column[joint], wrench) = self.frames[joint].transmit(dag, wrench);
        }
        let to_origin = self.frames[meet.link].to_origin;
        if meet.at_joint {
            let lever = vector::cross(dag, to_origin, wrench.0);
            wrench.1 = vector::add(dag, wrench.1, lever);
        }
        for (entry, twist) in column.iter_mut().zip(&self.twists[meet.link]) {
            *entry = if meet.at_joint {
                twist.power(dag, &wrench)
            } else {
                twist.at_origin(dag, to_origin).power(dag, &wrench)
            };
        }
    }
}

/// A body of one parameter.
fn unit(dag: &mut Dag, element: usize) -> Body {
    let mut unit = [dag.zero(); 10];
    unit[element] = dag.constant(1.0);
    Body::new(dag, &unit, Form::Inertia, 0)
}

/// Two masses on an axis of the frame, with the second moment 1 about the origin.
fn dumbbell(dag: &mut Dag, axis: usize) -> Body {
    let nothing = [dag.zero(); 10];
    let mut body = Body::new(dag, &nothing, Form::SecondMoments, 0);
    let one = dag.constant(1.0);
    body.add_dumbbell(dag, axis, one);
    body
}

/// Three bodies on a joint's axis, each as parameters of the link and of its parent, and the parameter of the link whose
/// column it gives. In the order in which they do.
struct OnAxis {
    /// The axis, and across it the one whose inertia is carried and the one whose inertia is a pivot.
    squares: [usize; 3],
    pivots: [usize; 3],
    in_link: [Numbers; 3],
    in_parent: [Numbers; 3],
}

impl OnAxis {
    /// `None` where the axis is none of the link's frame, or no axis.
    fn of(dag: &Dag, frame: &Frame, wanted: impl Fn(usize) -> bool) -> Option<Self> {
        let MainAxis { link: k, .. } = frame.main_axis(dag)?;
        let numbers = |v: Vector| -> Option<[f64; 3]> {
            let [x, y, z] = v.map(|x| dag.as_constant(x));
            Some([x?, y?, z?])
        };
        let (axis, parent_axis) = (numbers(frame.axis)?, numbers(frame.axis_in_parent)?);
        let to_origin = numbers(frame.to_origin)?;
        let joint_point = numbers(frame.joint_point)?;
        // The point of the axis next to the link's origin, from both origins.
        let along = to_origin[k] * axis[k];
        let point = std::array::from_fn(|x| if x == k { 0.0 } else { 0.0 - to_origin[x] });
        let in_parent = std::array::from_fn(|x| joint_point[x] + along * parent_axis[x]);
        let (mut across, mut other) = ((k + 1) % 3, (k + 2) % 3);
        if wanted(SECOND[other][other]) && !wanted(SECOND[across][across]) {
            std::mem::swap(&mut across, &mut other);
        }
        let reversed = |[first, second, third]: [Numbers; 3]| [third, second, first];
        Some(Self {
            squares: [k, across, other],
            pivots: [SECOND[other][other], FIRST[k], M],
            in_link: reversed(masses_on_line(point, axis)),
            in_parent: reversed(masses_on_line(in_parent, parent_axis)),
        })
    }

    /// `sum of in_link * own = sum of in_parent * parent`, solved for the pivots. The row of the joint itself has zeros on the
    /// right: the parent's columns end before it.
    fn complete(&self, dag: &mut Dag, parent: &Columns, own: &mut Columns, link: usize) {
        let bodies = self.in_link.iter().zip(&self.in_parent);
        for (&pivot, (in_link, in_parent)) in self.pivots.iter().zip(bodies) {
            for joint in 0..=link {
                let whole = combined(dag, in_parent, parent, joint, usize::MAX);
                let others = combined(dag, in_link, own, joint, pivot);
                let left = dag.sub(whole, others);
                own[pivot][joint] = dag.scale(in_link[pivot].recip(), left);
            }
        }
    }
}

/// A unit mass at `p`, and how its parameters change along the direction `u`: `mass(p + s u) = [0] + s [1] + s^2 [2]`.
fn masses_on_line(p: [f64; 3], u: [f64; 3]) -> [Numbers; 3] {
    let mut masses = [[0.0; 10]; 3];
    masses[0][M] = 1.0;
    for k in 0..3 {
        masses[0][FIRST[k]] = p[k];
        masses[1][FIRST[k]] = u[k];
    }
    // (r . r) 1 - r r^T with r = p + s u.
    let dot = |x: [f64; 3], y: [f64; 3]| x.iter().zip(y).map(|(x, y)| x * y).sum::<f64>();
    for a in 0..3 {
        for b in a..3 {
            let entry = |x: [f64; 3], y: [f64; 3]| {
                let on_diagonal = if a == b { dot(x, y) } else { 0.0 };
                on_diagonal - f64::midpoint(x[a] * y[b], x[b] * y[a])
            };
            masses[0][SECOND[a][b]] = entry(p, p);
            masses[1][SECOND[a][b]] = 2.0 * entry(p, u);
            masses[2][SECOND[a][b]] = entry(u, u);
        }
    }
    masses
}

/// `sum of factors[element] * columns[element][joint]` without one element.
fn combined(
    dag: &mut Dag,
    factors: &Numbers,
    columns: &Columns,
    joint: usize,
    without: usize,
) -> ExprId {
    let elements = (0..10).filter(|&element| element != without);
    let terms: Vec<ExprId> = elements
        .map(|element| dag.scale(factors[element], columns[element][joint]))
        .collect();
    dag.sum(terms)
}
