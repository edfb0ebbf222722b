//! Gains of a linear loop around each joint.

use super::error::{ControlError, POSITIVE, each_joint, is_positive};
use crate::model::Vector;

/// Natural frequency `w` and damping ratio `zeta` a joint: an error obeys `e'' + kd e' + kp e = 0` with `kp = w^2` and
/// `kd = 2 zeta w`.
///
/// They are checked where a controller takes them, which knows the joints' names.
///
/// # Examples
/// ```
/// use robot_model::control::Gains;
/// // Of seed 004, figure 14: K_P = 625 and K_D = 35.
/// let gains = Gains::<3>::new(25.0, 0.7);
/// assert!((gains.kp()[2] - 625.0).abs() < 1e-9 && (gains.kd()[2] - 35.0).abs() < 1e-9);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gains<const D: usize> {
    frequency: Vector<D>,
    damping: Vector<D>,
}

impl<const D: usize> Gains<D> {
    /// The same natural frequency, rad/s, and damping ratio for all joints.
    ///
    /// # Examples
    /// ```
    /// use robot_model::control::Gains;
    /// assert_eq!(Gains::new(10.0, 0.5), Gains::each([10.0; 2], [0.5; 2]));
    /// ```
    #[must_use]
    pub fn new(frequency: f64, damping: f64) -> Self {
        Self::each([frequency; D], [damping; D])
    }

    /// The same natural frequency, rad/s, for all joints, and a damping ratio of 1: as fast as is possible without overshoot.
    ///
    /// # Examples
    /// ```
    /// use robot_model::control::Gains;
    /// assert_eq!(Gains::<1>::critically_damped(10.0).kd()[0], 20.0);
    /// ```
    #[must_use]
    pub fn critically_damped(frequency: f64) -> Self {
        Self::new(frequency, 1.0)
    }

    /// Natural frequencies, rad/s, and damping ratios of the joints, base to tip.
    ///
    /// # Examples
    /// ```
    /// use robot_model::control::Gains;
    /// let gains = Gains::each([10.0, 40.0], [1.0, 0.7]);
    /// assert_eq!((gains.kp()[0], gains.kd()[1]), (100.0, 56.0));
    /// ```
    #[must_use]
    pub fn each(frequency: [f64; D], damping: [f64; D]) -> Self {
        Self {
            frequency: frequency.into(),
            damping: damping.into(),
        }
    }

    /// `w^2`, 1/s^2.
    ///
    /// # Examples
    /// ```
    /// # use robot_model::control::Gains;
    /// assert_eq!(Gains::<1>::new(3.0, 0.5).kp()[0], 9.0);
    /// ```
    #[must_use]
    pub fn kp(&self) -> Vector<D> {
        self.frequency.map(|w| w * w)
    }

    /// `2 zeta w`, 1/s.
    ///
    /// # Examples
    /// ```
    /// # use robot_model::control::Gains;
    /// assert_eq!(Gains::<1>::new(3.0, 0.5).kd()[0], 3.0);
    /// ```
    #[must_use]
    pub fn kd(&self) -> Vector<D> {
        self.frequency
            .zip_map(&self.damping, |w, zeta| 2.0 * zeta * w)
    }

    pub(super) fn check(&self, joints: &[&'static str; D]) -> Result<(), ControlError> {
        let frequency = ("natural frequency", " rad/s", POSITIVE);
        each_joint(joints, self.frequency.as_slice(), frequency, is_positive)?;
        let damping = ("damping ratio", "", POSITIVE);
        each_joint(joints, self.damping.as_slice(), damping, is_positive)
    }
}
