//! What friction loses once a joint slides.

use super::super::Value;

/// The fall of friction from standstill to where it slides on its lubricant.
///
/// # Examples
/// ```
/// use robot_model::friction_curve::{Fall, Value};
/// let fall = Fall { torque: Value { value: 1.4, std: 0.1 }, speed: Value { value: 0.8, std: 0.05 } };
/// // At the Stribeck speed 37 % of it is left.
/// let left = fall.torque.value * (-(0.8 / fall.speed.value).powi(2)).exp();
/// assert!((left - 0.515).abs() < 1e-3);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fall {
    /// `F_s - F_c`, N m or N.
    pub torque: Value,
    /// `v_s`, rad/s or m/s.
    pub speed: Value,
}
