//! Dry friction: rest, breakaway, joints that hold each other.

use robot_model::simulate::{Integrator, Loop};
use robot_model_cli::interpreted::InterpretedPlant;

use crate::simulate::common::{Law, compiled, plant, released, spec, still};

/// Seed 001's arm with the parameters that it was identified with.
const PNEUMATIC: [(&str, f64); 4] = [
    ("q1.viscous_friction.fv", 0.335),
    ("q2.viscous_friction.fv", 0.279),
    ("q1.coulomb_friction.fc", 0.203),
    ("q2.coulomb_friction.fc", 0.076),
];

fn pneumatic(q: [f64; 2]) -> Integrator<InterpretedPlant> {
    released(
        plant(spec("pneumatic_arm", true), &PNEUMATIC),
        &q,
        &[0.0; 2],
    )
}

/// Seed 001: the arm is let go, and does not come to rest where it hangs straight down but where friction holds it.
#[test]
fn an_arm_that_is_let_go_rests_inside_the_dead_band_and_stays() {
    // Weights of the spec's CAD values.
    let (m1, m2, l1, c1, c2, g) = (5.914, 3.437, 0.615, 0.293, 0.19, 9.81);
    for degrees in [10.0_f64, 20.0, 30.0, 40.0] {
        let mut arm = pneumatic([degrees.to_radians(), 0.0]);
        // From 30 degrees it still swings after twenty seconds.
        arm.advance(60.0).expect("a motion");
        assert_eq!(arm.dq(), [0.0, 0.0], "{degrees}");
        assert_eq!(arm.held(), [true, true]);
        let rest = arm.q().to_vec();
        let second = g * m2 * c2 * (rest[0] + rest[1]).sin();
        let first = g * (m1 * c1 + m2 * l1) * rest[0].sin() + second;
        assert!(
            first.abs() <= 0.203 && second.abs() <= 0.076,
            "{first} {second}"
        );
        assert!(rest.iter().any(|q| q.abs() > 1e-6), "{rest:?}");
        // Not a bit of creep.
        arm.advance(1060.0).expect("rest");
        assert_eq!(arm.q(), rest);
        let work = arm.work();
        assert!(work.events < 200 && work.impulses == 0, "{work:?}");
        assert!(work.explicit + work.implicit < 20_000, "{work:?}");
    }
}

/// A block on a table: it stands up to its friction, then moves with what is left.
#[test]
fn a_block_breaks_away_at_its_friction() {
    let text = "robot Block {
        coordinates x: m;
        parameters m = 2 kg;
        kinetic = m/2*dot(x)^2;
        potential = 0;
        effects { coulomb_friction on x; }
    }";
    let arm = plant(compiled(text), &[("fc", 3.0)]);
    // The push grows by 1 N a second, in steps of a millisecond.
    let setting = Loop {
        duration: 5.0,
        ..Loop::default()
    };
    let mut push = Law(|measured: &robot_model::simulate::Measured<'_>| measured.time);
    let run = setting.run(arm, &mut push, &still(&[0.0]), &mut |_| {});
    let (record, end) = run.expect("a motion");
    let at = |time: f64| {
        record
            .time
            .iter()
            .position(|&t| t >= time - 1e-9)
            .expect("logged")
    };
    assert_eq!(record.q[0][at(3.0)].to_bits(), 0.0_f64.to_bits());
    // m v = sum of (push - friction) over the samples from the first that exceeds it.
    let samples = f64::from(5000 - 3000);
    let speed = 1e-3 * 1e-3 * samples * (samples - 1.0) / 2.0 / 2.0;
    assert!(
        (end.dq()[0] - speed).abs() < 1e-9,
        "{} {speed}",
        end.dq()[0]
    );
    assert_eq!(end.work().events, 0, "it begins to move with a sample");
}

/// Friction of two joints and of the motor between them, three contacts on two joints: they hold together what none holds alone.
#[test]
fn coupled_joints_hold_together() {
    let text = "robot Wrist {
        coordinates a, b;
        parameters I = 1 kg*m^2, J = 1 kg*m^2;
        kinetic = I/2*dot(a)^2 + J/2*dot(b)^2;
        potential = 0;
        effects { coulomb_friction on all; gear_coupling on (a, b); }
    }";
    let values = [
        ("coulomb_friction.fc", 1.0),
        ("gear_coupling.fc", 1.0),
        ("gear_coupling.fv", 0.0),
        ("gear_coupling.ia", 0.1),
    ];
    let arm = || released(plant(compiled(text), &values), &[0.0; 2], &[0.0; 2]);
    let pushed = |torque: [f64; 2]| {
        let mut arm = arm();
        arm.drive(robot_model::simulate::Drive {
            torque: torque.to_vec(),
            ..Default::default()
        });
        arm.advance(0.5).expect("a motion");
        (arm.q().to_vec(), arm.held())
    };
    // One joint alone holds 1, both together with the motor 2 each.
    assert_eq!(pushed([1.7, 1.7]).0, [0.0, 0.0]);
    assert_eq!(pushed([1.5, 0.4]).0, [0.0, 0.0]);
    let (q, _) = pushed([2.4, 2.4]);
    assert!(q[0] > 0.0 && (q[0] - q[1]).abs() < 1e-12, "{q:?}");
    // Against each other the motor does not turn, and does not hold.
    let (q, _) = pushed([1.5, -1.5]);
    assert!(q[0] > 0.0 && (q[0] + q[1]).abs() < 1e-12, "{q:?}");
}

/// A gear whose friction grows with its load stands, and slides, as a block on a slope does.
#[test]
fn friction_that_depends_on_the_load_holds_what_is_flat_enough() {
    let text = |push: f64| {
        format!(
            "robot Slope {{
            coordinates x: m;
            parameters m = 1 kg;
            constants g = {push} m/s^2;
            kinetic = m/2*dot(x)^2;
            potential = -m*g*x;
            effects {{ load_dependent_friction on x; coulomb_friction on x; }}
        }}"
        )
    };
    let run = |push: f64| {
        let values = [("mu", 0.3), ("fc", 1.0)];
        let mut arm = released(plant(compiled(&text(push)), &values), &[0.0], &[0.0]);
        arm.advance(1.0).expect("a motion");
        arm.q()[0]
    };
    // The load of rest is -push: held while push <= 0.3 push + 1.
    assert!(run(1.4) == 0.0, "held arms do not creep");
    // ddq - push + (0.3 |ddq - push| + 1) = 0 with a load below zero.
    let push = 2.0;
    let acceleration = push - 1.0 / 0.7;
    assert!(
        (run(push) - 0.5 * acceleration).abs() < 1e-9,
        "{}",
        run(push)
    );
}

/// Friction far above what the arm's motion takes, at every joint and in every sample: the steps stay few.
#[test]
fn large_friction_does_not_shorten_steps() {
    let values = [
        ("viscous_friction.fv", 0.3),
        ("q1.coulomb_friction.fc", 20.0),
        ("q2.coulomb_friction.fc", 5.0),
    ];
    let arm = plant(spec("pneumatic_arm", true), &values);
    let setting = Loop {
        duration: 2.0,
        ..Loop::default()
    };
    let mut shake =
        Law(|measured: &robot_model::simulate::Measured<'_>| 60.0 * (40.0 * measured.time).sin());
    let run = setting.run(arm, &mut shake, &still(&[0.2, 0.1]), &mut |_| {});
    let (record, _) = run.expect("a motion");
    let work = record.work;
    // 2000 samples and as many instants of the log.
    let steps = work.explicit + work.implicit + work.impulses;
    assert!(steps < 8_000 && work.rejected < 2_000, "{work:?}");
    assert!(work.events > 20, "{work:?}");
}

/// Pulled to the middle from either side, and slowed by friction all the way: every pass is shorter than the one before, infinitely
/// many in a finite time.
#[test]
fn jumps_that_crowd_end_in_impulses() {
    let text = "
    effect pull(j) {
        /// Towards the middle, whichever side.
        linear f >= 0;
        torque(j) = f * sign(q(j));
    }
    robot Valley {
        coordinates x: m;
        parameters m = 1 kg;
        kinetic = m/2*dot(x)^2;
        potential = 0;
        effects { pull on x; coulomb_friction on x; }
    }";
    let values = [("pull.f", 10.0), ("fc", 3.0)];
    let mut arm = released(plant(compiled(text), &values), &[0.01], &[0.0]);
    arm.advance(3.0).expect("a motion");
    let (q, dq) = (arm.q()[0], arm.dq()[0]);
    assert!(q.abs() < 1e-5 && dq.abs() < 1e-2, "{q} {dq}");
    let work = arm.work();
    assert!(work.impulses > 0, "{work:?}");
    let steps = work.events + work.explicit + work.implicit + work.impulses + work.rejected;
    assert!(steps < 200_000, "{work:?}");
}
