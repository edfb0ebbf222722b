//! Friction of one joint from runs at constant speeds.
//!
//! In: logs in which the joint moves at constant speeds while all others stand, and one in which a torque rises slowly until it
//! breaks away. Out, each from the one before:
//!
//! - [`Stretch`]: where in a log the speed is constant.
//! - [`Curve`]: friction torque over speed. In `gain tau = Y_j beta + sum_k f_k [speed k] + noise` the rigid body's columns `Y_j` and
//!   one constant a speed are fitted at once, so that no parameter has to be known and no shape of the curve is supposed.
//! - [`Law`]: `f(v) = sign(v) (F_c + (F_s - F_c) exp(-(v/v_s)^2)) + s2 v + t0`, and whether the fall from `F_s` to `F_c` is more than
//!   chance.
//! - [`Bristles`]: stiffness `s0` and damping `s1` of the `LuGre` model from pre-sliding.
//!
//! Sources: Canudas de Wit, Olsson, Astrom, Lischinsky 1995, A new model for control of systems with friction; Armstrong-Helouvry
//! 1991, Control of machines with friction, on runs at constant speeds.

mod bristles;
mod curve;
mod error;
mod late;
mod law;
mod rows;
mod solution;
mod stretch;

pub use bristles::Bristles;
pub use curve::{Curve, Point};
pub use error::FrictionError;
pub use law::{Fall, Law};
pub use rows::Measured;
pub use stretch::Stretch;

/// A number with its standard deviation.
///
/// # Examples
/// ```
/// let stiffness = robot_model::friction_curve::Value { value: 200.0, std: 4.0 };
/// assert!(stiffness.std < 0.05 * stiffness.value);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Value {
    /// Estimate, SI.
    pub value: f64,
    /// Its standard deviation.
    pub std: f64,
}
