//! Where an arm is: poses and Jacobians of its links, or of the points that it names.

use crate::model::{SMatrix, SVector};
use crate::scalar::Scalar;

/// Where the links of a chain are. Robots that say their energies have [`Points`] instead. Lengths are in the equations; of the
/// value only shape parameters count, such as the offset of an encoder.
pub trait Kinematics<const DOF: usize> {
    /// Poses of the link frames in the base frame as homogeneous matrices, m; the last one is the tip's.
    ///
    /// # Examples
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
    /// use robot_model::{Kinematics, Vector};
    /// use std::f64::consts::FRAC_PI_2;
    /// // Links of 0.5 m and 0.4 m: the upper one along x, the other one up.
    /// let [elbow, tip] = arms::two_link().forward_kinematics(&Vector::from([0.0, FRAC_PI_2]));
    /// assert!((elbow[(0, 3)] - 0.5).abs() < 1e-12);
    /// assert!((tip[(0, 3)] - 0.5).abs() < 1e-12 && (tip[(1, 3)] - 0.4).abs() < 1e-12);
    /// ```
    fn forward_kinematics<S: Scalar>(&self, q: &SVector<S, DOF>) -> [SMatrix<S, 4, 4>; DOF];

    /// Geometric Jacobian, 6 x DOF: `jacobian * dq` is the velocity of the origin of the last link's frame, m/s, then the
    /// link's angular velocity, rad/s, both in the axes of the base frame. A force and a moment at the tip, stacked alike,
    /// load the joints with `jacobian^T * wrench`.
    ///
    /// # Examples
    /// A force at the tip, and what the joints hold it with:
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
    /// use robot_model::{Kinematics, Vector};
    /// // Stretched along x, 5 N upward at 0.9 m from the shoulder, 0.4 m from the elbow.
    /// let jacobian = arms::two_link().jacobian(&Vector::from([0.0, 0.0]));
    /// let torque = jacobian.transpose() * Vector::from([0.0, 5.0, 0.0, 0.0, 0.0, 0.0]);
    /// assert!((torque - Vector::from([5.0 * 0.9, 5.0 * 0.4])).norm() < 1e-12);
    /// ```
    fn jacobian<S: Scalar>(&self, q: &SVector<S, DOF>) -> SMatrix<S, 6, DOF>;
}

/// Where the points are that a robot which says its energies names.
///
/// # Examples
#[cfg_attr(feature = "derive", doc = "```")]
#[cfg_attr(not(feature = "derive"), doc = "```ignore")]
/// use robot_model::{Points, RobotModel, Vector};
///
/// #[derive(Clone, Copy, RobotModel)]
/// #[robot(file = "tests/doc/swing.robot")] // two rods of 0.5 m, y up, `point tip = [x, y, 0]`
/// struct Swing { m: f64 }
///
/// assert_eq!(Swing::POINTS, ["tip"]);
/// let (arm, q) = (Swing { m: 2.0 }, Vector::from([0.0, std::f64::consts::FRAC_PI_2]));
/// // Rates of a place are its Jacobian times the rates of the coordinates.
/// let (dq, step) = (Vector::from([0.4, -0.7]), 1e-6);
/// let [[before], [after]] = [q - dq * step, q + dq * step].map(|q| arm.points(&q));
/// let [jacobian] = arm.point_jacobians(&q);
/// assert!(((after - before) / (2.0 * step) - jacobian * dq).norm() < 1e-8);
/// ```
pub trait Points<const DOF: usize, const POINTS: usize> {
    /// Their names.
    const POINTS: [&'static str; POINTS];

    /// Positions in the base frame, m.
    ///
    /// # Examples
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod swing { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/swing.rs")); }
    /// use robot_model::{Points, Vector};
    /// // The upper rod hangs down, the lower one lies along x.
    /// let [tip] = swing::SWING.points(&Vector::from([0.0, std::f64::consts::FRAC_PI_2]));
    /// assert!((tip - Vector::from([0.5, -0.5, 0.0])).norm() < 1e-12);
    /// ```
    fn points<S: Scalar>(&self, q: &SVector<S, DOF>) -> [SVector<S, 3>; POINTS];

    /// `[k] * dq` is the velocity of point `k`, m/s; a force there loads the joints with `[k]^T * force`.
    ///
    /// # Examples
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod swing { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/swing.rs")); }
    /// use robot_model::{Points, Vector};
    /// // There 3 N downward at the tip load both joints at a lever of 0.5 m.
    /// let [jacobian] = swing::SWING.point_jacobians(&Vector::from([0.0, std::f64::consts::FRAC_PI_2]));
    /// let torque = jacobian.transpose() * Vector::from([0.0, -3.0, 0.0]);
    /// assert!((torque - Vector::from([-1.5, -1.5])).norm() < 1e-12);
    /// ```
    fn point_jacobians<S: Scalar>(&self, q: &SVector<S, DOF>) -> [SMatrix<S, 3, DOF>; POINTS];
}
