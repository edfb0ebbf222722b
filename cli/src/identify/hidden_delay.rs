//! A delay of all torques that deviations tell and errors do not.

use robot_model::identify::Estimate;

pub(super) fn doubt(estimate: &Estimate) -> Option<String> {
    let late = said(estimate)?;
    let is_late = estimate.hidden_delay?.seconds > 0.0;
    let finds = if is_late {
        "declare `time_delay;` in `effects` to identify a delay; "
    } else {
        ""
    };
    Some(format!(
        "{late}; standard deviations include the bias of the values: {finds}`trace` checks whether undeclared friction looks like a delay",
    ))
}

/// How late torques are.
pub(crate) fn said(estimate: &Estimate) -> Option<String> {
    let delay = estimate.hidden_delay?;
    let (ms, std) = (1e3 * delay.seconds.abs(), 1e3 * delay.std);
    let late = if delay.seconds > 0.0 { "late" } else { "early" };
    // A noisy torque has a noisy slope, beside which its delay comes out too short.
    Some(format!(
        "torques are {late} by {ms:.1} +- {std:.1} ms or more, though noise hides the effect on errors"
    ))
}
