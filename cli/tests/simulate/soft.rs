//! Springs and gaps between motors and links.

use nalgebra::{DMatrix, DVector};
use robot_model::simulate::{Instant, Integrator, Loop, Plant, Slopes, Torques, Trajectory};
use robot_model_cli::interpreted::InterpretedPlant;

use crate::common::{compiled, pendulum_with, plant, released};

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
fn what_no_motion_follows_from_is_refused() {
    let wobble = "effect wobble(j) { shape a in 0.01 .. 1; position(j) = a * sin(q(j)); }";
    for (definitions, effects, word) in [
        (
            "",
            "joint_elasticity(stiffness = 500) on turn;",
            "has no inertia; declare `motor_inertia on turn`",
        ),
        (
            "",
            "motor_inertia on turn; backlash(half_gap = 0.01) on turn;",
            "declare `joint_elasticity` beside `backlash`",
        ),
        (
            wobble,
            "motor_inertia on turn; wobble on turn;",
            "only springs and gaps are simulated",
        ),
        // A spring up to a load that no log has.
        (
            "effect stop(j) {
                shape k in 20 .. 1000;
                let more = if abs(rigid_torque(j)) > 1e5 { rigid_torque(j) / k } else { 0 };
                position(j) = -rigid_torque(j) / k - more;
            }",
            "motor_inertia on turn; stop on turn;",
            "only springs and gaps are simulated",
        ),
    ] {
        let said = refused(definitions, effects);
        assert!(said.contains(word), "{said}");
    }
}

/// Everything at once: a spring with play on the second of two joints, friction that remembers and friction that loads bend, and a world
/// that the second link rubs against, harder by `bite` times its load and acceleration.
fn mixed(bite: f64) -> InterpretedPlant {
    let rub = "effect rub(j) {
        linear c, f, g;
        state y;
        dot(y) = dq(j) - abs(dq(j)) * y / 0.1;
        force(j) = [g * (rigid_torque(j) + ddq(j)) + f * sign(dq(j)) - c * dq(j) * q(j), c * y, 0];
    }";
    let arm = pendulum_with(
        rub,
        "rub on lower;
        motor_inertia on lower;
        joint_elasticity(stiffness = 300) on lower;
        backlash(half_gap = 0.01) on lower;
        encoder_offset(offset = 0.05) on lower;
        dahl on lower;
        load_dependent_friction on all;",
    );
    let more = [
        ("motor_inertia.ia", 0.1),
        ("dahl.fc", 0.7),
        ("dahl.d", 0.05),
        ("load_dependent_friction.mu", 0.1),
        ("rub.c", 0.8),
        ("rub.f", 1.3),
        ("rub.g", bite),
    ];
    plant(arm.ungrouped(), &more)
}

#[test]
fn gains_are_for_motors_with_their_links() {
    let whole = soft("0, 0, -9.81", &spring("")).free_inertia(&[0.3], &[]);
    assert!((whole[0] - MOTOR - LINK).abs() < 1e-12, "{whole:?}");
    // Of two joints: what one moves while the other is free, `M_11 - M_12^2 / M_22`.
    let mut arm = mixed(0.0);
    let q = [0.3, -0.4];
    let state: State = [
        vec![q[0], q[1], q[1]],
        vec![0.0; 3],
        vec![0.0; 3],
        vec![0.0; 2],
    ];
    let (mut torque, mut m) = (DVector::zeros(3), DMatrix::zeros(3, 3));
    let switches = vec![0.0; arm.switches()];
    arm.torque(&at(&state, &switches), &mut torque, &mut m);
    let (one, both, other) = (m[(0, 0)], m[(0, 2)], m[(1, 1)] + m[(2, 2)]);
    assert!(m[(1, 1)] > 0.09 && m[(2, 2)] > 0.04 && both > 0.05);
    let free = arm.free_inertia(&q, &[]);
    assert!(
        (free[0] - (one - both * both / other)).abs() < 1e-12,
        "{free:?}"
    );
}

/// Positions, velocities, accelerations and the state of all at an instant: of two motors and a link.
type State = [Vec<f64>; 4];

fn at<'a>([q, dq, ddq, memory]: &'a State, switches: &'a [f64]) -> Instant<'a> {
    Instant {
        time: 0.0,
        q,
        dq,
        ddq,
        memory,
        switches,
        torque: &[0.0; 3],
        inputs: &[],
    }
}

#[test]
fn slopes_of_both_sides_are_those_of_differences() {
    const STEP: f64 = 1e-6;
    let mut arm = mixed(0.2);
    assert_eq!((arm.dof(), arm.joints(), arm.states()), (3, 2, 2));
    assert_eq!([0, 1, 2].map(|k| arm.joint(k)), [0, 1, 1]);
    let switches = vec![0.6; arm.switches()];
    let state: State = [
        vec![0.3, -0.4, -0.53],
        vec![0.7, -0.9, 0.4],
        vec![1.1, 2.3, -0.6],
        vec![0.03, 0.004],
    ];
    // Torque and rates beside each other.
    let value = |arm: &mut InterpretedPlant, state: &State| -> DVector<f64> {
        let (mut torque, mut inertia) = (DVector::zeros(3), DMatrix::zeros(3, 3));
        arm.torque(&at(state, &switches), &mut torque, &mut inertia);
        let mut rates = [0.0; 2];
        arm.rates(&at(state, &switches), &mut rates);
        DVector::from_iterator(5, torque.iter().copied().chain(rates))
    };
    let mut difference = |part: usize| -> DMatrix<f64> {
        let columns: Vec<DVector<f64>> = (0..state[part].len())
            .map(|k| {
                let [up, down] = [STEP, -STEP].map(|step| {
                    let mut state = state.clone();
                    state[part][k] += step;
                    value(&mut arm, &state)
                });
                (up - down) / (2.0 * STEP)
            })
            .collect();
        DMatrix::from_columns(&columns)
    };
    let differences = [0, 1, 2, 3].map(&mut difference);
    let mut slopes = Slopes::zeros(&arm);
    arm.slopes(&at(&state, &switches), &mut slopes);
    let (mut torque, mut inertia) = (DVector::zeros(3), DMatrix::zeros(3, 3));
    arm.torque(&at(&state, &switches), &mut torque, &mut inertia);
    let Slopes {
        torque: [q, dq, z],
        rates: [rates_q, rates_dq, rates_z],
        rates_by_acceleration,
    } = slopes;
    for (found, (torque, rates)) in differences.iter().zip([
        (q, rates_q),
        (dq, rates_dq),
        (inertia, rates_by_acceleration),
        (z, rates_z),
    ]) {
        let expected = DMatrix::from_fn(5, found.ncols(), |i, j| {
            if i < 3 {
                torque[(i, j)]
            } else {
                rates[(i - 3, j)]
            }
        });
        let size = expected.amax().max(1.0);
        assert!(
            (found - &expected).amax() < 1e-6 * size,
            "{found} {expected}"
        );
    }
    // The spring is stretched and everything has a part in it.
    assert!(differences[0][(1, 2)] < -200.0 && differences[0][(2, 0)] != 0.0);
    assert!(differences[2][(1, 1)] > 0.0 && differences[3][(1, 1)] != 0.0);
    assert!(differences[3][(2, 0)] != 0.0 && differences[3][(1, 0)] == 0.0);
}
