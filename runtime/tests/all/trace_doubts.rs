//! Laws that pass most gates and are not to be named: what is told of them.

use super::laws::{Law, names};
use super::plant::{Pendulums, Plant, column};
use robot_model::columns::{Candidate, Columns, Entry, Shape, Unknown};
use robot_model::motion::{Kinematics, Motion};
use robot_model::trace::{MOST_EFFECTS, Outcome, Refusal, Trace, Verdict};

/// Two columns that are nearly one: their sum is told, neither of their parameters is.
struct Traded([Unknown; 2]);

impl Traded {
    fn new() -> Self {
        Self(["a", "b"].map(|name| Unknown {
            name: format!("joint1.traded.{name}"),
            nonnegative: false,
        }))
    }
}

impl Columns for Traded {
    fn unknowns(&self) -> &[Unknown] {
        &self.0
    }

    fn shapes(&self) -> &[Shape] {
        &[]
    }

    fn uses_rigid_torque(&self) -> bool {
        false
    }

    fn entries(&self, motion: &Motion, _: &[f64]) -> Vec<Entry> {
        let Kinematics { q, dq, .. } = &motion.wide;
        let drag = || dq[0].iter().map(|v| v * v.abs());
        let other = drag()
            .zip(&q[0])
            .map(|(drag, q)| drag + 2e-3 * (9.0 * q).sin());
        vec![column(drag(), 0, 0), column(other, 0, 1)]
    }
}

impl Candidate for Traded {
    fn kind(&self) -> &'static str {
        "traded"
    }

    fn joints(&self) -> &[usize] {
        &[0]
    }
}

/// A law whose parameters trade with each other is not told by its fit, unless that is most of what is missing.
#[test]
fn a_law_whose_parameters_trade_is_told_where_it_is_most_of_the_error() {
    let traded = |extra: fn(usize, [f64; 2], [f64; 2]) -> f64| {
        let plant = Plant {
            extra,
            ..Plant::default()
        };
        Trace::new(vec![&Traded::new()])
            .run(&Pendulums::new(), &[plant.log()], &mut |_| ())
            .expect("the log is sound")
    };
    let small = traded(|j, _, v| {
        if j == 0 {
            0.015 * v[0] * v[0].abs()
        } else {
            0.0
        }
    });
    assert!(small.findings.is_empty(), "{small:#?}");
    assert_eq!(
        small.tried[0].refusals,
        [Refusal::Undetermined],
        "{small:#?}"
    );
    let large = traded(|j, _, v| if j == 0 { 0.6 * v[0] * v[0].abs() } else { 0.0 });
    assert_eq!(names(&large), [("traded", 1)], "{large:#?}");
}

/// Waves of the first joint's position, of few periods and of many, and a spring, which is even where gravity is odd.
fn of_position() -> [Law; 3] {
    let waves =
        |kind, numbers: Vec<f64>| Law::new(kind, 0, false, Some(numbers), |q, _, k| (k * q).sin());
    [
        Law::new("spring", 0, false, None, |q, _, _| q * q),
        waves("wave", (8..30).map(|k| 0.25 * f64::from(k)).collect()),
        waves("ripple", (35..46).map(f64::from).collect()),
    ]
    .map(Law::of_position)
}

/// A spring and a wave fit many curves of a position; a spring and a ripple do not, but with another ripple they do.
#[test]
fn curves_of_one_position_are_terms_of_a_series() {
    let traced = |extra: fn(usize, [f64; 2], [f64; 2]) -> f64| {
        let plant = Plant {
            extra,
            periodic: false,
            seconds: 60,
            ..Plant::default()
        };
        let laws = of_position();
        Trace::new(laws.iter().map(|law| law as &dyn Candidate).collect())
            .run(&Pendulums::new(), &[plant.log()], &mut |_| ())
            .expect("the log is sound")
    };
    let series = traced(|j, q, _| {
        if j == 0 {
            3.0 * q[0] * q[0] + 0.4 * (3.5 * q[0]).sin()
        } else {
            0.0
        }
    });
    assert_eq!(series.outcome, Outcome::Unexplained, "{series:#?}");
    assert_eq!(
        (series.series.as_slice(), series.leads.len()),
        (&[0][..], 2),
        "{series:#?}"
    );
    let ripple = traced(|j, q, _| {
        if j == 0 {
            3.0 * q[0] * q[0] + 0.4 * (40.0 * q[0]).sin()
        } else {
            0.0
        }
    });
    let mut found = names(&ripple);
    found.sort_unstable();
    assert_eq!(found, [("ripple", 1), ("spring", 1)], "{ripple:#?}");
    assert!(ripple.series.is_empty());
    // Waves for every bump.
    let ripples = traced(|j, q, _| {
        if j == 0 {
            3.0 * q[0] * q[0] + 0.4 * (38.0 * q[0]).sin() + 0.5 * (44.0 * q[0]).sin()
        } else {
            0.0
        }
    });
    assert_eq!(
        (ripples.series.as_slice(), ripples.leads.len()),
        (&[0][..], 3),
        "{ripples:#?}"
    );
    assert_eq!(ripples.outcome, Outcome::Unexplained);
}

/// A trace that goes on from one in which an effect changed the arm has so many fewer to name.
#[test]
fn effects_of_an_earlier_trace_count_among_the_most() {
    let drag = |joint: usize| {
        Law::new("quadratic-viscous", joint, true, None, |_, v, _| {
            v * v.abs()
        })
    };
    let laws = [drag(0), drag(1)];
    let plant = Plant {
        extra: |joint, _, v| 0.6 * v[joint] * v[joint].abs(),
        ..Plant::default()
    };
    let logs = [plant.log()];
    let trace = || Trace::new(laws.iter().map(|law| law as &dyn Candidate).collect());
    let run = |trace: Trace| {
        trace
            .run(&Pendulums::new(), &logs, &mut |_| ())
            .expect("the log is sound")
    };
    let mut earlier = run(Trace::new(vec![&laws[0]]));
    let found = |verdict: &Verdict| verdict.findings.len() + verdict.leads.len();
    let one = earlier.findings.first().or(earlier.leads.first());
    let one = one.expect("drag of the first joint").clone();
    assert_eq!(found(&run(trace())), 2);
    earlier.findings = vec![one; MOST_EFFECTS - 1];
    assert_eq!(found(&run(trace().since(&earlier))), 1);
}
