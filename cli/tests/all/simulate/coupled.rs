//! Links that loads of other joints displace, and velocities, accelerations, states and torques of motors.

use nalgebra::{DMatrix, DVector};
use robot_model::simulate::{Instant, Plant};
use robot_model_cli::interpreted::InterpretedPlant;

use crate::simulate::common::{compiled, pendulum_with, plant, released, resting};
use crate::simulate::differences::{State, differences};

/// Masses of motors, and of the links that each joint moves, kg.
const MOTORS: [f64; 2] = [3.0, 2.0];
const LINKS: [f64; 2] = [5.0, 1.5];

/// Two carriages across each other, whose masses are apart.
fn gantry(definitions: &str, effects: &str, more: &[(&str, f64)]) -> InterpretedPlant {
    let text = format!(
        "{definitions}
        robot Gantry {{
            gravity = [0, 0, 0];
            convention = standard_dh;
            joint x: prismatic {{ a = 0; alpha = 90 deg; theta = 0; }}
            joint y: prismatic {{ a = 0; alpha = 0; theta = 0; }}
            link x {{ mass = {}; com = [0, 0, 0]; inertia = [0, 0, 0, 0, 0, 0]; }}
            link y {{ mass = {}; com = [0, 0, 0]; inertia = [0, 0, 0, 0, 0, 0]; }}
            effects {{ motor_inertia on all; {effects} }}
        }}",
        LINKS[0] - LINKS[1],
        LINKS[1],
    );
    let motors = [("x.motor_inertia.ia", 3.0), ("y.motor_inertia.ia", 2.0)];
    plant(compiled(&text).ungrouped(), &[&motors, more].concat())
}

/// The motion of `M x'' = -K x` at a time, by the exponential of its matrix.
fn linear(mass: &[f64], k: &DMatrix<f64>, start: &DVector<f64>, time: f64) -> DVector<f64> {
    let n = mass.len();
    let mut rate = DMatrix::zeros(2 * n, 2 * n);
    for row in 0..n {
        rate[(row, n + row)] = 1.0;
        for column in 0..n {
            rate[(n + row, column)] = -k[(row, column)] / mass[row];
        }
    }
    (rate * time).exp() * start
}

#[test]
fn springs_that_bend_each_other_move_as_their_modes() {
    // `q_l - q = -C R`, with a compliance that couples both.
    let frame = "effect frame(j, k) {
        shape a in 0.0001 .. 1; shape b in 0.0001 .. 1; shape c in 0.0001 .. 1;
        position(j) = -a * rigid_torque(j) - b * rigid_torque(k);
        position(k) = -b * rigid_torque(j) - c * rigid_torque(k);
    }";
    // The second of two is nearly one spring for both.
    for b in [0.0015, 0.0028] {
        let least = swing(
            &gantry(
                frame,
                &format!("frame(a = 0.002, b = {b}, c = 0.004) on (x, y);"),
                &[],
            ),
            b,
        );
        assert!(least < -0.01, "it swings: {least}");
    }
}

/// How far the first link swings back from its motor, as the modes of both springs have it.
fn swing(arm: &InterpretedPlant, b: f64) -> f64 {
    let compliance = DMatrix::from_row_slice(2, 2, &[0.002, b, b, 0.004]);
    let stiffness = compliance.try_inverse().expect("stiff");
    // Motors, then links.
    let mut k = DMatrix::zeros(4, 4);
    for (row, column, sign) in [(0, 0, 1.0), (0, 2, -1.0), (2, 0, -1.0), (2, 2, 1.0)] {
        k.view_mut((row, column), (2, 2))
            .copy_from(&(&stiffness * sign));
    }
    let mass = [MOTORS[0], MOTORS[1], LINKS[0], LINKS[1]];
    let (q, dq) = ([0.1, -0.05, 0.13, -0.08], [0.5, 0.0, -0.2, 0.9]);
    let start = DVector::from_iterator(8, q.into_iter().chain(dq));
    let mut arm = released(arm.clone(), &q, &dq);
    let mut least = f64::INFINITY;
    for step in 1..=30 {
        let time = 0.1 * f64::from(step);
        arm.advance(time).expect("a motion");
        let expected = linear(&mass, &k, &start, time);
        for (found, expected) in arm.q().iter().zip(expected.iter()) {
            assert!(
                (found - expected).abs() < 1e-6,
                "{time}: {found} {expected}"
            );
        }
        least = least.min(arm.q()[2] - arm.q()[0]);
    }
    least
}

pub const BELT: &str = "effect soft_belt(j, k) {
    shape stiffness in 100 .. 100000;
    position(j) = -rigid_torque(j) / stiffness;
    position(k) = rigid_torque(j) / stiffness;
}";

#[test]
fn a_belt_takes_the_next_joint_along() {
    let arm = gantry(BELT, "soft_belt(stiffness = 900) on (x, y);", &[]);
    assert_eq!((arm.dof(), arm.joints()), (4, 2));
    // Were the second link held to `q_y + q_x - l_x` by nothing that gives: `l_y'' = q_y'' + q_x'' - l_x''` is driven by what the
    // second motor gives, none, so `2 q_y'' + 1.5 l_y'' = 0`.
    let k = 900.0;
    let [motor, other] = MOTORS;
    let [first, second] = LINKS;
    let wave = k / motor + k / first;
    let (bent, turn) = (0.01, wave.sqrt());
    let mut arm = released(arm, &[0.0, 0.0, -bent, bent], &[0.0; 4]);
    // What the belt is bent by falls to `-bent cos(turn t)`, and the second pair moves against it by their masses.
    for step in 1..=40 {
        let time = 0.05 * f64::from(step);
        arm.advance(time).expect("a motion");
        let x = -bent * (turn * time).cos();
        let moved = second / (other + second) * (x + bent);
        let [qx, qy, lx, ly] = [0, 1, 2, 3].map(|j| arm.q()[j]);
        assert!((lx - qx - x).abs() < 1e-6, "{time}: {} {x}", lx - qx);
        assert!((ly - qy + x).abs() < 5e-6, "{time}: {} {x}", ly - qy);
        assert!((qy - moved).abs() < 5e-6, "{time}: {qy} {moved}");
    }
}

#[test]
fn a_belt_hangs_where_its_loads_put_it() {
    // The language's own example: the wrist is turned back by what the shoulder's belt gives.
    let text = format!(
        "{BELT}
        robot Picker {{
            gravity = [0, -9.81, 0];
            convention = standard_dh;
            joint shoulder: revolute {{ a = 0.4; alpha = 0; d = 0; }}
            joint wrist: revolute {{ a = 0.2; alpha = 0; d = 0; }}
            link shoulder {{ mass = 2; com = [-0.2, 0, 0]; inertia = [0.01, 0, 0, 0.03, 0, 0.03]; }}
            link wrist {{ mass = 1; com = [-0.1, 0, 0]; inertia = [0.01, 0, 0, 0.01, 0, 0.01]; }}
            effects {{ motor_inertia on all; soft_belt(stiffness = 300) on (shoulder, wrist); }}
        }}"
    );
    let motors = [("motor_inertia.ia", 0.2)];
    let mut arm = plant(compiled(&text).ungrouped(), &motors);
    let at = Instant {
        time: 0.0,
        q: &[0.2, 0.4],
        dq: &[0.0; 2],
        ddq: &[0.0; 2],
        memory: &[],
        switches: &[],
        torque: &[0.0; 2],
        inputs: &[],
    };
    let q = arm.start(&at);
    let weight = 9.81 * (0.8 * q[2].cos() + 0.1 * (q[2] + q[3]).cos());
    let bent = q[2] - q[0];
    assert!((bent + weight / 300.0).abs() < 1e-9, "{bent} {weight}");
    assert!((q[3] - q[1] + bent).abs() < 2e-5, "{q:?}");
}

#[test]
fn links_follow_what_has_no_load_of_their_own() {
    let laws = "effect lead(j) { position(j) = 0.02 * dq(j); }
        effect late(j) { state y; dot(y) = (q(j) - y) / 0.02; position(j) = y - q(j); }
        effect push(j) { position(j) = measured_torque(j) / 1000; }
        effect lift(j) { position(j) = 0.001 * ddq(j); }";
    for (name, states, least) in [
        ("lead", 0, 3e-3),
        ("late", 1, 3e-3),
        ("push", 0, 1e-3),
        ("lift", 0, 2e-4),
    ] {
        let mut most = 0.0_f64;
        let effects = format!("{name} on x;");
        let arm = gantry(laws, &effects, &[]);
        assert_eq!(
            (arm.dof(), arm.states(), arm.is_affine()),
            (3, states, true)
        );
        let mut moving = released(arm, &[0.0; 3], &[0.0; 3]);
        let (mut before, mut time) = (0.0, 0.0);
        let drive = |time: f64| 4.0 * (6.0 * time).sin();
        for step in 1..=400 {
            moving.drive(robot_model::simulate::Drive {
                torque: vec![drive(time), 0.0],
                ..Default::default()
            });
            time = 0.002 * f64::from(step);
            moving.advance(time).expect("a motion");
            let [q, dq] = [moving.q()[0], moving.dq()[0]];
            let led = match name {
                "lead" => 0.02 * dq,
                "late" => moving.memory()[0] - q,
                "push" => drive(time - 0.002) / 1000.0,
                _ => {
                    // What teeth give apart, the mean of `ddq` over the step is near that at its middle.
                    let ddq = (dq - before) / 0.002;
                    before = dq;
                    0.001 * ddq
                }
            };
            let found = moving.q()[2] - q;
            assert!(
                (found - led).abs() < 0.1 * least,
                "{name} {time}: {found} {led}"
            );
            most = most.max(found.abs());
        }
        assert!(most > least, "{name}: {most}");
    }
}

#[test]
fn slopes_of_coupled_springs_are_those_of_differences() {
    let laws = "effect frame(j, k) {
        shape a in 0.0001 .. 1; shape b in 0.0001 .. 1; shape c in 0.0001 .. 1;
        state y;
        dot(y) = rigid_torque(k) * 0.1 - y + rigid_torque(j)^2 * 0.01;
        position(j) = -a * rigid_torque(j) - b * tanh(rigid_torque(k)) + 0.01 * ddq(k) + 0.03 * dq(j) * q(k) + 0.1 * y;
        position(k) = b * rigid_torque(j)^2 - c * (rigid_torque(k) + rigid_torque(k)^3);
    }
    effect sag(j, k) { position(k) = -0.004 * rigid_torque(k) + 0.01 * rigid_torque(j); }";
    let more = [
        ("motor_inertia.ia", 0.1),
        ("dahl.fc", 0.7),
        ("dahl.d", 0.05),
        ("load_dependent_friction.mu", 0.1),
        ("frame.a", 0.03),
        ("frame.b", 0.004),
        ("frame.c", 0.02),
    ];
    // Both on springs that read each other, and one on a spring that reads the load of a stiff joint.
    for (effects, dof) in [
        ("frame on (upper, lower);", 4),
        ("sag on (upper, lower);", 3),
    ] {
        let effects = format!(
            "motor_inertia on all; dahl on lower; load_dependent_friction on all; {effects}"
        );
        let mut arm = plant(pendulum_with(laws, &effects).ungrouped(), &more);
        assert_eq!(arm.dof(), dof);
        let behind = [0.27, -0.43];
        let q: Vec<f64> = [0.3, -0.4]
            .into_iter()
            .chain(behind[4 - dof..].iter().copied())
            .collect();
        let state: State = [
            q,
            vec![0.7, -0.9, 0.4, 0.2][..dof].to_vec(),
            vec![1.1, 2.3, -0.6, 0.9][..dof].to_vec(),
            vec![0.03, 0.004][..arm.states()].to_vec(),
        ];
        let [q, dq, ddq, _] = differences(&mut arm, &state);
        assert!(q[(dof - 1, 0)] != 0.0 && dq[(1, 0)] != 0.0);
        // Accelerations reach what springs carry.
        assert!((ddq.row(1).sum() - 0.1).abs() > 0.01, "{ddq}");
    }
}

#[test]
fn a_spring_that_is_not_bent_has_a_slope() {
    // Motors of 3 and 2 kg; the second moment of `M (q + 0.001 ddq)'' + 3 ddq` is all in the teeth's bend.
    let lift = "effect lift(j) { position(j) = 0.001 * ddq(j); }";
    let [at_zero, near] = [0.0, 1e-14].map(|bent| {
        let mut arm = gantry(lift, "lift on x;", &[]);
        let (q, still) = ([0.0, 0.0, bent], [0.0; 3]);
        let (mut torque, mut inertia) = (DVector::zeros(3), DMatrix::zeros(3, 3));
        arm.torque(&resting(&q, &still), &mut torque, &mut inertia);
        inertia
    });
    assert!(
        (&at_zero - &near).amax() < 1e-9 * near.amax(),
        "{at_zero} {near}"
    );
    assert!(near[(0, 0)] > 100.0, "{near}");
}

#[test]
fn a_displacement_that_is_no_number_is_told() {
    let root = "effect root(j) { position(j) = -0.01 * rigid_torque(j) + 0.005 * sqrt(dq(j)); }";
    let arm = gantry(root, "root on x;", &[]);
    let mut moving = released(arm, &[0.0; 3], &[-0.1, 0.0, -0.1]);
    let error = moving.advance(0.1).expect_err("no root");
    assert!(
        error
            .to_string()
            .contains("torque of joint 1 is not a number"),
        "{error}"
    );
}
