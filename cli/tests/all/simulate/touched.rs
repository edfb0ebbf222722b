//! Forces of the world on links behind springs.

use robot_model::simulate::{Instant, Plant};
use robot_model_cli::interpreted::InterpretedPlant;

use crate::simulate::common::{compiled, plant, released};

/// Inertia of the motor seen at the rail and mass of the carriage, kg, and the belt between them.
const MOTOR: f64 = 3.0;
const CARRIAGE: f64 = 2.0;
const STIFFNESS: f64 = 5000.0;
const PULL: f64 = 40.0;

/// A carriage on a rail along gravity's normal, pulled by a belt; definitions in front, effects inside.
fn rail(definitions: &str, effects: &str) -> InterpretedPlant {
    let text = format!(
        "{definitions}
        robot Rail {{
            gravity = [0, -9.81, 0];
            convention = standard_dh;
            joint slide: prismatic {{ a = 0; alpha = 0; theta = 0; }}
            link slide {{ mass = {CARRIAGE}; com = [0, 0, 0]; inertia = [0.01, 0, 0, 0.01, 0, 0.01]; }}
            effects {{
                motor_inertia on slide;
                joint_elasticity(stiffness = {STIFFNESS}) on slide;
                {effects}
            }}
        }}"
    );
    let more = [
        ("motor_inertia.ia", MOTOR),
        ("coulomb_friction.fc", 1000.0),
        ("external_force.fx", 0.0),
        ("external_force.fy", 0.0),
        ("external_force.fz", PULL),
        ("rub.f", PULL),
    ];
    plant(compiled(&text).ungrouped(), &more)
}

#[test]
fn a_pull_that_sets_in_is_on_the_carriage_and_reaches_the_motor_through_the_belt() {
    let arm = rail("", "external_force(start = 0.2, end = 60) on slide;");
    let mut arm = released(arm, &[0.0, 0.0], &[0.0, 0.0]);
    arm.advance(0.2).expect("rest");
    assert_eq!(arm.q(), [0.0, 0.0], "nothing pulls yet");
    let whole = MOTOR + CARRIAGE;
    let omega = (STIFFNESS * (1.0 / MOTOR + 1.0 / CARRIAGE)).sqrt();
    let stretch = PULL / (CARRIAGE * omega * omega);
    for k in 1..=40 {
        let since = 0.03 * f64::from(k);
        arm.advance(0.2 + since).expect("a motion");
        let center = 0.5 * PULL / whole * since * since;
        let behind = stretch * (1.0 - (omega * since).cos());
        let expected = [
            center - behind * CARRIAGE / whole,
            center + behind * MOTOR / whole,
        ];
        for (found, expected) in arm.q().iter().zip(expected) {
            assert!(
                (found - expected).abs() < 1e-7,
                "{since}: {found} {expected}"
            );
        }
    }
}

#[test]
fn what_is_pulled_starts_where_it_hangs() {
    let mut arm = rail("", "external_force(start = 0, end = 60) on slide;");
    let at = |time: f64, arm: &mut InterpretedPlant| {
        arm.start(&Instant {
            time,
            q: &[0.5],
            dq: &[0.0],
            ddq: &[0.0],
            memory: &[],
            switches: &[],
            torque: &[0.0],
            inputs: &[],
        })
    };
    let before = at(-1.0, &mut arm);
    assert!((before[1] - 0.5).abs() < 1e-12, "{before:?}");
    for time in [0.0, 1.0] {
        let under = at(time, &mut arm);
        let expected = 0.5 + PULL / STIFFNESS;
        assert!((under[1] - expected).abs() < 1e-9, "{time}: {under:?}");
    }
}

/// Dry friction of the carriage against the world, while the motor's own keeps it where it is: each half of a swing is shorter by twice
/// the friction over the belt's stiffness, until the carriage stands.
#[test]
fn a_carriage_that_rubs_against_the_world_comes_to_rest_by_its_own_sign() {
    const HALF_SWINGS: i32 = 4;
    let rub = "effect rub(j) { linear f; force(j) = [0, 0, -f * sign(dq(j))]; }";
    let arm = rail(rub, "coulomb_friction on slide; rub on slide;");
    let dead = PULL / STIFFNESS;
    let bent = (2.0 * f64::from(HALF_SWINGS) + 0.3) * dead;
    let mut arm = released(arm, &[0.0, bent], &[0.0, 0.0]);
    let half = std::f64::consts::PI * (CARRIAGE / STIFFNESS).sqrt();
    for k in 1..=HALF_SWINGS {
        arm.advance(f64::from(k) * half).expect("a motion");
        let side = if k % 2 == 0 { 1.0 } else { -1.0 };
        let expected = side * (bent - 2.0 * f64::from(k) * dead);
        assert!(arm.q()[0] == 0.0, "the motor sticks");
        assert!((arm.q()[1] - expected).abs() < 1e-7, "{k} {:?}", arm.q());
    }
    arm.advance(2.0).expect("rest");
    assert_eq!(arm.dq(), [0.0, 0.0]);
    assert!((arm.q()[1] - 0.3 * dead).abs() < 1e-7, "{:?}", arm.q());
}
