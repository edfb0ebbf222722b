//! Arms without accelerations.

use super::{Arm, Entry};
use crate::motion::Motion;

/// An arm whose torque is known without accelerations, as `tau = d/dt (momentum columns) - (drift columns)`.
///
/// Both sets of columns belong to [`Columns::unknowns`](super::Columns::unknowns) of the arm. They read [`Motion`] without `ddq`, which may have no
/// channels.
///
/// # Examples
/// A pendulum, `tau = d/dt (izz dq) + mx sin(q) + fv dq`, at 2 rad/s:
/// ```
/// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
/// use robot_model::columns::{Columns, MomentumArm};
/// let (arm, motion) = (pendulum::pendulum(), pendulum::swinging());
/// assert_eq!((arm.unknowns()[0].name.as_str(), arm.momentum(&motion, &[])[0].column), ("link.izz", 0));
/// ```
pub trait MomentumArm: Arm {
    /// Columns of the generalized momentum, `Y_p`; entries that are zero by structure are left out.
    ///
    /// # Examples
    /// ```
    /// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
    /// use robot_model::columns::MomentumArm;
    /// // Of izz: dq.
    /// let columns = pendulum::pendulum().momentum(&pendulum::swinging(), &[]);
    /// assert_eq!((columns.len(), columns[0].values[0]), (1, 2.0));
    /// ```
    fn momentum(&self, motion: &Motion, shapes: &[f64]) -> Vec<Entry>;

    /// Columns of what changes the momentum beside the torque, `Y_h`: for a rigid body `C^T dq - G`.
    ///
    /// # Examples
    /// ```
    /// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
    /// use robot_model::columns::MomentumArm;
    /// // Of mx: -sin(q); of fv: -dq.
    /// let columns = pendulum::pendulum().drift(&pendulum::swinging(), &[]);
    /// assert_eq!(columns.iter().map(|entry| entry.values[0]).collect::<Vec<_>>(), [-0.5_f64.sin(), -2.0]);
    /// ```
    fn drift(&self, motion: &Motion, shapes: &[f64]) -> Vec<Entry>;

    /// Momentum of the parameters that the spec fixes, `[joint][sample]`; zeros where it fixes none. `shapes` as in
    /// [`Columns::entries`](super::Columns::entries).
    ///
    /// # Examples
    /// ```
    /// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
    /// use robot_model::columns::MomentumArm;
    /// // Its spec fixes nothing.
    /// assert_eq!(pendulum::pendulum().known_momentum(&pendulum::swinging(), &[]), [[0.0]]);
    /// ```
    fn known_momentum(&self, motion: &Motion, shapes: &[f64]) -> Vec<Vec<f64>>;

    /// Drift of the parameters that the spec fixes, `[joint][sample]`; zeros where it fixes none.
    ///
    /// # Examples
    /// ```
    /// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
    /// use robot_model::columns::MomentumArm;
    /// assert_eq!(pendulum::pendulum().known_drift(&pendulum::swinging(), &[]), [[0.0]]);
    /// ```
    fn known_drift(&self, motion: &Motion, shapes: &[f64]) -> Vec<Vec<f64>>;
}
