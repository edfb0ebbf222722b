//! Figures of the publication, from our runs.

use super::arm::{CONVENTIONAL, ROKAE};
use super::excitation::wanted;
use super::law::curve;
use super::results::Results;
use super::table_two::Fit;
use super::truth::PERIOD;
use crate::paper::{Error, Figure, Mark, interpreted};

/// Points of a curve.
const POINTS: usize = 500;

/// All of them.
///
/// # Errors
/// Those of the libraries.
pub fn figures(results: &Results) -> Result<Vec<Figure>, Error> {
    let mut figures = vec![law(), excitation(results)];
    let fits = [
        ("figure_06", "TFLS", CONVENTIONAL, &results.conventional[0]),
        ("figure_07", "MFLS", ROKAE, &results.modified[0]),
        ("figure_08", "MFWLS", ROKAE, &results.modified[1]),
    ];
    for (name, method, spec, fit) in fits {
        figures.push(validation(results, [name, method, spec], fit)?);
    }
    figures.extend(guiding(results));
    Ok(figures)
}

fn law() -> Figure {
    Figure::new(
        "law",
        "Friction of joint 3 with the values of Table I",
        "velocity, rad/s",
        "torque, N m",
    )
    .with("equations 3 and 4", Mark::Line, curve(2))
    .with("no friction", Mark::Line, [(-1.9, 0.0), (1.9, 0.0)])
}

fn excitation(results: &Results) -> Figure {
    let motion = &results.designs[0].motion;
    let figure = Figure::new(
        "figure_01",
        "One period by Hadamard's bound",
        "time, s",
        "position, rad",
    );
    (0..6).fold(figure, |figure, joint| {
        let times = (0..=POINTS).map(|k| PERIOD * k as f64 / POINTS as f64);
        let points = times.map(|t| (t, wanted(motion, t)[joint][0]));
        figure.with(format!("joint {}", joint + 1), Mark::Line, points)
    })
}

/// Some of many points.
fn thinned<'a>(x: &'a [f64], y: &'a [f64]) -> impl Iterator<Item = (f64, f64)> + 'a {
    let step = (x.len() / POINTS).max(1);
    x.iter().copied().zip(y.iter().copied()).step_by(step)
}

fn validation(
    results: &Results,
    [name, method, spec]: [&str; 3],
    fit: &Fit,
) -> Result<Figure, Error> {
    const JOINT: usize = 2;
    let test = &results.logs[1];
    let predicted = fit.estimate.predict(&interpreted(name, spec)?, test)?;
    let errors: Vec<f64> = test.tau[JOINT]
        .iter()
        .zip(&predicted[JOINT])
        .map(|(measured, predicted)| measured - predicted)
        .collect();
    let title = format!("Torque of joint 3 on the test run, {method}");
    Ok(Figure::new(name, title, "time, s", "torque, N m")
        .with(
            "measured",
            Mark::Broad,
            thinned(&test.time, &test.tau[JOINT]),
        )
        .with(
            "computed",
            Mark::Line,
            thinned(&test.time, &predicted[JOINT]),
        )
        .with("error", Mark::Line, thinned(&test.time, &errors)))
}

fn guiding(results: &Results) -> [Figure; 2] {
    const JOINT: usize = 2;
    let [tfls, mfwls] = &results.guided;
    let torque = Figure::new(
        "figure_10_motor",
        "Joint 3 led by hand: torque of the motor",
        "time, s",
        "torque, N m",
    )
    .with("TFLS", Mark::Line, thinned(&tfls.time, &tfls.motor[JOINT]))
    .with(
        "MFWLS",
        Mark::Line,
        thinned(&mfwls.time, &mfwls.motor[JOINT]),
    );
    let hand = Figure::new(
        "figure_10_hand",
        "Joint 3 led by hand: torque of the hand",
        "time, s",
        "torque, N m; velocity, 0.1 rad/s",
    )
    .with("TFLS", Mark::Line, thinned(&tfls.time, &tfls.hand[JOINT]))
    .with(
        "MFWLS",
        Mark::Line,
        thinned(&mfwls.time, &mfwls.hand[JOINT]),
    )
    .with(
        "velocity",
        Mark::Line,
        thinned(&mfwls.time, &mfwls.velocity[JOINT]).map(|(t, v)| (t, 10.0 * v)),
    );
    [torque, hand]
}
