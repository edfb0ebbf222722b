//! The paper's figures, drawn, and those of section 5 as numbers.

use super::Findings;
use super::fits::digits;
use super::sensitivity::Change;
use super::truth::RATE;
use crate::paper::{Figure, Mark, Table};

/// Figures 7 to 10 as numbers.
#[must_use]
pub fn table(changes: &[Change]) -> Table {
    let mut table = Table::new(
        "Figures 7 to 10: how far a small change carries in 13.33 s",
        [
            "figure",
            "what is changed",
            "by",
            "largest distance, rad",
            "over the change",
            "0.1 rad apart after, s",
        ],
    );
    for change in changes {
        let parted = change.parted();
        table.push([
            change.figure.to_string(),
            change.what.to_owned(),
            format!("{:+.2}", change.by),
            format!("{:.3}", change.apart()),
            format!("{:.3}", change.apart() / change.by.abs()),
            parted.map_or("never".to_owned(), |time| format!("{time:.2}")),
        ]);
    }
    table
}

/// Figure 8 with other changes than the printed one.
#[must_use]
pub fn nearby(nearby: &[[f64; 2]]) -> Table {
    let mut table = Table::new(
        "Figure 8 with other changes of the initial velocity",
        ["by, rad/s", "largest distance, rad"],
    )
    .rough();
    for [by, apart] in nearby {
        table.push([format!("{by:+.3}"), format!("{apart:.1}")]);
    }
    table
}

/// Costs of the wrong law.
#[must_use]
pub fn by_factor(costs: &[(f64, f64)]) -> Table {
    let mut table = Table::new(
        "Law (6.1), which is not the arm's, nothing fitted, with v = u + k dy/dt",
        ["k", "cost"],
    );
    for (k, cost) in costs {
        table.push([format!("{k:.1}"), digits(*cost)]);
    }
    table
}

const TIME: &str = "time, s";
const ANGLE: &str = "angle, rad";

/// All that the paper draws but the arm.
#[must_use]
pub fn figures(findings: &Findings) -> Vec<Figure> {
    let Findings { data, statics, .. } = findings;
    let over_time = |values: &[f64]| -> Vec<(f64, f64)> {
        let pairs = data.time.iter().copied().zip(values.iter().copied());
        pairs.collect()
    };
    let name = |number: u32| format!("figure_{number:02}");
    let forces = statics.current.iter().copied();
    let line = [0.0, 4.0].map(|i| (i, statics.line.torque(i).value));
    let mut figures = vec![
        Figure::new(
            name(2),
            format!("Static torque, r = {:.4}", statics.line.r),
            "current, A",
            "torque, N m",
        )
        .with(
            "measured",
            Mark::Dots,
            forces.zip(statics.torque.iter().copied()),
        )
        .with("line", Mark::Line, line),
        Figure::new(
            name(3),
            "Input: voltage across the known resistance",
            TIME,
            "u, V",
        )
        .with("u", Mark::Line, over_time(&data.u)),
        Figure::new(name(4), "Output", TIME, ANGLE).with("y", Mark::Line, over_time(&data.y)),
        Figure::new(name(5), "Differentiated output", TIME, "velocity, rad/s").with(
            "backward differences",
            Mark::Line,
            over_time(&data.velocity),
        ),
        Figure::new(
            name(6),
            "Synthesized input: Figure 3 and 1.5 times Figure 5",
            TIME,
            "v, V",
        )
        .with("u + 1.5 velocity", Mark::Line, over_time(&data.synthesized))
        .with("its square wave", Mark::Line, over_time(&data.wave)),
    ];
    let start = data.time[data.window.start];
    for change in &findings.changes[..4] {
        let along = |path: &[f64]| -> Vec<(f64, f64)> {
            let points = (0_u32..).zip(path);
            points
                .map(|(k, angle)| (start + f64::from(k) / RATE, *angle))
                .collect()
        };
        let mut figure = Figure::new(
            name(change.figure),
            format!("Sensitivity to {}: {:+.2}", change.what, change.by),
            TIME,
            ANGLE,
        )
        .with("as given", Mark::Line, along(&change.paths[0]))
        .with("changed", Mark::Line, along(&change.paths[1]));
        if change.figure == 10 {
            let measured = data.window.clone().map(|k| (data.time[k], data.y[k]));
            figure = figure.with("measured", Mark::Dots, measured.step_by(5));
        }
        figures.push(figure);
    }
    figures
}
