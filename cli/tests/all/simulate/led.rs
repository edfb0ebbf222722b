//! Pendulums whose links hang, start and move where loads of other joints lead them.

use robot_model::simulate::Plant;
use robot_model_cli::interpreted::InterpretedPlant;

use crate::simulate::common::{compiled, plant, released, resting};
use crate::simulate::coupled::BELT;
use crate::simulate::differences::{State, differences};

/// A double pendulum in a gravity, with motors, and effects of its own.
fn pendulum(gravity: &str, definitions: &str, effects: &str) -> InterpretedPlant {
    let text = format!(
        "{definitions}
        robot Pendulum {{
            gravity = [{gravity}];
            convention = standard_dh;
            joint upper: revolute {{ a = 0.5; alpha = 0; d = 0; }}
            joint lower: revolute {{ a = 0.4; alpha = 0; d = 0; }}
            link upper {{ mass = 2; com = [-0.25, 0, 0]; inertia = [0.001, 0, 0, 0.05, 0, 0.05]; }}
            link lower {{ mass = 1; com = [-0.2, 0, 0]; inertia = [0.001, 0, 0, 0.02, 0, 0.02]; }}
            effects {{ motor_inertia on all; {effects} }}
        }}"
    );
    let more = [
        ("motor_inertia.ia", 0.1),
        ("push.f", 50.0),
        ("cling.g", 0.001),
        ("dahl.fc", 0.7),
        ("dahl.d", 0.05),
    ];
    plant(compiled(&text).ungrouped(), &more)
}

#[test]
fn forces_of_the_world_are_no_load_of_a_stiff_joint() {
    // 50 N across the end of the first link, which the first motor holds; the second link is led by the first joint's own load, none.
    let laws = "effect push(j) { linear f; force(j) = [0, f, 0]; }
        effect sag(j, k) { position(k) = -0.01 * rigid_torque(k) + 0.001 * rigid_torque(j); }";
    let mut arm = pendulum("0, 0, 0", laws, "push on upper; sag on (upper, lower);");
    let q = arm.start(&resting(&[0.0, 0.3], &[0.0, 0.0]));
    let mut held = released(arm, &q, &[0.0; 3]);
    held.drive(robot_model::simulate::Drive {
        torque: vec![-25.0, 0.0],
        ..Default::default()
    });
    held.advance(0.01).expect("rest");
    assert!(
        held.dq().iter().all(|dq| dq.abs() < 1e-6),
        "{:?}",
        held.dq()
    );
}

#[test]
fn gaps_of_springs_that_bend_each_other_are_hung_through() {
    let frame = "effect frame(i, j) {
        position(i) = -(0.003 * rigid_torque(i) + 0.001 * rigid_torque(j)) - 0.01 * sign(rigid_torque(i));
        position(j) = -(0.001 * rigid_torque(i) + 0.002 * rigid_torque(j)) - 0.02 * sign(rigid_torque(j));
    }";
    let text = format!(
        "{frame}
        robot Two {{
            gravity = [0, 0, -9.81];
            convention = standard_dh;
            joint turn: revolute {{ a = 0; alpha = -90 deg; d = 0.3; }}
            joint lift: revolute {{ a = 0.45; alpha = 0; d = 0; }}
            link turn {{ mass = 5; com = [0, 0.1, 0]; inertia = [0.05, 0, 0, 0.04, 0, 0.05]; }}
            link lift {{ mass = 4; com = [-0.22, 0, 0]; inertia = [0.01, 0, 0, 0.08, 0, 0.08]; }}
            effects {{ motor_inertia on all; frame on (turn, lift); }}
        }}"
    );
    let mut arm = plant(compiled(&text).ungrouped(), &[("motor_inertia.ia", 0.3)]);
    let q = arm.start(&resting(&[0.3, -0.6], &[0.0; 2]));
    // Gravity is along -z, about which the first joint turns; the second lifts against it.
    let load = -9.81 * 4.0 * 0.23 * q[3].cos();
    let bent = q[3] - q[1];
    let expected = -0.002 * load - 0.02 * load.signum();
    assert!((bent - expected).abs() < 1e-8, "{bent} {expected}");
}

#[test]
fn bent_laws_of_a_stiff_joints_load_have_motions() {
    let law = "effect bent(j, k) { position(k) = -0.001 * tanh(rigid_torque(j) / 5); }";
    let mut arm = pendulum("0, -9.81, 0", law, "bent on (upper, lower);");
    assert!(!arm.is_affine());
    let q = arm.start(&resting(&[0.2, 0.4], &[0.0; 2]));
    let mut moving = released(arm, &q, &[0.0; 3]);
    moving.advance(0.3).expect("a motion");
    let bent = moving.q()[2] - moving.q()[1];
    assert!(
        bent.abs() < 2e-3 && moving.q()[0] < 0.0,
        "{bent} {:?}",
        moving.q()
    );
}

#[test]
fn a_link_that_the_next_joints_belt_leads_stays_where_it_leads() {
    let mut arm = pendulum(
        "0, -9.81, 0",
        BELT,
        "soft_belt(stiffness = 500) on (lower, upper);",
    );
    let q = arm.start(&resting(&[0.3, -0.6], &[0.0; 2]));
    let mut moving = released(arm, &q, &[0.0; 4]);
    for step in 1..=30 {
        moving.advance(0.01 * f64::from(step)).expect("a motion");
        let q = moving.q();
        let (led, bent) = (q[2] - q[0], q[3] - q[1]);
        assert!((led + bent).abs() < 1e-3, "{step}: {led} {bent}");
    }
}

#[test]
fn slopes_of_teeth_of_led_links_are_those_of_differences() {
    let laws = format!(
        "{BELT}
        effect lead(j) {{ position(j) = 0.02 * dq(j) + 0.1 * q(j); }}
        effect cling(j) {{ linear g; torque(j) = g * rigid_torque(j)^2; }}"
    );
    // Links are near where they are led.
    for (effects, links) in [
        (
            "soft_belt(stiffness = 900) on (upper, lower);",
            &[0.301, -0.401_001][..],
        ),
        ("lead on lower;", &[-0.441_801]),
    ] {
        let effects = format!("cling on all; dahl on lower; {effects}");
        let mut arm = pendulum("0, -9.81, 0", &laws, &effects);
        let dof = 2 + links.len();
        assert_eq!(arm.dof(), dof);
        let state: State = [
            [&[0.3, -0.4], links].concat(),
            vec![0.07, -0.09, 0.04, 0.02][..dof].to_vec(),
            vec![1.1, 2.3, -0.6, 0.9][..dof].to_vec(),
            vec![0.03],
        ];
        let [_, dq, ..] = differences(&mut arm, &state);
        assert!(dq[(1, dof - 1)].abs() > 1.0, "teeth are damped: {dq}");
    }
}
