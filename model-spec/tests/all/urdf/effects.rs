//! Effects of the imported spec: from the argument, and from damping and friction in the URDF.

use robot_model_spec::urdf::ImportOptions;

use super::{imported, joint, refusal, two_joints};

#[test]
fn effects_are_given_by_number_name_or_all() {
    let effects = "all:viscous_friction,coulomb-friction; 2:motor_inertia ;j1:motor_inertia;(1,2):gear_coupling".to_owned();
    let (text, model) = imported(
        &two_joints(),
        &ImportOptions {
            effects,
            ..ImportOptions::default()
        },
    );
    assert!(text.contains("motor_inertia on j2, j1;"), "{text}");
    assert!(text.contains("gear_coupling on (j1, j2);"), "{text}");
    assert_eq!(model.effects.len(), 7);
}

#[test]
fn faults_of_the_effects_argument_are_named() {
    let of = |effects: &str| {
        refusal(
            &two_joints(),
            &ImportOptions {
                effects: effects.to_owned(),
                ..ImportOptions::default()
            },
        )
    };
    assert_eq!(
        of("3:motor_inertia"),
        "--effects: there is no joint 3: the chain has joints 1 to 2"
    );
    assert_eq!(
        of("1:motor_inrtia"),
        "--effects: there is no standard effect `motor_inrtia`; write `motor_inertia`"
    );
    assert_eq!(
        of("j3:motor_inertia"),
        "--effects: the chain has no joint `j3`; write `j1`, or a number from 1 to 2"
    );
    assert_eq!(
        of("viscous_friction"),
        "--effects: `viscous_friction` names no effect: write `JOINTS:effect,effect`"
    );
    assert_eq!(
        of("all:motor_inertia;1:motor_inertia"),
        "--effects: `motor_inertia` is there twice for joint `all`: once is enough"
    );
}

#[test]
fn damping_and_friction_are_declared_and_told() {
    let mut parts = two_joints();
    parts[7] = joint(
        "j1",
        "revolute",
        "mount",
        "upper",
        "<dynamics damping='0.5' friction='0'/>",
    );
    parts[9] = joint(
        "j2",
        "prismatic",
        "bracket",
        "fore",
        "<dynamics damping='2' friction='1.5'/>",
    );
    let (text, model) = imported(&parts, &ImportOptions::default());
    let declared: Vec<String> = (0..model.effects.len())
        .map(|k| model.effect_name(k))
        .collect();
    assert_eq!(
        declared,
        [
            "j1.viscous_friction",
            "j2.viscous_friction",
            "j2.coulomb_friction"
        ]
    );
    assert!(
        text.contains("j1: damping 0.5; j2: damping 2, friction 1.5"),
        "{text}"
    );
    // What the argument declares already is not declared twice.
    let options = ImportOptions {
        effects: "all:viscous_friction;2:coulomb_friction".to_owned(),
        ..ImportOptions::default()
    };
    assert_eq!(imported(&parts, &options).1.effects.len(), 3);
}
