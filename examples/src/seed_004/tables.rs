//! Tables 1 and 2 beside ours, shares, control.

use super::device;
use super::results::Results;
use super::shares;
use super::truth::{CONFIGURATIONS, NAMES, PIECE_WISE, TABLE_2};
use crate::paper::Table;

pub(super) fn tables(results: &Results) -> Vec<Table> {
    vec![
        parameters(results),
        errors(results),
        parts(results),
        control(results),
        gains(results),
    ]
}

fn parameters(results: &Results) -> Table {
    let mut table = Table::new(
        "Table 1 times 1000: printed, identified in the loop without rows at turns, with them",
        [
            "parameter",
            "UR",
            "GCW",
            "FS",
            "USD",
            "USD+GCW",
            "piece-wise, printed",
        ],
    );
    for (k, name) in NAMES.iter().enumerate() {
        let cells = results.installations.iter().map(|one| {
            let [without, with] =
                [&one.estimate, &one.with_turns].map(|estimate| 1e3 * device::values(estimate)[k]);
            format!("{:.2}, {without:.3}, {with:.3}", 1e3 * one.truth[k])
        });
        let piece_wise = PIECE_WISE.get(k).map(|value| format!("{value:.2}"));
        let cells = cells.chain([piece_wise.unwrap_or_else(|| "-".to_owned())]);
        table.push(std::iter::once((*name).to_owned()).chain(cells));
    }
    table
}

fn errors(results: &Results) -> Table {
    let mut table = Table::new(
        "Table 2, RMS% of (15): printed, whole model here, model without friction here",
        ["joint", "UR", "GCW", "FS", "USD", "USD+GCW"],
    );
    for (j, printed) in TABLE_2.iter().enumerate() {
        let cells = results
            .installations
            .iter()
            .zip(printed)
            .map(|(one, printed)| {
                format!(
                    "{printed}, {:.2}, {:.1}",
                    one.rms[j], one.rms_without_friction[j]
                )
            });
        table.push(std::iter::once((j + 1).to_string()).chain(cells));
    }
    table
}

fn parts(results: &Results) -> Table {
    let mut table = Table::new(
        "Shares of the torque, RMS in percent of that of the torque, joints 1 / 2 / 3 (figures 10 and 11)",
        ["share", "UR", "GCW", "FS", "USD", "USD+GCW"],
    );
    for (k, name) in shares::NAMES.iter().enumerate() {
        let cells = results.shares.iter().map(|one| {
            let joints = one.rms[k].iter().zip(one.torque);
            let joints: Vec<String> = joints
                .map(|(x, all)| format!("{:.0}", 100.0 * x / all))
                .collect();
            joints.join(" / ")
        });
        table.push(std::iter::once((*name).to_owned()).chain(cells));
    }
    table
}

fn control(results: &Results) -> Table {
    let mut table = Table::new(
        "Square wave on joint 3 (figures 14 to 16): identified, piece-wise",
        [
            "installation",
            "K_P, K_D",
            "steady state, %",
            "overshoot, %",
            "error, mrad RMS",
        ],
    );
    for one in &results.controlled {
        let [ours, other] = &one.squares;
        table.push([
            CONFIGURATIONS[one.installation].to_owned(),
            format!("{}, {}", one.gains[0], one.gains[1]),
            format!("{:.1}, {:.1}", ours.steady_percent, other.steady_percent),
            format!(
                "{:.1}, {:.1}",
                ours.overshoot_percent, other.overshoot_percent
            ),
            format!("{:.1}, {:.1}", 1e3 * ours.rms, 1e3 * other.rms),
        ]);
    }
    table
}

fn gains(results: &Results) -> Table {
    let mut table = Table::new(
        "Largest gains in the loop: identified, piece-wise",
        ["of joint 3", "UR", "GCW", "FS", "USD", "USD+GCW"],
    );
    let pairs = |all: &[[f64; 2]], digits: usize| -> Vec<String> {
        all.iter()
            .map(|[ours, other]| format!("{ours:.digits$}, {other:.digits$}"))
            .collect()
    };
    let first = |name: &str| std::iter::once(name.to_owned());
    table.push(first("K_P, 1/s^2").chain(pairs(&results.largest_gains, 0)));
    table.push(first("K_P pi6, N m/rad").chain(pairs(&results.largest_stiffness(), 2)));
    table
}
