//! Figures 4 to 11 and 14 to 17; 1 to 3, 12 and 13 are drawings and diagrams.

use robot_model::identify::Estimate;
use robot_model::signal::FirstOrder;

use super::device::{self, SPEC};
use super::fits::Installation;
use super::results::{Controlled, Results};
use super::sensors::RATE;
use super::shares;
use super::truth::{self, CONFIGURATIONS, CORNER, NAMES};
use crate::paper::{Error, Figure, Mark};

/// Every so manieth sample is drawn.
const THINNED: usize = 100;

/// Samples at the ends that are not drawn, and those either way of a velocity.
const SETTLED: usize = 1000;
const SPAN: usize = 10;

/// Seconds of the motion that figures over time show.
const SHOWN: std::ops::Range<usize> = 10_000..20_000;

pub(super) fn figures(results: &Results) -> Result<Vec<Figure>, Error> {
    let bare = device::momentum(&device::without_friction())?;
    let whole = device::momentum(SPEC)?;
    let [ur, .., usd_gcw] = &results.installations[..] else {
        return Ok(Vec::new());
    };
    let name = CONFIGURATIONS[0];
    let mut all = Vec::new();
    let by_parts = with_piece_wise(&ur.without_friction).predict(&bare, &ur.halves.train)?;
    let without = ur.without_friction.predict(&bare, &ur.halves.train)?;
    let with = ur.estimate.predict(&whole, &ur.halves.train)?;
    all.extend(torques("figure_04", name, ur, &without, Some(&by_parts))?);
    all.push(residual("figure_05", ur, &without, "without friction")?);
    all.extend(torques("figure_06", name, ur, &with, None)?);
    all.push(residual("figure_07", ur, &with, "with friction")?);
    let with = usd_gcw.estimate.predict(&whole, &usd_gcw.halves.train)?;
    all.extend(torques(
        "figure_08",
        CONFIGURATIONS[4],
        usd_gcw,
        &with,
        None,
    )?);
    all.extend(shares_of_torque(results));
    for (number, one) in (14..).zip(&results.controlled) {
        all.push(square(&format!("figure_{number:02}"), one));
    }
    all.push(force(results));
    Ok(all)
}

/// Every so manieth of points over time.
fn line(time: &[f64], values: &[f64]) -> Vec<(f64, f64)> {
    let pairs = time.iter().copied().zip(values.iter().copied());
    pairs.step_by(10).collect()
}

/// Figures 9 to 11.
fn shares_of_torque(results: &Results) -> [Figure; 3] {
    let bars = |name: &str, title: &str, x: &str| Figure::new(name, title, x, "RMS, mN m");
    let ur = &results.shares[0];
    let (mut ninth, mut tenth) = (
        bars("figure_09", "Viscous and dry friction, UR", "joint"),
        bars("figure_10", "Shares of the torque, UR", "joint"),
    );
    for (k, (name, rms)) in shares::NAMES.iter().zip(ur.rms).enumerate() {
        if k >= 3 {
            ninth = ninth.with(*name, Mark::Bars, counted(&rms));
        }
        tenth = tenth.with(*name, Mark::Bars, counted(&rms));
    }
    let installations = CONFIGURATIONS.iter().zip(1..);
    let axis = installations.map(|(name, k)| format!("{k} {name}"));
    let mut eleventh = bars(
        "figure_11",
        "Shares of the torque of joint 3",
        &axis.collect::<Vec<_>>().join(", "),
    );
    for (k, name) in shares::NAMES.iter().enumerate() {
        let third: Vec<f64> = results.shares.iter().map(|one| one.rms[k][2]).collect();
        eleventh = eleventh.with(*name, Mark::Bars, counted(&third));
    }
    [ninth, tenth, eleventh]
}

/// In mN m, at 1, 2, 3 and so on.
fn counted(rms: &[f64]) -> Vec<(f64, f64)> {
    (1..)
        .zip(rms)
        .map(|(j, x)| (f64::from(j), 1e3 * x))
        .collect()
}

/// Figures 14 to 16.
fn square(name: &str, one: &Controlled) -> Figure {
    let [ours, other] = &one.squares;
    let [kp, kd] = one.gains;
    let installation = CONFIGURATIONS[one.installation];
    Figure::new(
        name,
        format!("Inverse dynamics with half of the friction, {installation}, K_P {kp}, K_D {kd}"),
        "time, s",
        "joint 3, rad",
    )
    .with("wanted", Mark::Line, line(&ours.time, &ours.wanted))
    .with("identified", Mark::Line, line(&ours.time, &ours.q3))
    .with("piece-wise", Mark::Line, line(&other.time, &other.q3))
}

/// Figure 17.
fn force(results: &Results) -> Figure {
    let felt = &results.felt;
    let mut figure = Figure::new(
        "figure_17",
        "Force of the hand along y, after L",
        "time, s",
        "force, N",
    );
    for (name, y) in ["sensor", "with the model", "without"].iter().zip(&felt.y) {
        figure = figure.with(*name, Mark::Line, line(&felt.time, y));
    }
    figure
}

/// An estimate with the piece-wise values in it.
fn with_piece_wise(estimate: &Estimate) -> Estimate {
    let mut estimate = estimate.clone();
    for parameter in &mut estimate.parameters {
        let mut names = NAMES.iter();
        let place = names.position(|name| device::is_named(&parameter.name, name));
        parameter.value = place.map_or(0.0, |place| truth::piece_wise()[place]);
    }
    estimate
}

/// Figures 4, 6 and 8, one a joint: filtered torque, that of a model fitted to the same log, and of the piece-wise parameters.
fn torques(
    name: &str,
    configuration: &str,
    one: &Installation,
    predicted: &[Vec<f64>],
    by_parts: Option<&[Vec<f64>]>,
) -> Result<Vec<Figure>, Error> {
    let log = &one.halves.train;
    let filter = FirstOrder::new(CORNER, RATE)?;
    let shown = |series: &[f64]| {
        let mut passed = Vec::new();
        filter.apply(series[0], series, &mut passed);
        let points = SHOWN.step_by(20).map(|k| (log.time[k], 1e3 * passed[k]));
        points.collect::<Vec<_>>()
    };
    let figures = (0..3).map(|j| {
        let figure = Figure::new(
            format!("{name}_joint_{}", j + 1),
            format!("Filtered torque of joint {}, {configuration}", j + 1),
            "time, s",
            "torque, mN m",
        )
        .with("measured", Mark::Line, shown(&log.tau[j]))
        .with("identified", Mark::Line, shown(&predicted[j]));
        match by_parts {
            Some(by_parts) => figure.with("piece-wise", Mark::Line, shown(&by_parts[j])),
            None => figure,
        }
    });
    Ok(figures.collect())
}

/// What is left of the torque of joints over their speeds, by a model that was fitted to the same log.
fn residual(
    name: &str,
    one: &Installation,
    predicted: &[Vec<f64>],
    which: &str,
) -> Result<Figure, Error> {
    let log = &one.halves.train;
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
