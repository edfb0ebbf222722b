//! The device as the project has it: the spec, compiled in two ways, and values for it.

use std::collections::BTreeMap;

use robot_model::effects::{CoulombFriction, ViscousFriction};
use robot_model::identify::Estimate;
use robot_model::{FromParameters as _, RobotModel, Vector};
use robot_model_cli::interpreted::{InterpretedArm, InterpretedMomentum};
use robot_model_codegen::Compiled;

use super::truth::{NAMES, Pi};
use crate::paper::Error;

/// Energies, workspace and friction.
pub const SPEC: &str = include_str!("phantom.robot");

const FRICTION: &str = "effects { viscous_friction on all; coulomb_friction on all; }";

/// The device for a controller.
#[derive(Debug, Clone, Copy, RobotModel)]
#[robot(file = "src/seed_004/phantom.robot")]
pub struct Phantom {
    /// Inertia about the vertical axis, in every pose.
    pub pi1: f64,
    /// The same, with the cosine of twice the second angle.
    pub pi2: f64,
    /// The same, with the cosine of twice the third angle.
    pub pi3: f64,
    /// Coupling of both links.
    pub pi4: f64,
    /// Inertia of the upper arm.
    pub pi5: f64,
    /// Inertia of the forearm.
    pub pi6: f64,
    /// Moment of gravity of the upper arm.
    pub pi7: f64,
    /// Moment of gravity of the forearm.
    pub pi8: f64,
    /// The base turns.
    pub theta1: (ViscousFriction, CoulombFriction),
    /// The upper arm.
    pub theta2: (ViscousFriction, CoulombFriction),
    /// The forearm.
    pub theta3: (ViscousFriction, CoulombFriction),
}

/// The device with values of table 1.
#[must_use]
pub fn phantom(pi: &Pi) -> Phantom {
    Phantom::from_standard(&Vector::from(Phantom::STANDARD_PARAMETERS.map(|name| {
        let place = NAMES.iter().position(|own| *own == name);
        place.map_or(0.0, |place| pi[place])
    })))
}

/// A spec, compiled.
///
/// # Errors
/// Mistakes of the text.
pub fn compiled(text: &str) -> Result<Compiled, Error> {
    crate::paper::compiled("phantom.robot", text)
}

/// A spec behind the traits of identification.
///
/// # Errors
/// As [`compiled`].
pub fn arm(text: &str) -> Result<InterpretedArm, Error> {
    Ok(InterpretedArm::new(compiled(text)?))
}

/// A spec that is identified without accelerations.
///
/// # Errors
/// As [`compiled`], and where it has no such form.
pub fn momentum(text: &str) -> Result<InterpretedMomentum, Error> {
    Ok(InterpretedMomentum::new(compiled(text)?)?)
}

/// The spec without friction.
#[must_use]
pub fn without_friction() -> String {
    SPEC.replace(FRICTION, "")
}

/// The spec without viscous friction on the joints of which `is_left_out`.
#[must_use]
pub fn without_viscous(is_left_out: [bool; 3]) -> String {
    let kept = (0..3).filter(|j| !is_left_out[*j]);
    let kept = kept.map(|j| format!("viscous_friction on theta{}; ", j + 1));
    let kept: String = kept.collect();
    SPEC.replace(
        FRICTION,
        &format!("effects {{ {kept}coulomb_friction on all; }}"),
    )
}

/// The spec with other limits of the positions, rad.
#[must_use]
pub fn within(low: [f64; 3], high: [f64; 3]) -> String {
    let lines = SPEC.lines().map(|line| {
        let joint = (0..3).find(|j| {
            line.trim_start()
                .starts_with(&format!("limits theta{}", j + 1))
        });
        joint.map_or(line.to_owned(), |j| {
            format!(
                "limits theta{} {{ position = {} .. {}; velocity = 3.5 rad/s; }}",
                j + 1,
                low[j],
                high[j]
            )
        })
    });
    lines.collect::<Vec<String>>().join("\n")
}

/// Values by the names of the spec.
#[must_use]
pub fn by_name(pi: &Pi) -> BTreeMap<String, f64> {
    NAMES.map(str::to_owned).into_iter().zip(*pi).collect()
}

/// What was identified, in the order of table 1; what is not in the model is zero.
#[must_use]
pub fn values(estimate: &Estimate) -> Pi {
    NAMES.map(|name| {
        let found = estimate.parameters.iter().find(|p| is_named(&p.name, name));
        found.map_or(0.0, |p| p.value)
    })
}

/// Standard deviations of [`values`].
#[must_use]
pub fn deviations(estimate: &Estimate) -> Pi {
    NAMES.map(|name| {
        let found = estimate.parameters.iter().find(|p| is_named(&p.name, name));
        found.map_or(0.0, |p| p.std)
    })
}

/// Base parameters that are one lump have its name, with an `r` behind it.
pub(super) fn is_named(own: &str, name: &str) -> bool {
    own == name || own.strip_suffix('r') == Some(name)
}
