//! How motions change with parameters, against differences of whole motions.

use nalgebra::DMatrix;
use robot_model::simulate::{Adjustable, Drive, Integrator, Plant, Tangent, Tolerances};
use robot_model_cli::interpreted::InterpretedPlant;

use crate::simulate::common::{compiled, pendulum_with, plant};

/// Where an arm starts, and the torque of each of its tenths of a second.
struct Motion {
    q: Vec<f64>,
    dq: Vec<f64>,
    torques: Vec<Vec<f64>>,
}

impl Motion {
    fn integrator(&self, arm: &InterpretedPlant, dq: &[f64]) -> Integrator<InterpretedPlant> {
        // Differences of motions are no better than the motions.
        let tolerances = Tolerances {
            relative: 1e-12,
            absolute: 1e-13,
            floor: 1e-9,
        };
        Integrator::new(arm.clone(), &self.q, dq, tolerances).expect("sound")
    }

    /// The end of it, with an initial velocity.
    fn end(&self, arm: &InterpretedPlant, dq: &[f64]) -> Vec<f64> {
        let mut moving = self.integrator(arm, dq);
        for (k, torque) in self.torques.iter().enumerate() {
            moving.drive(Drive {
                torque: torque.clone(),
                ..Drive::default()
            });
            moving.advance(0.1 * (k + 1) as f64).expect("a motion");
        }
        [moving.q(), moving.dq(), moving.memory()].concat()
    }

    /// Slopes of the end by all parameters and the first joint's initial velocity are those of differences, `within` a share of the
    /// largest; gives the slopes and how many events there were.
    fn check(&self, arm: &InterpretedPlant, within: f64) -> (DMatrix<f64>, u64) {
        let (n, u) = (arm.dof(), arm.parameters());
        let size = 2 * n + arm.states();
        let mut start = DMatrix::zeros(size, u + 1);
        start[(n, u)] = 1.0;
        let follow = |mut tangent: Tangent| {
            let mut moving = self.integrator(arm, &self.dq);
            for (k, torque) in self.torques.iter().enumerate() {
                moving.drive(Drive {
                    torque: torque.clone(),
                    ..Drive::default()
                });
                let end = 0.1 * (k + 1) as f64;
                moving.advance_with(end, &mut tangent).expect("a motion");
            }
            (tangent.state, moving.work().events)
        };
        let tangent = Tangent::new(arm, start);
        let (coarse, _) = follow(tangent.clone().coarse());
        let (slopes, events) = follow(tangent);
        for row in 0..size {
            let most = 2e-3 * (1.0 + slopes.row(row).amax());
            let away = (coarse.row(row) - slopes.row(row)).amax();
            assert!(away < most, "row {row}: {away} of {most}");
        }
        let values = arm.values();
        for column in 0..=u {
            let scale = values.get(column).map_or(1.0, |value| value.abs().max(0.1));
            let step = 1e-5 * scale;
            let [up, down] = [step, -step].map(|step| {
                let (mut arm, mut dq) = (arm.clone(), self.dq.clone());
                if column < u {
                    let mut values = values.clone();
                    values[column] += step;
                    arm.adjust(&values);
                } else {
                    dq[0] += step;
                }
                self.end(&arm, &dq)
            });
            for row in 0..size {
                let expected = (up[row] - down[row]) / (2.0 * step);
                let found = slopes[(row, column)];
                let most = within * (1.0 + slopes.row(row).amax());
                assert!(
                    (found - expected).abs() < most,
                    "row {row}, column {column}: {found} {expected}"
                );
            }
        }
        (slopes, events)
    }
}

/// Torques that turn both joints round and let them rest.
fn pushes() -> Vec<Vec<f64>> {
    let push = |k: i32| {
        let t = 0.1 * f64::from(k);
        if (9..12).contains(&k) {
            vec![0.0, 0.0]
        } else {
            vec![9.0 * (4.0 * t).sin(), 3.0 * (5.0 * t + 1.0).cos()]
        }
    };
    (0..18).map(push).collect()
}

#[test]
fn dry_friction_that_turns_round_and_sticks() {
    let arm = pendulum_with(
        "",
        "viscous_friction on all; coulomb_friction on all; stribeck on lower;",
    );
    let more = [
        ("viscous_friction.fv", 0.4),
        ("coulomb_friction.fc", 1.3),
        ("stribeck.fs", 0.4),
        ("stribeck.vs", 0.3),
    ];
    let arm = plant(arm, &more);
    let motion = Motion {
        q: vec![-1.2, 0.4],
        dq: vec![0.7, -0.3],
        torques: pushes(),
    };
    let (slopes, events) = motion.check(&arm, 2e-5);
    assert!(events >= 6, "{events}");
    assert!(slopes.amax() > 0.1);
}

#[test]
fn springs_memory_and_a_force_of_the_world() {
    let rub = "effect rub(j) { linear f; shape at in 0.01 .. 2; force(j) = [f * tanh(dq(j) / at) + f * sign(dq(j)), 0, f]; }
        effect wobble(j) { shape a in 0.01 .. 1; position(j) = a * sin(2 * q(j)); }";
    let arm = pendulum_with(
        rub,
        "rub on lower;
        motor_inertia on lower;
        joint_elasticity on lower;
        wobble on upper;
        dahl on lower;
        viscous_friction on all;
        coulomb_friction on upper;
        load_dependent_friction on lower;",
    );
    let more = [
        ("motor_inertia.ia", 0.1),
        ("joint_elasticity.stiffness", 200.0),
        ("viscous_friction.fv", 0.4),
        ("coulomb_friction.fc", 0.8),
        ("dahl.fc", 0.5),
        ("dahl.d", 0.05),
        ("load_dependent_friction.mu", 0.05),
        ("rub.f", 0.3),
        ("rub.at", 0.5),
        ("wobble.a", 0.1),
    ];
    let arm = plant(arm.ungrouped(), &more);
    assert_eq!((arm.dof(), arm.states()), (3, 1));
    let motion = Motion {
        q: vec![-1.2, 0.4, 0.39],
        dq: vec![0.7, -0.3, -0.2],
        torques: pushes(),
    };
    let (slopes, events) = motion.check(&arm, 3e-4);
    assert!(events >= 3, "{events}");
    // Elasticity and the encoder's error are among what the end follows.
    let columns = slopes.column_iter();
    let silent = columns.filter(|column| column.amax() == 0.0).count();
    assert!(silent <= 12, "{silent} columns of {}", slopes.ncols());
}

#[test]
fn links_that_other_joints_loads_displace() {
    let laws = "effect sag(j, k) { shape c in 0.0001 .. 1; position(k) = -0.004 * rigid_torque(k) + c * rigid_torque(j); }
        effect frame(j, k) {
            shape a in 0.0001 .. 1; shape b in 0.0001 .. 1;
            position(j) = -a * rigid_torque(j) - b * rigid_torque(k);
            position(k) = -b * rigid_torque(j) - 2 * a * (rigid_torque(k) + rigid_torque(k)^3 / 100);
        }";
    for (effect, links) in [("sag", 1), ("frame", 2)] {
        let effects =
            format!("motor_inertia on all; viscous_friction on all; {effect} on (upper, lower);");
        let more = [
            ("motor_inertia.ia", 0.3),
            ("viscous_friction.fv", 0.4),
            ("sag.c", 0.0005),
            ("frame.a", 0.004),
            ("frame.b", 0.002),
        ];
        let arm = plant(pendulum_with(laws, &effects).ungrouped(), &more);
        assert_eq!(arm.dof(), 2 + links);
        let start = [-1.2, 0.4, -1.2, 0.4];
        let q = match links {
            1 => vec![-1.2, 0.4, 0.4],
            _ => start.to_vec(),
        };
        let motion = Motion {
            dq: vec![0.0; q.len()],
            q,
            torques: pushes()[..6].to_vec(),
        };
        let (slopes, _) = motion.check(&arm, 1e-4);
        assert!(slopes.amax() > 0.1);
    }
}

/// Bristles of 2 mrad under a joint that slides at 5 rad/s settle in half a millisecond, and an explicit step at the border of its
/// stability shows no error of what has settled: sensitivities may not grow there. The joint slides at `(tau - fc) / fv`.
#[test]
fn bristles_under_a_joint_that_slides_fast() {
    const TAU: f64 = 2.2;
    let [fc, fv, s1] = [0.6, 0.3, 2.0];
    let arm = compiled(
        "robot Turntable {
            gravity = [0, 0, -9.81];
            convention = standard_dh;
            joint turn: revolute { a = 0.3; alpha = 0; d = 0; }
            link turn { mass = 3; com = [0, 0, 0]; inertia = [0.01, 0, 0, 0.01, 0, 0.05]; }
            effects { viscous_friction on turn; lugre_presliding(d = 2e-3, vs = 0.1, rise = 0.8) on turn; }
        }",
    );
    let more = [
        ("viscous_friction.fv", fv),
        ("lugre_presliding.fc", fc),
        ("lugre_presliding.s1", s1),
    ];
    let arm = plant(arm, &more);
    let (n, u) = (arm.dof(), arm.parameters());
    let start = DMatrix::zeros(2 * n + arm.states(), u);
    let mut tangent = Tangent::new(&arm, start);
    let tolerances = Tolerances::default();
    let mut moving = Integrator::new(arm.clone(), &[0.0], &[0.0], tolerances).expect("sound");
    moving.drive(Drive {
        torque: vec![TAU],
        ..Drive::default()
    });
    moving.advance_with(10.0, &mut tangent).expect("a motion");
    let speed = (TAU - fc) / fv;
    assert!((moving.dq()[0] - speed).abs() < 1e-2, "{:?}", moving.dq());
    let values = arm.values();
    for (value, slope) in [(fc, -1.0 / fv), (fv, -speed / fv), (s1, 0.0)] {
        let column = values
            .iter()
            .position(|known| (known - value).abs() < 1e-12);
        let found = tangent.state[(n, column.expect("a parameter"))];
        assert!((found - slope).abs() < 0.1, "{value}: {found}, {slope}");
    }
}
