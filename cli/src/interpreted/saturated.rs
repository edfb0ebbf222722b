//! Which joints have an effect that says what a drive at its limit does not deliver.

use robot_model_spec::Model;

/// Joints of effects that read the torque as it was logged: what they say of it holds at its limit, too.
pub(super) fn saturated_joints(model: &Model) -> Vec<usize> {
    let effects = model.effects.iter();
    let readers = effects.filter(|effect| effect.definition.reads_measured_torque());
    let mut joints: Vec<usize> = readers.flat_map(|effect| effect.joints.clone()).collect();
    joints.sort_unstable();
    joints.dedup();
    joints
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn joints_with_an_effect_of_the_logged_torque_are_saturated() {
        let joints = |effects: &str| {
            let text = format!(
                "robot R {{ gravity = [0, 0, 0]; convention = standard_dh; \
                 joint a: revolute {{ a = 1; alpha = 0; d = 0; }} joint b: revolute {{ a = 1; alpha = 0; d = 0; }} \
                 effects {{ {effects} }} }}"
            );
            let model = robot_model_spec::load("r.robot", &text);
            saturated_joints(&model.unwrap_or_else(|errors| panic!("{errors}")))
        };
        assert_eq!(joints("coulomb_friction on all; payload on b;"), [0; 0]);
        let limit = "torque_saturation(limit = 3, v0 = 4)";
        assert_eq!(
            joints(&format!("viscous_friction on all; {limit} on b;")),
            [1]
        );
        assert_eq!(joints(&format!("{limit} on all;")), [0, 1]);
    }
}
