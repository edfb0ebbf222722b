//! Tables and figures.

use robot_model::friction_curve::{Law, Value};

use super::encoder::{BITS, STIFFNESSES};
use super::experiments::{self, rise, with_law};
use super::plant::{Friction, PRINTED};
use super::results::{self, PULLED, Protocol, Results};
use super::{tool, truth};
use crate::paper::{Error, Figure, Mark, Table};

/// Points of a curve.
const POINTS: u32 = 200;

/// All tables.
pub(super) fn tables(results: &Results) -> Vec<Table> {
    vec![
        parameters(results),
        protocols(results),
        encoders(results),
        pulls(results),
    ]
}

fn parameters(results: &Results) -> Table {
    let found = &results.found;
    let law = &found.law;
    let nothing = Value {
        value: f64::NAN,
        std: f64::NAN,
    };
    let speed = law.fall.map_or(nothing, |fall| fall.speed);
    let mut table = Table::new(
        "Parameters; the printed ones are the truth of the simulation",
        ["parameter", "unit", "printed", "here", "+-", "off"],
    );
    let mut push = |name: &str, unit: &str, printed: f64, Value { value, std }: Value| {
        table.push([
            name.to_owned(),
            unit.to_owned(),
            printed.to_string(),
            format!("{value:.4}"),
            if std.is_nan() {
                "-".to_owned()
            } else {
                format!("{std:.4}")
            },
            format!("{:+.2} %", 100.0 * (value / printed - 1.0)),
        ]);
    };
    push("F_c", "N m", truth::COULOMB, law.coulomb);
    push("F_s", "N m", truth::BREAKAWAY, law.breakaway);
    push("Stribeck speed", "rad/s", truth::STRIBECK, speed);
    push("s2", "N m s/rad", truth::VISCOUS, law.viscous);
    push(
        "s0, equation (18)",
        "N m/rad",
        truth::STIFFNESS,
        found.bristles.stiffness,
    );
    push("s0", "N m/rad", truth::STIFFNESS, found.dynamic.stiffness);
    push("s1", "N m s/rad", truth::DAMPING, found.dynamic.damping);
    let alone = |value| Value {
        value,
        std: f64::NAN,
    };
    let mixed = &found.mixed.found;
    push(
        "s0, cost (23)",
        "N m/rad",
        truth::STIFFNESS,
        alone(mixed.stiffness),
    );
    push(
        "s1, cost (23)",
        "N m s/rad",
        truth::DAMPING,
        alone(mixed.damping),
    );
    push(
        "s0, 12 bits",
        "N m/rad",
        truth::STIFFNESS,
        found.coarse.stiffness,
    );
    push(
        "s1, 12 bits",
        "N m s/rad",
        truth::DAMPING,
        found.coarse.damping,
    );
    table
}

fn protocols(results: &Results) -> Table {
    let mut table = Table::new(
        "The static four by protocol",
        [
            "twenty speeds over 280 degrees",
            "found",
            "F_c",
            "F_s",
            "s2",
            "Stribeck speed",
        ],
    );
    for Protocol { name, points, law } in &results.protocols {
        let fall = |of: &dyn Fn(&Law) -> f64| {
            law.fall
                .map_or("-".to_owned(), |_| format!("{:.4}", of(law)))
        };
        table.push([
            (*name).to_owned(),
            points.to_string(),
            format!("{:.4}", law.coulomb.value),
            fall(&|law| law.breakaway.value),
            format!("{:.4}", law.viscous.value),
            fall(&|law| law.fall.map_or(f64::NAN, |fall| fall.speed.value)),
        ]);
    }
    table
}

fn encoders(results: &Results) -> Table {
    let mut table = Table::new(
        "Stiffness of bristles through encoders, N m/rad; in brackets where it is said not to be told",
        [
            "truth", "12 bits", "14 bits", "16 bits", "18 bits", "20 bits",
        ],
    );
    for stiffness in STIFFNESSES {
        let trial = |bits: i32| {
            let mut trials = results.encoders.iter();
            trials.find(|trial| trial.bits == bits && (trial.stiffness - stiffness).abs() < 0.5)
        };
        let cell = |bits: i32| match trial(bits).map(|trial| (trial.found, trial.is_resolved)) {
            Some((Some(found), true)) => format!("{found:.1}"),
            Some((Some(found), false)) => format!("({found:.1})"),
            _ => "-".to_owned(),
        };
        table.push(std::iter::once(stiffness.to_string()).chain(BITS.map(cell)));
    }
    table
}

fn pulls(results: &Results) -> Table {
    let mut table = Table::new(
        "Pulled by a spring: least and largest speed over that of its end, share of the time for which the joint stands",
        [
            "speed, rad/s",
            "printed, 2 N m/rad",
            "printed, 0.05 N m/rad",
            "s0 1001, 2 N m/rad",
            "s1 0.05, 2 N m/rad",
        ],
    );
    for (k, speed) in PULLED.iter().enumerate() {
        let cells = results.shown.iter().map(|shown| {
            let late = &shown.late[k];
            format!(
                "{:.2} .. {:.2}, {:.0} %, {}",
                late.least,
                late.largest,
                100.0 * late.standing,
                late.word()
            )
        });
        table.push(std::iter::once(speed.to_string()).chain(cells));
    }
    table
}

/// All figures, by the paper's numbers.
pub(super) fn figures(results: &Results) -> Result<Vec<Figure>, Error> {
    Ok([curves(results)?, phenomena(results)].concat())
}

/// Some hundred of the points.
fn thinned(x: &[f64], y: &[f64]) -> Vec<(f64, f64)> {
    let pairs = x.iter().copied().zip(y.iter().copied());
    pairs.step_by((x.len() / 300).max(1)).collect()
}

fn curves(results: &Results) -> Result<Vec<Figure>, Error> {
    let found = &results.found;
    let refined = Friction {
        stiffness: found.dynamic.stiffness.value,
        damping: found.dynamic.damping.value,
        ..with_law(&found.law)
    };
    let stribeck = |name: &str, title: &str| {
        let points = found.curve.points.iter();
        let points = points.map(|point| (point.speed, point.torque.value));
        Figure::new(name, title, "speed, rad/s", "torque, N m").with(
            "stretches of constant speed",
            Mark::Dots,
            points,
        )
    };
    let speeds = || (1..=POINTS).map(|k| 3.6 * f64::from(k) / f64::from(POINTS));
    let simulated: Result<Vec<(f64, f64)>, Error> = experiments::speeds()
        .into_iter()
        .map(|speed| Ok((speed, tool::settled(&refined, speed)?)))
        .collect();
    let simulated_rise = rise(refined, experiments::RISE, 100);
    Ok(vec![
        stribeck("figure_06", "Stribeck curve: twenty speeds and their law")
            .with(
                "law",
                Mark::Line,
                speeds().map(|v| (v, found.law.torque(v))),
            )
            .with(
                "printed",
                Mark::Line,
                speeds().map(|v| (v, PRINTED.steady(v))),
            ),
        Figure::new(
            "figure_07",
            "Before sliding: a torque that rises by 0.01 N m/s",
            "time, s",
            "angle, rad",
        )
        .with(
            "experiment",
            Mark::Dots,
            thinned(&found.rise.time, &found.rise.q),
        )
        .with(
            "model, refined",
            Mark::Line,
            thinned(&simulated_rise.time, &simulated_rise.q),
        ),
        stribeck("figure_08", "Stribeck curve: experiment and simulation").with(
            "bristles that have settled",
            Mark::Line,
            simulated?,
        ),
    ])
}

fn phenomena(results: &Results) -> Vec<Figure> {
    let [printed, soft, stiff, _] = &results.shown[..] else {
        return Vec::new();
    };
    let loop_of = |name: &str, what: &str, shown: &results::Shown| {
        let pulled = &shown.to_and_fro.0;
        Figure::new(
            name,
            format!("Pulled to and fro below breakaway: {what}"),
            "angle, rad",
            "torque, N m",
        )
        .with("by hand", Mark::Line, thinned(&pulled.q, &pulled.torque))
    };
    let pull_of = |name: &str, what: &str, shown: &results::Shown| {
        let slip = &shown.slip.0;
        let late = slip.time.partition_point(|t| *t < 15.0);
        let (time, q) = (&slip.time[late..], &slip.q[late..]);
        let end: Vec<f64> = time.iter().map(|t| results::BESIDE[0] * t).collect();
        Figure::new(
            name,
            format!(
                "Pulled by a spring of {} N m/rad whose end moves at {} rad/s: {what}",
                shown.spring.stiffness,
                results::BESIDE[0]
            ),
            "time, s",
            "angle, rad",
        )
        .with("joint", Mark::Line, thinned(time, q))
        .with("end of the spring", Mark::Line, thinned(time, &end))
    };
    let through = |bits: i32| {
        let trials = results.encoders.iter();
        let trials = trials.filter(move |trial| trial.bits == bits);
        trials.filter_map(|trial| Some((trial.stiffness.log10(), trial.found? / trial.stiffness)))
    };
    let encoders = Figure::new(
        "encoders",
        "Stiffness that is found through an encoder",
        "true stiffness, log10 of N m/rad",
        "found over true",
    );
    vec![
        loop_of("figure_09a", "printed bristles", printed),
        pull_of("figure_09b", "bristles of 1001 N m/rad", stiff),
        pull_of("figure_09c", "printed bristles", soft),
        BITS.iter().fold(encoders, |figure, bits| {
            figure.with(format!("{bits} bits"), Mark::Line, through(*bits))
        }),
    ]
}
