//! Logs that are too short for their deviations to be believed.

use robot_model::identify::{Estimate, Factor};

use super::doubts;
use crate::output;

/// Independent samples of all joints for a parameter. Of 80 simulated logs each of a two-link arm, with noise correlated over 20 ms, intervals
/// of 95 % held the truth in 80, 83, 84, 88, 90, 94 and 95 % of the cases with 2, 4, 7, 10, 13, 20 and 33 of them.
const ENOUGH: f64 = 15.0;

/// With fewer a fifth of the intervals miss.
const TOO_FEW: f64 = 3.0;

/// Share of a joint's error that is of a late channel, from where on that is most of it.
const MOSTLY: f64 = 0.5;

/// What is said of logs with few independent samples. Errors that a late channel makes, or a model that does not fit, are alike along the
/// whole motion, and longer logs would have no more of them.
pub(super) fn doubt(estimate: &Estimate) -> Option<String> {
    let is_late = estimate.delays.iter().any(|late| late.gain > MOSTLY);
    let is_ill = doubts::left(estimate)
        .iter()
        .any(|percent| *percent > doubts::MUCH);
    if is_late || is_ill {
        return None;
    }
    let independent: f64 = estimate.effective_samples.as_ref()?.iter().sum();
    said(independent, estimate.rank)
}

/// What is said of parameters whose deviations rest on one block of many.
pub(super) fn lone_doubt(estimate: &Estimate) -> Option<String> {
    let names: Vec<&str> = estimate.of_one_block.iter().map(String::as_str).collect();
    (!names.is_empty()).then(|| {
        format!(
            "only one block of the logs determines {}, so its variation between blocks is unknown; the standard deviation is that of white \
             noise, scaled as for the other parameters; add logs whose motion excites these parameters",
            output::names(&names)
        )
    })
}

/// What is said of factors with few blocks.
pub(super) fn blocks_doubt(estimate: &Estimate) -> Option<String> {
    let count = estimate.blocks?;
    let of = match count {
        1 => "those of white noise, as the factor holds a single block, and do not include slow noise".to_owned(),
        few if few < Factor::ENOUGH_BLOCKS => format!(
            "estimated from only {few} blocks of the logs, and therefore large"
        ),
        _ => return None,
    };
    Some(format!(
        "standard deviations are {of}; use {} blocks of a second or more, or the logs themselves without `--factor`",
        Factor::ENOUGH_BLOCKS
    ))
}

fn said(independent: f64, parameters: usize) -> Option<String> {
    let share = independent / parameters.max(1) as f64;
    if share >= ENOUGH {
        return None;
    }
    let verdict = if share < TOO_FEW {
        "too short: standard deviations are much too small"
    } else {
        "short: standard deviations are somewhat small"
    };
    Some(format!(
        "the logs are {verdict}; {independent:.0} independent samples for {parameters} parameters, {:.0} are enough: log {:.0} times as long",
        ENOUGH * parameters as f64,
        (ENOUGH / share).ceil().min(1e3)
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn short_logs_are_told_by_how_much() {
        assert_eq!(said(150.0, 10), None);
        let short = said(45.0, 10).expect("few");
        assert!(
            short.contains("somewhat small") && short.contains("4 times as long"),
            "{short}"
        );
        let too_short = said(18.0, 10).expect("fewer");
        assert!(
            too_short.contains("too short") && too_short.contains("9 times as long"),
            "{too_short}"
        );
    }
}
