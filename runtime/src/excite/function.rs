//! What the design needs of a model: values along a motion, and how they change with it.

use crate::motion::Kinematics;

/// Numbers that follow from a motion at each instant: entries of a regressor, torques, places of points.
///
/// # Examples
/// A height, with a [`Clearance`](super::Clearance) that is made of it:
/// ```
#[doc = include_str!("../../tests/doc/room.rs")]
///
/// // One height at each of two instants.
/// assert_eq!((Height.outputs(), Height.values(&raised())[0].len()), (1, 2));
/// ```
pub trait Function: Sync {
    /// How many numbers an instant has.
    ///
    /// # Examples
    /// ```
    /// # mod room { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/room.rs")); }
    /// use robot_model::excite::Function;
    /// assert_eq!(room::Height.outputs(), 1);
    /// ```
    fn outputs(&self) -> usize;

    /// `[output][sample]` along a motion.
    ///
    /// # Examples
    /// ```
    /// # mod room { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/room.rs")); }
    /// use robot_model::excite::Function;
    /// // 0.5 sin(q) at 0 and 1 rad.
    /// assert_eq!(room::Height.values(&room::raised()), [[0.0, 0.5 * 1.0_f64.sin()]]);
    /// ```
    fn values(&self, motion: &Kinematics) -> Vec<Vec<f64>>;

    /// The exact slopes of `sum over outputs and samples of weights * values` by every position, velocity and acceleration;
    /// `weights[output][sample]`.
    ///
    /// # Examples
    /// ```
    /// # mod room { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/room.rs")); }
    /// use robot_model::excite::Function;
    /// // The slope of 3 h at the first instant, of h at the second; velocities do not count.
    /// let slopes = room::Height.pullback(&room::raised(), &[vec![3.0, 1.0]]);
    /// assert!((slopes.q[0][0] - 1.5).abs() < 1e-12 && (slopes.q[0][1] - 0.5 * 1.0_f64.cos()).abs() < 1e-12);
    /// assert_eq!(slopes.dq, [[0.0, 0.0]]);
    /// ```
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
