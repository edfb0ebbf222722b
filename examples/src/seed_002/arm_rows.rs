//! Items of the arm itself: whether it can be, how it is led by hand, how large its matrices are.

use super::results::Results;
use super::table_one::Audited;
use crate::paper::Row;

/// Table I, asked by the audit.
pub(super) fn of_table(results: &Results) -> Vec<Row> {
    let [as_printed, magnitude] = &results.table_1;
    let count = |audited: &Audited, check: &str| audited.findings(check).len();
    let turned = as_printed.findings("signs").iter();
    let turned = turned.filter(|said| said.contains("fc2")).count();
    let driven = (0..6).filter_map(|k| as_printed.drives_from(k));
    let driven = driven.filter(|speed| *speed < 1e-3).count();
    let [ours, _] = &results.ours;
    let sound = ["bodies", "signs", "inertia"].map(|check| count(ours, check));
    vec![
        Row::wrong_in_print(
            "2.9",
            "Table I: can an arm have it?",
            "may not be the physical parameters",
            format!(
                "{} links are no bodies, {} rotors below zero, inertia of the arm not positive definite: {}; the simulated arm: {}",
                count(magnitude, "bodies"),
                count(magnitude, "signs"),
                count(magnitude, "inertia") == 1,
                sound.iter().sum::<usize>()
            ),
            count(magnitude, "bodies") >= 5
                && count(magnitude, "signs") == 3
                && count(magnitude, "inertia") == 1
                && sound == [0; 3],
            "masses are set to 10 kg, the rest to what fits: no bodies have these parameters",
        ),
        Row::wrong_in_print(
            "2.9.sign",
            "fc2 of Table I in equation 3",
            "fc2 sgn(dq), fc2 < 0",
            format!(
                "`signs` finds {turned} of them, friction drives {} of 6 joints at the slowest speeds; as magnitudes {}",
                driven,
                magnitude
                    .findings("signs")
                    .iter()
                    .filter(|said| said.contains("fc2"))
                    .count()
            ),
            turned == 6
                && !magnitude
                    .findings("signs")
                    .iter()
                    .any(|said| said.contains("fc2")),
            "sgn and the negative value turn the sign twice: dry friction would drive backward",
        ),
    ]
}

/// Hand guiding, and sizes.
pub(super) fn of_use(results: &Results) -> Vec<Row> {
    let [tfls, mfwls] = &results.guided;
    let slow = |k: usize| [tfls, mfwls].map(|guided| guided.effort(k, true));
    let better = (0..6).filter(|&k| slow(k)[1] < slow(k)[0]).count();
    let peak = |joint: usize| {
        let torques = results.logs[0].tau[joint].iter();
        torques.map(|tau| tau.abs()).fold(0.0, f64::max)
    };
    let streamed = &results.streamed;
    // Without optimization the same takes several times as long.
    let most = if cfg!(debug_assertions) { 10.0 } else { 1.0 };
    vec![
        Row::holds(
            "2.10",
            "hand guiding (31): torque of the hand on joint 3 at 0.01 rad/s and less",
            "less with MFWLS than with TFLS",
            format!(
                "{:.2} N m with MFWLS, {:.2} with TFLS; less on {better} of 6 joints; off by {:.2} and {:.2} N m where it stands",
                slow(2)[1],
                slow(2)[0],
                mfwls.at_rest[2].abs(),
                tfls.at_rest[2].abs()
            ),
            slow(2)[1] < slow(2)[0] && mfwls.at_rest[2].abs() < tfls.at_rest[2].abs(),
            "the hand does not need less",
        ),
        Row::holds(
            "2.11",
            "120 000 x 96, 20 000 samples at 1 kHz; largest torques",
            "the arm's: J1 more than 80, J6 less than 8 N m",
            format!(
                "{} x {} by streaming QR, {} rows at once, {:.2} s; J1 {:.0}, J6 {:.1} N m",
                streamed.size[0],
                streamed.size[1],
                streamed.piece,
                streamed.seconds,
                peak(0),
                peak(5)
            ),
            streamed.size == [120_000, 70]
                && streamed.error < 0.05
                && streamed.seconds < most
                && peak(5) < 8.0,
            "it takes longer than a second",
        ),
    ]
}
