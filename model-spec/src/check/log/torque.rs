//! The unit of a torque column, beside the gain that makes a torque of what the log has.

use super::Other;
use crate::ast::{self, Robot, Setting};
use crate::check::chain::{gain_dimension, torque_dimension, torque_unit};
use crate::check::unit::Dimension;
use crate::check::value;
use crate::diagnostic::Diagnostic;
use crate::model::Joint;

/// A torque, a current with a gain, or a number with a gain of any kind.
pub(super) fn check_torque(
    column: &ast::LogColumn,
    joint: &Joint,
    gain: Option<&Other>,
) -> Result<(), Diagnostic> {
    let Some(unit) = &column.unit else {
        return Ok(());
    };
    let torque = torque_dimension(joint.kind);
    let dimension = value::constant(unit)?.dimension;
    let of_gain = joint.actuator_gain_unit;
    let of_gain = of_gain.map(|unit| gain_dimension(unit, joint.kind));
    let name = &joint.name;
    let in_torque = torque_unit(joint.kind);
    match (dimension, of_gain) {
        (Some(Dimension::CURRENT), None) => Err(Diagnostic::new(
            unit.span,
            format!("joint `{name}` logs a current and has no `actuator_gain`"),
            "a current",
        )
        .help(format!(
            "write `actuator_gain = 0.1 {in_torque}/A;` into the joint, with the torque per ampere"
        ))),
        (Some(found), _) if found != torque && found != Dimension::CURRENT => Err(Diagnostic::new(
            unit.span,
            format!("expected {}, found {}", torque.describe(), found.describe()),
            format!("this is {}", found.describe()),
        )
        .help(format!(
            "write it in `{in_torque}`, in `A` with an `actuator_gain`, or as a plain number"
        ))),
        (Some(found), Some(Some(of_gain))) if found.times(of_gain, 1) != torque => {
            let error = Diagnostic::new(
                unit.span,
                format!(
                    "the unit of joint `{name}`'s log times that of its `actuator_gain` is not {}",
                    torque.describe()
                ),
                format!("{} here", found.describe()),
            );
            let help = format!(
                "write the gain in `{in_torque}/A` where the log is in `A`, and as a plain number where it is in `{in_torque}`"
            );
            Err(match gain {
                Some(gain) => gain.beside(error, of_gain.describe(), &help),
                None => error.help(help),
            })
        }
        _ => Ok(()),
    }
}

/// Where the joint's `actuator_gain` is written.
pub(super) fn gain_of(robot: &Robot, joint: &Joint) -> Option<Other> {
    let of_chain = robot.joints.iter().map(|own| (&own.name, &own.settings));
    let of_energies = robot
        .energies
        .limits
        .iter()
        .map(|own| (&own.name, &own.settings));
    let mut own = of_chain
        .chain(of_energies)
        .filter(|(name, _)| **name == joint.name);
    let settings: &[Setting] = own.next()?.1;
    let gain = settings
        .iter()
        .find(|setting| setting.key == "actuator_gain")?;
    Some(Other::Here(gain.value.span()))
}
