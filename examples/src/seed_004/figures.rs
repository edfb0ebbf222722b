//! Figures 5, 7, 10, 14 and 17.

use robot_model::identify::Identify;
use robot_model::signal::FirstOrder;

use super::device::{self, SPEC};
use super::plant::Three;
use super::results::Results;
use super::rig::RATE;
use super::shares;
use super::truth::CORNER;
use crate::paper::{Error, Figure, Mark};

/// Every so manieth sample is drawn.
const THINNED: usize = 100;

/// Samples at the ends that are not drawn, and those either way of a velocity.
const SETTLED: usize = 1000;
const SPAN: usize = 10;

pub(super) fn figures(results: &Results) -> Result<Vec<Figure>, Error> {
    let mut all = vec![
        residual(
            results,
            "figure_5",
            &device::without_friction(),
            "without friction",
        )?,
        residual(results, "figure_7", SPEC, "with friction")?,
    ];
    let ur = &results.shares[0];
    let mut figure = Figure::new(
        "figure_10",
        "Shares of the torque, UR",
        "joint",
        "RMS, mN m",
    );
    for (name, rms) in shares::NAMES.iter().zip(ur.rms) {
        figure = figure.with(*name, Mark::Line, joints(&rms));
    }
    all.push(figure);
    let one = &results.controlled[0];
    let [ours, other] = &one.squares;
    let line = |q: &[f64], time: &[f64]| -> Vec<(f64, f64)> {
        time.iter()
            .copied()
            .zip(q.iter().copied())
            .step_by(10)
            .collect()
    };
    all.push(
        Figure::new(
            "figure_14",
            "Inverse dynamics with half of the friction, UR, K_P 625, K_D 35",
            "time, s",
            "joint 3, rad",
        )
        .with("wanted", Mark::Line, line(&ours.wanted, &ours.time))
        .with("identified", Mark::Line, line(&ours.q3, &ours.time))
        .with("piece-wise", Mark::Line, line(&other.q3, &other.time)),
    );
    let felt = &results.felt;
    let mut figure = Figure::new(
        "figure_17",
        "Force of the hand along y, after L",
        "time, s",
        "force, N",
    );
    for (name, y) in ["sensor", "with the model", "without"].iter().zip(&felt.y) {
        figure = figure.with(*name, Mark::Line, line(y, &felt.time));
    }
    all.push(figure);
    Ok(all)
}

fn joints(rms: &Three) -> Vec<(f64, f64)> {
    (1..)
        .zip(rms)
        .map(|(j, x)| (f64::from(j), 1e3 * x))
        .collect()
}

/// What is left of the torque of joints over their speeds, by a model that was fitted to the same log.
fn residual(results: &Results, name: &str, text: &str, which: &str) -> Result<Figure, Error> {
    let arm = device::arm(text)?;
    let log = &results.installations[0].halves.train;
    let estimate = Identify::default().fit(&arm, std::slice::from_ref(log))?;
    let predicted = estimate.predict(&arm, log)?;
    let filter = FirstOrder::new(CORNER, RATE)?;
    let mut figure = Figure::new(
        name,
        format!("Filtered torque less the model {which}, UR"),
        "velocity, rad/s",
        "residual, mN m",
    );
    for (j, q) in log.q.iter().enumerate() {
        let off = log.tau[j].iter().zip(&predicted[j]).map(|(x, y)| x - y);
        let (off, mut left) = (off.collect::<Vec<f64>>(), Vec::new());
        filter.apply(off[0], &off, &mut left);
        let inside = (SETTLED..q.len() - SETTLED).step_by(THINNED);
        let points = inside.map(|k| {
            let velocity = (q[k + SPAN] - q[k - SPAN]) * RATE / (2 * SPAN) as f64;
            (velocity, 1e3 * left[k])
        });
        figure = figure.with(format!("joint {}", j + 1), Mark::Dots, points);
    }
    Ok(figure)
}
