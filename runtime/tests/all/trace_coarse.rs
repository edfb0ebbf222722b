//! The tracer on encoders so coarse that accelerations are mostly noise.

use super::laws::{Law, names};
use super::plant::{Pendulums, Plant};
use robot_model::columns::Candidate;
use robot_model::trace::{Outcome, Trace, Verdict};

/// Steps of the encoders, rad: of accelerations up to 30 Hz most is noise of these.
const COARSE: f64 = 2e-3;

fn trace(extra: fn(usize, [f64; 2], [f64; 2]) -> f64) -> Verdict {
    let laws = [0, 1].map(|joint| {
        [
            Law::new("torque-offset", joint, false, None, |_, _, _| 1.0),
            Law::new("quadratic-viscous", joint, true, None, |_, v, _| {
                v * v.abs()
            }),
        ]
    });
    let plant = Plant {
        encoder: COARSE,
        extra,
        ..Plant::default()
    };
    let candidates = laws.iter().flatten().map(|law| law as &dyn Candidate);
    Trace::new(candidates.collect())
        .run(&Pendulums::new(), &[plant.log()], &mut |_| ())
        .expect("the log is sound")
}

/// Beside the raw error of accelerations up to 30 Hz an offset of 0.7 N m does not matter; beside that of a calm motion it does.
#[test]
fn a_law_counts_beside_the_error_of_a_calm_motion() {
    let verdict = trace(|joint, _, _| if joint == 0 { 0.7 } else { 0.0 });
    assert_eq!(verdict.outcome, Outcome::Explained, "{verdict:#?}");
    assert_eq!(names(&verdict), [("torque-offset", 1)]);
}

#[test]
fn coarse_encoders_alone_are_nothing() {
    let verdict = trace(|_, _, _| 0.0);
    assert_eq!(verdict.outcome, Outcome::NothingMissing, "{verdict:#?}");
}
