//! Springs and gaps between motors and links.

use robot_model::simulate::{Instant, Integrator, Loop, Plant, Torques, Trajectory};
use robot_model_cli::interpreted::InterpretedPlant;

use crate::simulate::common::{compiled, plant, released};

/// Inertia of motor and link, kg m^2, and the spring between them.
const MOTOR: f64 = 0.3;
const LINK: f64 = 0.2;
const STIFFNESS: f64 = 500.0;

/// A link of mass 1 at a radius on a vertical or a horizontal axis, with effects.
fn text(gravity: &str, effects: &str) -> String {
    format!(
        "robot Arm {{
            gravity = [{gravity}];
            convention = standard_dh;
            joint turn: revolute {{ a = 0.4; alpha = 0; d = 0; }}
            link turn {{ mass = 1; com = [0, 0, 0]; inertia = [0.001, 0, 0, 0.02, 0, {izz}]; }}
            effects {{ motor_inertia on turn; {effects} }}
        }}",
        izz = LINK - 0.16
    )
}

fn soft(gravity: &str, effects: &str) -> InterpretedPlant {
    // Inertia of the link and that of its motor are one base parameter.
    let arm = compiled(&text(gravity, effects));
    assert_eq!(arm.mixed(), ["turn.izzr"]);
    plant(
        arm.ungrouped(),
        &[("motor_inertia.ia", MOTOR), ("coulomb_friction.fc", 30.0)],
    )
}

fn spring(more: &str) -> String {
    format!("joint_elasticity(stiffness = {STIFFNESS}) on turn; {more}")
}

#[test]
fn motor_and_link_swing_against_each_other() {
    let bent = 0.02;
    let mut arm = released(soft("0, 0, -9.81", &spring("")), &[bent, 0.0], &[0.0, 0.0]);
    let omega = (STIFFNESS * (1.0 / MOTOR + 1.0 / LINK)).sqrt();
    for k in 1..=40 {
        let time = 0.05 * f64::from(k);
        arm.advance(time).expect("a motion");
        // The common center stands.
        let lead = bent * (omega * time).cos();
        let center = bent * MOTOR / (MOTOR + LINK);
        let expected = [
            center + lead * LINK / (MOTOR + LINK),
            center - lead * MOTOR / (MOTOR + LINK),
        ];
        for (found, expected) in arm.q().iter().zip(expected) {
            assert!(
                (found - expected).abs() < 1e-7,
                "{time}: {found} {expected}"
            );
        }
    }
}

#[test]
fn what_hangs_on_a_spring_starts_where_it_hangs() {
    let arm = soft("0, -9.81, 0", &spring("backlash(half_gap = 0.01) on turn;"));
    let times = vec![0.0, 0.3, 0.6, 1.0];
    let q0 = 0.3;
    let wanted = Trajectory::new(times.clone(), vec![vec![q0; 4]], vec![], vec![], vec![])
        .expect("a motion");
    // The motor's torque holds it, so nothing moves.
    let mut q = q0;
    for _ in 0..100 {
        q = q0 - 9.81 * 0.4 * f64::cos(q) / STIFFNESS - 0.01;
    }
    let holds = 9.81 * 0.4 * q.cos();
    let mut torque = Torques::new(times, vec![vec![holds; 4]]).expect("torques");
    let (record, end) = Loop::default()
        .run(arm, &mut torque, &wanted, &mut |_| ())
        .expect("a log");
    assert_eq!(record.q.len(), 1, "the encoder is the motor's");
    assert!((end.q()[0] - q0).abs() < 1e-9, "{:?}", end.q());
    assert!((end.q()[1] - q).abs() < 1e-9, "{:?} {q}", end.q());
}

/// Where a link hangs whose motor is at `motor`, from straight down.
fn hangs(spring: &str, motor: f64) -> f64 {
    let down = -0.5 * std::f64::consts::PI;
    let mut arm = soft("0, -9.81, 0", spring);
    let q = arm.start(&Instant {
        time: 0.0,
        q: &[down + motor],
        dq: &[0.0],
        ddq: &[0.0],
        memory: &[],
        switches: &[],
        torque: &[0.0],
        inputs: &[],
    });
    q[1] - down
}

#[test]
fn a_link_hangs_where_its_energy_is_least() {
    // A spring that is softer than gravity is steep: k (m - l) = m g r sin l.
    let found = hangs("joint_elasticity(stiffness = 3) on turn;", 0.1);
    let rest = 3.0 * (0.1 - found) - 9.81 * 0.4 * found.sin();
    assert!(found > 0.0 && rest.abs() < 1e-9, "{found} {rest}");
    // Upside down it falls to a side, and hangs on its spring there.
    let upside = std::f64::consts::PI - 0.01;
    let found = hangs("joint_elasticity(stiffness = 3) on turn;", upside);
    let rest = 3.0 * (upside - found) - 9.81 * 0.4 * found.sin();
    assert!(found < upside && rest.abs() < 1e-9, "{found} {rest}");
    assert!(3.0 + 9.81 * 0.4 * found.cos() > 0.0, "it is no crest");
    // Inside a gap it hangs straight down.
    let found = hangs(&spring("backlash(half_gap = 0.02) on turn;"), 0.001);
    assert!(found.abs() < 1e-9, "{found}");
    // Teeth that touch carry it.
    let found = hangs(&spring("backlash(half_gap = 0.02) on turn;"), 0.5);
    let rest = STIFFNESS * (0.5 - found - 0.02) - 9.81 * 0.4 * found.sin();
    assert!(rest.abs() < 1e-9, "{found} {rest}");
}

/// Energy of both sides and of the spring between them.
fn energy(arm: &Integrator<InterpretedPlant>, half_gap: f64) -> f64 {
    let lead = arm.q()[0] - arm.q()[1];
    let stretch = (lead.abs() - half_gap).max(0.0);
    let moving = MOTOR * arm.dq()[0].powi(2) + LINK * arm.dq()[1].powi(2);
    0.5 * (moving + STIFFNESS * stretch * stretch)
}

#[test]
fn a_link_crosses_its_gap_freely_and_bounces() {
    let half_gap = 0.05;
    let effects = spring(&format!("backlash(half_gap = {half_gap}) on turn;"));
    let mut arm = released(soft("0, 0, -9.81", &effects), &[0.0, 0.0], &[0.0, 1.0]);
    let start = energy(&arm, half_gap);
    arm.advance(0.04).expect("a motion");
    assert!(
        (arm.q()[1] - 0.04).abs() < 1e-12 && arm.q()[0] == 0.0,
        "{:?}",
        arm.q()
    );
    let mut sides = [false; 2];
    for k in 1..=500 {
        arm.advance(0.04 + 0.01 * f64::from(k)).expect("a motion");
        assert!((energy(&arm, half_gap) - start).abs() < 1e-6 * start);
        let momentum = MOTOR * arm.dq()[0] + LINK * arm.dq()[1];
        assert!((momentum - LINK).abs() < 1e-7);
        let lead = arm.q()[0] - arm.q()[1];
        sides[usize::from(lead > 0.0)] |= lead.abs() > half_gap;
    }
    assert_eq!(sides, [true; 2], "both sides are met");
}

#[test]
fn a_motor_that_sticks_leaves_its_link_swinging() {
    let effects = spring("coulomb_friction on turn;");
    let bent = 0.02;
    let mut arm = released(soft("0, 0, -9.81", &effects), &[0.0, bent], &[0.0, 0.0]);
    let omega = (STIFFNESS / LINK).sqrt();
    for k in 1..=20 {
        let time = 0.05 * f64::from(k);
        arm.advance(time).expect("a motion");
        assert!(arm.q()[0] == 0.0, "friction is on the motor's side");
        assert!((arm.q()[1] - bent * (omega * time).cos()).abs() < 1e-7);
    }
}

/// What an arm with these effects, after definitions of its own, says in place of a simulation.
fn refused(definitions: &str, effects: &str) -> String {
    let text = text("0, 0, -9.81", effects).replacen("motor_inertia on turn; ", "", 1);
    let arm = compiled(&format!("{definitions}\n{text}")).ungrouped();
    let beta = vec![0.5; arm.base.kept.len()];
    let shapes = robot_model_codegen::base::shape_values(&arm.model);
    let refusal = InterpretedPlant::new(arm, &beta, &shapes);
    refusal.expect_err("no plant").to_string()
}

#[test]
fn springs_that_no_motion_has_are_refused() {
    let moved =
        |by: &str| format!("effect moved(j) {{ shape a in 0.01 .. 1; position(j) = {by}; }}");
    let moving = "motor_inertia on turn; moved(a = 0.1) on turn;";
    for (definitions, effects, word) in [
        (
            String::new(),
            "joint_elasticity(stiffness = 500) on turn;",
            "has no inertia; declare `motor_inertia on turn`",
        ),
        (
            moved("a * dq(j)"),
            "moved(a = 0.1) on turn;",
            "has no inertia; declare `motor_inertia on turn`",
        ),
        (
            moved("a * rigid_torque(j)"),
            moving,
            "deflects against its load",
        ),
        (
            moved("-a * abs(rigid_torque(j))"),
            moving,
            "deflects against its load",
        ),
    ] {
        let said = refused(&definitions, effects);
        assert!(said.contains(word), "{said}");
    }
}

#[test]
fn gains_are_for_a_motor_with_its_link() {
    let whole = soft("0, 0, -9.81", &spring("")).free_inertia(&[0.3], &[]);
    assert!((whole[0] - MOTOR - LINK).abs() < 1e-12, "{whole:?}");
}
