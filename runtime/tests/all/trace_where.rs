//! Where a law that has no name lives, and pulses that follow no curve.

use super::laws::{Law, names};
use super::plant::{Pendulums, Plant, sign};
use robot_model::columns::{Arm, Candidate, Columns, Entry, Shape, Unknown};
use robot_model::motion::Motion;
use robot_model::trace::{Outcome, Quantity, Trace, Verdict};

/// The pendulums, which say that their joints have dry friction.
struct Dry(Pendulums);

impl Columns for Dry {
    fn unknowns(&self) -> &[Unknown] {
        self.0.unknowns()
    }

    fn shapes(&self) -> &[Shape] {
        self.0.shapes()
    }

    fn uses_rigid_torque(&self) -> bool {
        self.0.uses_rigid_torque()
    }

    fn entries(&self, motion: &Motion, shapes: &[f64]) -> Vec<Entry> {
        self.0.entries(motion, shapes)
    }
}

impl Arm for Dry {
    fn dof(&self) -> usize {
        self.0.dof()
    }

    fn joints(&self) -> &[String] {
        self.0.joints()
    }

    fn actuator_gain(&self) -> &[f64] {
        self.0.actuator_gain()
    }

    fn known_torque(&self, motion: &Motion, shapes: &[f64]) -> Vec<Vec<f64>> {
        self.0.known_torque(motion, shapes)
    }

    fn rigid_torque(&self, motion: &Motion, shapes: &[f64], estimate: &[f64]) -> Vec<Vec<f64>> {
        self.0.rigid_torque(motion, shapes, estimate)
    }

    fn dry_joints(&self) -> &[usize] {
        &[0, 1]
    }
}

/// With one law on each joint that is none of those below.
fn trace(plant: &Plant) -> Verdict {
    let library = [0, 1].map(|joint| Law::new("joint-spring", joint, true, None, |q, _, _| q));
    let candidates = library.iter().map(|law| law as &dyn Candidate).collect();
    Trace::new(candidates)
        .run(&Dry(Pendulums::new()), &[plant.log()], &mut |_| ())
        .expect("the logs are sound")
}

/// Dry friction that depends on where another joint is, as of cables that run over both.
#[test]
fn friction_over_the_position_of_another_joint_is_told_as_such() {
    for periodic in [true, false] {
        let verdict = trace(&Plant {
            extra: |j, q, v| {
                if j == 0 {
                    1.5 * sign(v[0]) * (2.0 * q[1]).sin()
                } else {
                    0.0
                }
            },
            periodic,
            ..Plant::default()
        });
        assert_eq!(verdict.outcome, Outcome::Unexplained, "{verdict:#?}");
        assert!(names(&verdict).is_empty() && verdict.leads.is_empty());
        let most = &verdict.left[0].shares[0];
        assert!(
            most.of == Quantity::VelocityAndPosition(0, 1) && most.share > 0.6,
            "{:?}",
            verdict.left
        );
    }
}

/// Impacts of some milliseconds take next to no share of the motion, and no curve follows them.
#[test]
fn pulses_are_no_noise() {
    let with = |extra| {
        trace(&Plant {
            extra,
            periodic: false,
            ..Plant::default()
        })
    };
    let verdict = with(|_, _, _| 0.0);
    assert_eq!(verdict.outcome, Outcome::NothingMissing, "{verdict:#?}");
    for floor in &verdict.noise_floor {
        let share = floor.pulses.expect("the motion does not repeat");
        assert!(share < 0.45 && floor.pulsed().is_none(), "{share}");
    }
    // Now and then, one way and the other.
    let verdict = with(|j, q, v| {
        let is_near = (40.0 * q[0]).sin() > 0.995 && (7.0 * q[1] + v[1]).sin() > 0.6;
        if j == 0 && is_near {
            12.0 * (300.0 * q[1]).sin()
        } else {
            0.0
        }
    });
    assert_eq!(verdict.outcome, Outcome::Unexplained, "{verdict:#?}");
    assert!(
        verdict.noise_floor[0].pulsed().is_some(),
        "{:?}",
        verdict.noise_floor
    );
    assert!(
        verdict.noise_floor[1].pulsed().is_none(),
        "{:?}",
        verdict.noise_floor
    );
}
