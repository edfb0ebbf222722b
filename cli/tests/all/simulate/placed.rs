//! Links that are where joints and time put them, springs of any law, and teeth without any give.

use nalgebra::{DMatrix, DVector};
use robot_model::simulate::{Instant, Plant, Slopes};

use robot_model_cli::interpreted::InterpretedPlant;

use crate::simulate::common::{compiled, plant, released};

/// Inertia of motor and link, kg m^2.
const MOTOR: f64 = 0.3;
const LINK: f64 = 0.2;
/// Of the link's weight, N m.
const WEIGHT: f64 = 9.81 * 0.4;

fn arm(
    gravity: &str,
    definitions: &str,
    effects: &str,
) -> robot_model_cli::interpreted::InterpretedPlant {
    let text = format!(
        "{definitions}
        robot Arm {{
            gravity = [{gravity}];
            convention = standard_dh;
            joint turn: revolute {{ a = 0.4; alpha = 0; d = 0; }}
            link turn {{ mass = 1; com = [0, 0, 0]; inertia = [0.001, 0, 0, 0.02, 0, {izz}]; }}
            effects {{ {effects} }}
        }}",
        izz = LINK - 0.16
    );
    plant(
        compiled(&text).ungrouped(),
        &[("motor_inertia.ia", MOTOR), ("rub.f", 2.0)],
    )
}

const FLAT: &str = "0, 0, -9.81";

fn still(q: &[f64]) -> Instant<'_> {
    Instant {
        time: 0.0,
        q,
        dq: &[0.0],
        ddq: &[0.0],
        memory: &[],
        switches: &[],
        torque: &[0.0],
        inputs: &[],
    }
}

#[test]
fn an_encoder_that_is_off_center_sees_an_even_turn_as_uneven() {
    let wobble = "effect wobble(j) { shape a in 0.01 .. 1; position(j) = a * sin(q(j)); }";
    let plant = arm(FLAT, wobble, "wobble(a = 0.3) on turn;");
    let mut arm = released(plant, &[0.2], &[1.5]);
    let place = |q: f64| q + 0.3 * q.sin();
    let speed = 1.5 * (1.0 + 0.3 * f64::cos(0.2));
    for k in 1..=20 {
        let time = 0.3 * f64::from(k);
        arm.advance(time).expect("a motion");
        let expected = place(0.2) + speed * time;
        assert!((place(arm.q()[0]) - expected).abs() < 1e-7, "{time}");
    }
    let uneven = arm.dq()[0] - speed;
    assert!(uneven.abs() > 0.05, "{uneven}");
}

#[test]
fn a_place_that_time_shakes_is_shaken_against_an_even_turn() {
    let shake = "effect shake(j) { shape a in 0.001 .. 1; position(j) = a * sin(7 * time); }";
    let plant = arm(FLAT, shake, "shake(a = 0.05) on turn;");
    assert!(plant.is_timed());
    let mut arm = released(plant, &[0.0], &[1.0]);
    let speed = 1.0 + 0.05 * 7.0;
    for k in 1..=20 {
        let time = 0.1 * f64::from(k);
        arm.advance(time).expect("a motion");
        let expected = speed * time - 0.05 * (7.0 * time).sin();
        assert!((arm.q()[0] - expected).abs() < 1e-7, "{time}");
    }
}

#[test]
fn dry_friction_of_the_world_is_on_the_link_where_it_is() {
    // At the tip, across the link: the moment arm is that of the link.
    let effects = "effect wobble(j) { shape a in 0.01 .. 1; position(j) = a * sin(q(j)); }
        effect rub(j) { linear f; force(j) = [0, -f * sign(dq(j)) / 0.4, 0]; }";
    let plant = arm(FLAT, effects, "wobble(a = 0.3) on turn; rub on turn;");
    let mut arm = released(plant, &[0.2], &[1.5]);
    let place = |q: f64| q + 0.3 * q.sin();
    let speed = 1.5 * (1.0 + 0.3 * f64::cos(0.2));
    // `force` is in the base's frame: its lever is the link's cosine.
    let energy = |arm: &robot_model::simulate::Integrator<_>| {
        let speed = arm.dq()[0] * (1.0 + 0.3 * arm.q()[0].cos());
        0.5 * LINK * speed * speed
    };
    arm.advance(0.05).expect("a motion");
    let lost = 0.5 * LINK * speed * speed - energy(&arm);
    let work = 2.0 * (place(arm.q()[0]).sin() - place(0.2).sin());
    assert!(work > 0.05 && (lost - work).abs() < 1e-6, "{lost} {work}");
    arm.advance(2.0).expect("a motion");
    assert!(arm.dq()[0] == 0.0, "it comes to rest");
    let lost = 0.5 * LINK * speed * speed;
    let work = 2.0 * (place(arm.q()[0]).sin() - place(0.2).sin());
    assert!((lost - work).abs() < 1e-6, "{lost} {work}");
}

/// Displacement under a load.
type Law = fn(f64) -> f64;

#[test]
fn a_link_hangs_on_a_spring_of_any_law() {
    let laws: [(&str, Law); 3] = [
        (
            "-rigid_torque(j) / k - 0.02 * tanh(rigid_torque(j))",
            |load| -load / 200.0 - 0.02 * load.tanh(),
        ),
        // Twice as stiff beyond a load, and with a gap.
        (
            "-0.01 * sign(rigid_torque(j)) - min(rigid_torque(j), 1) / k - max(rigid_torque(j) - 1, 0) / (2 * k)",
            |load| -0.01 - 1.0 / 200.0 - (load - 1.0) / 400.0,
        ),
        // Its rest depends on where the motor is.
        ("0.1 * sin(q(j)) - rigid_torque(j)^3 / k", |load| {
            0.1 * f64::sin(0.3) - load.powi(3) / 200.0
        }),
    ];
    for (law, expected) in laws {
        let bent = format!("effect bent(j) {{ shape k in 10 .. 1000; position(j) = {law}; }}");
        let mut arm = arm(
            "0, -9.81, 0",
            &bent,
            "motor_inertia on turn; bent(k = 200) on turn;",
        );
        let q = arm.start(&still(&[0.3]));
        let load = WEIGHT * q[1].cos();
        let found = q[1] - q[0];
        assert!(
            (found - expected(load)).abs() < 1e-9,
            "{law}: {found} {}",
            expected(load)
        );
    }
}

/// Torque of the motor at rest, and its slopes by both positions.
fn torque(arm: &mut InterpretedPlant, displacement: f64) -> (f64, [f64; 2]) {
    let (q, rest) = ([0.3, 0.3 + displacement], [0.0; 2]);
    let at = Instant {
        dq: &rest,
        ddq: &rest,
        torque: &rest,
        ..still(&q)
    };
    let (mut torque, mut inertia) = (DVector::zeros(2), DMatrix::zeros(2, 2));
    arm.torque(&at, &mut torque, &mut inertia);
    let mut slopes = Slopes::zeros(arm);
    arm.slopes(&at, &mut slopes);
    (torque[0], [0, 1].map(|k| slopes.torque[0][(0, k)]))
}

/// Load by displacement, and its slope.
type Spring = fn(f64) -> [f64; 2];

#[test]
fn loads_of_all_sizes_are_found_with_their_slopes() {
    let laws: [(&str, Spring); 3] = [
        ("-rigid_torque(j)^3 / k", |x| {
            [
                (-200.0 * x).cbrt(),
                -200.0 / (3.0 * (200.0 * x).powi(2).cbrt()),
            ]
        }),
        // Far harder than a line: steps along its slope are tiny.
        (
            "-0.0001 * (exp(rigid_torque(j) / 0.1) - exp(-rigid_torque(j) / 0.1)) / (k / 200)",
            |x| {
                let x = -x / 2e-4;
                [0.1 * x.asinh(), -0.1 / 2e-4 / (1.0 + x * x).sqrt()]
            },
        ),
        (
            "-rigid_torque(j) / k - rigid_torque(j) * abs(rigid_torque(j)) / k",
            |x| {
                let root = (1.0 + 4.0 * 200.0 * x.abs()).sqrt();
                [-x.signum() * 0.5 * (root - 1.0), -200.0 / root]
            },
        ),
    ];
    for (law, expected) in laws {
        let bent = format!("effect bent(j) {{ shape k in 10 .. 1000; position(j) = {law}; }}");
        let mut arm = arm(FLAT, &bent, "motor_inertia on turn; bent(k = 200) on turn;");
        for k in 0..60 {
            for sign in [1.0, -1.0] {
                let x = sign * 1e-7 * 1.3_f64.powi(k);
                let [load, slope] = expected(x);
                let (found, slopes) = torque(&mut arm, x);
                // A displacement is a difference of positions, with their rounding.
                let within = 1e-9 * load.abs() + 1e-15 * slope.abs();
                assert!((found - load).abs() < within, "{law} {x}: {found} {load}");
                for (found, expected) in slopes.iter().zip([-slope, slope]) {
                    let within = 1e-6 * expected.abs();
                    assert!(
                        (found - expected).abs() < within,
                        "{law} {x}: {found} {expected}"
                    );
                }
            }
        }
    }
}

#[test]
fn a_channel_may_move_a_link_and_a_spring() {
    let warm = "effect warm(j) { input temperature; shape c in 0.001 .. 1; position(j) = c * temperature; }
        effect soft(j) { input temperature; shape k in 1 .. 1000; position(j) = -rigid_torque(j) * (temperature - 10) / k; }";
    let mut placed = arm("0, -9.81, 0", warm, "warm(c = 0.01) on turn;");
    assert!(placed.is_timed());
    let (mut torque, mut inertia) = (DVector::zeros(1), DMatrix::zeros(1, 1));
    let at = Instant {
        inputs: &[30.0],
        ..still(&[0.2])
    };
    placed.torque(&at, &mut torque, &mut inertia);
    assert!((torque[0] - WEIGHT * f64::cos(0.5)).abs() < 1e-12);
    // At no temperature the spring would rise: what counts is where it is used.
    let mut sprung = arm(
        "0, -9.81, 0",
        warm,
        "motor_inertia on turn; soft(k = 900) on turn;",
    );
    let q = sprung.start(&at);
    assert!((q[1] - q[0] + WEIGHT * q[1].cos() * 20.0 / 900.0).abs() < 1e-9);
}

#[test]
fn a_load_that_nothing_carries_is_told() {
    let stop = "effect stop(j) { shape k in 1 .. 1000; position(j) = -(1 + tanh(time - 0.05) * 50) * rigid_torque(j) / k; }";
    let plant = arm(
        "0, -9.81, 0",
        stop,
        "motor_inertia on turn; stop(k = 900) on turn;",
    );
    let mut moving = released(plant, &[0.0, 0.1], &[0.0, 0.0]);
    let error = moving
        .advance(1.0)
        .expect_err("no spring rises with its load");
    assert!(
        error
            .to_string()
            .contains("torque of joint 1 is not a number"),
        "{error}"
    );
}

#[test]
fn teeth_of_a_link_that_turns_about_itself_are_no_weaker_than_its_motor() {
    // No inertia at all about the axis at the position zero.
    let text = "robot Nod {
        gravity = [0, 0, -9.81];
        convention = standard_dh;
        joint yaw: revolute { a = 0; alpha = 90 deg; d = 0; }
        joint nod: revolute { a = 0; alpha = 0; d = 0; }
        link yaw { mass = 0; com = [0, 0, 0]; inertia = [0, 0, 0, 0, 0, 0]; }
        link nod { mass = 1; com = [0, 0.3, 0]; inertia = [0.09, 0, 0, 0, 0, 0.09]; }
        effects { motor_inertia on all; EFFECT on yaw; }
    }";
    for (effect, gap, stiffness) in [
        ("joint_elasticity(stiffness = 3e5)", 0.0, 3e5),
        (
            "backlash(half_gap = 5e-5)",
            5e-5,
            (std::f64::consts::TAU * 300.0).powi(2) * MOTOR / 101.0,
        ),
    ] {
        let text = text.replace("EFFECT", effect);
        let mut arm = plant(compiled(&text).ungrouped(), &[("motor_inertia.ia", MOTOR)]);
        let q = [0.0, 1.2, -1e-3];
        let rest = [0.0; 3];
        let at = Instant {
            dq: &rest,
            ddq: &rest,
            torque: &rest,
            ..still(&q)
        };
        let (mut torque, mut inertia) = (DVector::zeros(3), DMatrix::zeros(3, 3));
        arm.torque(&at, &mut torque, &mut inertia);
        assert!(
            (torque[0] - stiffness * (1e-3 - gap)).abs() < 1e-6 * torque[0],
            "{effect}: {torque}"
        );
    }
}

#[test]
fn teeth_without_give_move_as_springs_of_300_hz() {
    let stiffness = (std::f64::consts::TAU * 300.0).powi(2) * MOTOR * LINK / (MOTOR + LINK);
    let gap = "motor_inertia on turn; backlash(half_gap = 0.01) on turn;";
    let spring = format!("{gap} joint_elasticity(stiffness = {stiffness}) on turn;");
    let [mut teeth, mut spring] = [gap, &spring].map(|effects| {
        let plant = arm(FLAT, "", effects);
        released(plant, &[0.0, 0.0], &[0.0, 0.5])
    });
    let mut sides = [false; 2];
    for k in 1..=60 {
        let time = 0.002 * f64::from(k);
        teeth.advance(time).expect("a motion");
        spring.advance(time).expect("a motion");
        for (teeth, spring) in teeth.q().iter().zip(spring.q()) {
            assert!((teeth - spring).abs() < 1e-7, "{time}: {teeth} {spring}");
        }
        let lead = teeth.q()[0] - teeth.q()[1];
        assert!(lead.abs() < 0.01 + 0.5 / 1000.0, "{lead}");
        sides[usize::from(lead > 0.0)] |= lead.abs() > 0.0099;
    }
    assert_eq!(sides, [true; 2], "both sides are met");
    // Bounces are without loss: both have the momentum and the energy that they had.
    let moving = MOTOR * teeth.dq()[0].powi(2) + LINK * teeth.dq()[1].powi(2);
    let momentum = MOTOR * teeth.dq()[0] + LINK * teeth.dq()[1];
    let is_apart = (teeth.q()[0] - teeth.q()[1]).abs() < 0.01;
    assert!((momentum - LINK * 0.5).abs() < 1e-7);
    assert!(!is_apart || (moving - LINK * 0.25).abs() < 1e-5, "{moving}");
}
