//! Items of the arm itself: whether it can be, how it is led by hand, how large its matrices are.

use super::results::Results;
use super::streaming::WANTED;
use crate::paper::{Audited, Row};

/// Slower than anything that the audit looks at but the creep of a joint, rad/s.
const SLOW: f64 = 1e-3;

/// Table I, asked by the audit.
pub(super) fn of_table(results: &Results) -> Vec<Row> {
    let [as_printed, magnitude] = &results.table_1;
    let count = |audited: &Audited, check: &str| audited.findings(check).len();
    let turned = |audited: &Audited| {
        let names = audited.told_of("signs", "value");
        names.iter().filter(|name| name.ends_with("fc2")).count()
    };
    let driven = (0..6).filter_map(|k| results.drives_from(0, k));
    let driven = driven.filter(|speed| *speed < SLOW).count();
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
                "`signs` finds {} of them, friction drives {driven} of 6 joints below {SLOW} rad/s; as magnitudes {}",
                turned(as_printed),
                turned(magnitude)
            ),
            turned(as_printed) == 6 && turned(magnitude) == 0 && driven == 6,
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
    let [all, base] = &results.streamed;
    vec![
        Row::holds(
            "2.10",
            "hand guiding (31): torque of the hand on joint 3 at 0.01 rad/s and less",
            "less with MFWLS than with TFLS",
            format!(
                "{:.2} N m with MFWLS, {:.2} with TFLS; less on {better} of 6 joints; while the arm stands {:.2} and {:.2} N m, where gravity is off by {:.2} and {:.2}",
                slow(2)[1],
                slow(2)[0],
                mfwls.holding[2].abs(),
                tfls.holding[2].abs(),
                mfwls.at_rest[2].abs(),
                tfls.at_rest[2].abs()
            ),
            slow(2)[1] < slow(2)[0] && mfwls.at_rest[2].abs() < tfls.at_rest[2].abs(),
            "the hand does not need less",
        ),
        Row::holds(
            "2.11",
            "streaming QR of all rows of 20 s at 1 kHz, from positions to an estimate in a second (optimized, the quickest of three runs and more); largest torques",
            "120 000 x 96, 70 and 26 of them; the arm's: J1 more than 80, J6 less than 8 N m",
            format!(
                "{} x {} in pieces of {} rows, rank {}; {} x {} of base parameters, rank {}; seconds are in a table; J1 {:.0}, J6 {:.1} N m in this run",
                all.size[0],
                all.size[1],
                all.piece,
                all.rank,
                base.size[0],
                base.size[1],
                base.rank,
                peak(0),
                peak(5)
            ),
            all.size == [120_000, 96]
                && [all.rank, base.rank, base.size[1]] == [70; 3]
                && base.error.is_some_and(|error| error < 0.05)
                && all.seconds.max(base.seconds) < WANTED
                && peak(5) < 8.0,
            "it takes longer than a second, or ranks are others",
        ),
    ]
}
