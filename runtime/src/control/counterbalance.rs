//! Counterweights: which masses and levers cancel a gravity parameter.
//!
//! A gravity parameter is the moment `g sum(m L)` about an axis, N m, by which gravity loads a joint at its worst pose. Weights
//! at a fixed distance from the axis change it, and the right one makes it zero.
//!
//! Source: seed 004, equations 16 to 19.
//!
//! # Examples
//! The gimbal of seed 004: 0.09 kg at the end of the links, weights at 70.4 mm behind the motors.
//! ```
//! use robot_model::control::counterbalance::{Weight, mass, moment};
//!
//! let (g, lever, tool) = (9.81, 0.0704, 0.09);
//! // Equation 16: with the maker's weight of 0.216 kg.
//! let upper = moment(-0.01923, g, &[Weight { mass: tool, lever: 0.216 }, Weight { mass: 0.216, lever: -lever }]);
//! assert!((upper - 0.0223).abs() < 5e-5);
//! // Equations 18 and 19: what cancels both.
//! let upper = mass(moment(-0.01923, g, &[Weight { mass: tool, lever: 0.216 }]), g, lever)?;
//! let fore = mass(moment(-0.10996, g, &[Weight { mass: tool, lever: 0.195 }]), g, lever)?;
//! assert!((upper - 0.248).abs() < 5e-4 && (fore - 0.090).abs() < 5e-4);
//! # Ok::<(), robot_model::control::ControlError>(())
//! ```

use super::error::{ControlError, POSITIVE, is_positive, number};

/// A mass on a joint's axis.
///
/// # Examples
/// ```
/// use robot_model::control::counterbalance::{Weight, moment};
/// let tool = Weight { mass: 0.5, lever: 0.2 };
/// assert!((moment(0.0, 10.0, &[tool]) - 1.0).abs() < 1e-15);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Weight {
    /// kg
    pub mass: f64,
    /// Distance of its center of mass from the axis, m: positive on the side where a mass adds to the parameter, as a tool's,
    /// negative on the other, as a counterweight's.
    pub lever: f64,
}

/// The gravity parameter with weights, `pi' = pi + g sum(m L)`, N m: equations 16 and 17.
///
/// # Examples
/// ```
/// use robot_model::control::counterbalance::{Weight, moment};
/// // A joint that gravity loads with 3 N m, and 2 kg at 0.1 m on the other side of its axis.
/// let balanced = moment(3.0, 9.81, &[Weight { mass: 2.0, lever: -0.1 }]);
/// assert!((balanced - (3.0 - 1.962)).abs() < 1e-12);
/// ```
#[must_use]
pub fn moment(parameter: f64, gravity: f64, weights: &[Weight]) -> f64 {
    let moments = weights.iter().map(|weight| weight.mass * weight.lever);
    parameter + gravity * moments.sum::<f64>()
}

/// Mass of the counterweight at `lever` m that cancels `moment` N m, `m = moment / (g L)`, kg: equations 18 and 19.
///
/// # Errors
/// [`ControlError::Number`], where the lever or gravity is not positive or the moment no number;
/// [`ControlError::NegativeWeight`], where the weight belongs to the other side of the axis.
///
/// # Examples
/// ```
/// use robot_model::control::counterbalance::mass;
/// assert!(mass(-1.0, 9.81, 0.1).is_err());
/// let refused = mass(1.0, 9.81, 0.0).unwrap_err();
/// assert_eq!(refused.to_string(), "lever of a counterweight is 0 m; give a positive, finite number");
/// ```
pub fn mass(moment: f64, gravity: f64, lever: f64) -> Result<f64, ControlError> {
    let what = ("lever of a counterweight", " m", POSITIVE);
    number(lever, what, is_positive(lever))?;
    needed(moment, gravity, lever)
}

/// Lever of the counterweight of `mass` kg that cancels `moment` N m, `L = moment / (g m)`, m.
///
/// # Errors
/// As [`mass`].
///
/// # Examples
/// ```
/// use robot_model::control::counterbalance::{lever, mass};
/// let weight = mass(0.17148, 9.81, 0.0704)?;
/// assert!((lever(0.17148, 9.81, weight)? - 0.0704).abs() < 1e-15);
/// # Ok::<(), robot_model::control::ControlError>(())
/// ```
pub fn lever(moment: f64, gravity: f64, mass: f64) -> Result<f64, ControlError> {
    let what = ("mass of a counterweight", " kg", POSITIVE);
    number(mass, what, is_positive(mass))?;
    needed(moment, gravity, mass)
}

/// `moment / (gravity * factor)`
fn needed(moment: f64, gravity: f64, factor: f64) -> Result<f64, ControlError> {
    let what = ("gravity", " m/s^2", POSITIVE);
    number(gravity, what, is_positive(gravity))?;
    let what = ("moment to be balanced", " N m", "a finite number");
    number(moment, what, moment.is_finite())?;
    let needed = moment / (gravity * factor);
    if needed < 0.0 {
        return Err(ControlError::NegativeWeight { moment });
    }
    let what = (
        "lever or mass of a counterweight",
        "",
        "more gravity, or a larger value of the other one",
    );
    number(needed, what, needed.is_finite())?;
    Ok(needed)
}
