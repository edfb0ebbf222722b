//! What the structure of a residual follows from, for people.

use std::fmt::Write;

use robot_model::columns::Arm;
use robot_model::trace::{Quantity, Share, Whereabouts};

use crate::close_the_loop::Loop;
use crate::output::significant;

/// Quantities that are told of a joint, and the least share of one, percent.
const TOLD: usize = 3;
const LEAST_PERCENT: f64 = 10.0;

/// Position and velocity together are told where they say so much more than either alone.
const MORE: f64 = 0.1;

/// One line: the term of the equations and the quantities a curve in which explains most of a joint's residual, and the highest line of its spectrum.
pub(super) fn whereabouts(closed: &Loop, one: &Whereabouts) -> String {
    let names = closed.before.arm.joints();
    let is_both = |share: &&Share| matches!(share.of, Quantity::Motion(_));
    let mut alone = one.shares.iter().filter(|share| !is_both(share));
    let most = alone.next().map_or(0.0, |share| share.share);
    let counts = |share: &&Share| !is_both(share) || share.share > most + MORE;
    let shares = one.shares.iter().filter(counts).take(TOLD);
    let told: Vec<String> = shares
        .map(|share| (share.of, 100.0 * share.share))
        .filter(|(_, percent)| *percent >= LEAST_PERCENT)
        .map(|(of, percent)| {
            let name = of.name().replace('-', " ");
            match of.joint() {
                Some(joint) => format!("{percent:.0} % a function of {name} of {}", names[joint]),
                None => format!("{percent:.0} % a function of {name}"),
            }
        })
        .collect();
    let term = one.terms.first().map(|term| {
        let percent = 100.0 * term.share;
        let coefficient = significant(term.coefficient, 3);
        (
            percent,
            format!(
                "{percent:.0} % {coefficient} times {}, a term of the equations",
                term.term
            ),
        )
    });
    let term = term.filter(|(percent, _)| *percent >= LEAST_PERCENT);
    let told: Vec<String> = term.into_iter().map(|(_, told)| told).chain(told).collect();
    let mut out = String::from("    of its residual out of fold: ");
    if told.is_empty() {
        out.push_str("no function of a position, velocity, acceleration, load or time");
    } else {
        out.push_str(&told.join(", "));
    }
    let percent = 100.0 * one.peak_share;
    writeln!(
        out,
        "; highest line of its spectrum at {:.2} Hz ({percent:.0} %)",
        one.peak_hz
    )
    .expect("a string takes all");
    out
}
