//! What the design needs of a model: values along a motion, and how they change with it.

use crate::motion::Kinematics;

/// Numbers that follow from a motion at each instant: entries of a regressor, torques, places of points.
///
/// # Examples
/// A height, with a [`Clearance`](super::Clearance) that is made of it:
/// ```
#[doc = include_str!("../../tests/doc/room.rs")]
///
/// let motion = Kinematics { q: vec![vec![0.0, 1.0]], dq: vec![vec![0.0; 2]], ddq: vec![vec![0.0; 2]] };
/// assert_eq!((Height.outputs(), Height.values(&motion)[0][0]), (1, 0.0));
/// // The slope of 3 h at the first instant, of h at the second.
/// let slopes = Height.pullback(&motion, &[vec![3.0, 1.0]]);
/// assert!((slopes.q[0][0] - 1.5).abs() < 1e-12 && (slopes.q[0][1] - 0.5 * 1.0_f64.cos()).abs() < 1e-12);
/// ```
pub trait Function: Sync {
    /// How many numbers an instant has.
    fn outputs(&self) -> usize;

    /// `[output][sample]` along a motion.
    fn values(&self, motion: &Kinematics) -> Vec<Vec<f64>>;

    /// The exact slopes of `sum over outputs and samples of weights * values` by every position, velocity and acceleration;
    /// `weights[output][sample]`.
    fn pullback(&self, motion: &Kinematics, weights: &[Vec<f64>]) -> Kinematics;
}

/// A regressor whose entries are a [`Function`].
pub struct Regressor {
    /// Names of the columns.
    pub columns: Vec<String>,
    /// `(joint, column)` of each output.
    pub entries: Vec<(usize, usize)>,
    /// The entries, smooth: what a search follows.
    pub function: Box<dyn Function>,
    /// The entries with friction that jumps: what a motion is worth.
    pub exact: Box<dyn Function>,
}

impl std::fmt::Debug for Regressor {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Regressor")
            .field("columns", &self.columns)
            .finish_non_exhaustive()
    }
}

/// `sum += other`
pub(super) fn add(sum: &mut Kinematics, other: &Kinematics) {
    let pairs = [
        (&mut sum.q, &other.q),
        (&mut sum.dq, &other.dq),
        (&mut sum.ddq, &other.ddq),
    ];
    for (sum, other) in pairs {
        for (sum, other) in sum.iter_mut().zip(other) {
            sum.iter_mut().zip(other).for_each(|(s, x)| *s += x);
        }
    }
}
