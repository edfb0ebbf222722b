//! Whether motors move their joints at all: what holds a joint that creeps is below the largest torque of its motor.

use robot_model_codegen::Compiled;

use super::friction::{Effects, fastest};
use super::{Check, Quantity};
use crate::parameters::Values;
use crate::units::Units;

/// `None` where the spec has no torque limits.
pub(super) fn check(compiled: &Compiled, values: &Values) -> Option<Check> {
    let joints = &compiled.model.joints;
    if joints.iter().all(|joint| joint.limits.torque.is_none()) {
        return None;
    }
    let effects = Effects::new(compiled, values);
    let fastest = fastest(compiled);
    let findings = joints.iter().enumerate().filter_map(|(place, joint)| {
        let most = joint.limits.torque?;
        let hold = effects.hold(place, &fastest);
        let unit = Units::of(joint.kind).torque;
        (hold > most).then(|| {
            let name = &joint.name;
            let said = format!(
                "joint `{name}` is held by {hold:.4} {unit} of friction, and its motor has {most:.4} {unit}: it would not move"
            );
            let own = [("friction", hold), ("largest_torque", most)];
            let own = own.map(|(what, value)| Quantity::of(what, name, value, unit));
            (said, own.to_vec())
        })
    });
    let findings = findings.collect();
    let scope = "friction of joints that creep, beside their torque limits".to_owned();
    Some(Check::new("drives", scope, findings))
}
