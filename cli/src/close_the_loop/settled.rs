//! A verdict that identification bears out.

use robot_model::columns::Candidate;
use robot_model::trace::{Finding, MOST_EFFECTS, Verdict};

use super::Stage;
use crate::Error;
use crate::interpreted::InterpretedArm;

/// A spec amended, and what was identified with it where it changed.
pub(super) type Amended = (String, Option<Stage>);

/// What the tracer says once the arm was identified with it, as fields of a [`Loop`](super::Loop).
pub(super) struct Settled {
    pub(super) verdict: Verdict,
    pub(super) amended: String,
    pub(super) changed: Option<Stage>,
    pub(super) vanished: Option<usize>,
}

/// Traces, which `ask` does without what it gets, and identifies the arm `with` what was found.
///
/// What vanishes where the arm is identified with it is not what the tracer saw. A change of the arm of which that is true was the noise of what it
/// reads: the others are asked without it.
pub(super) fn settled(
    ask: &dyn Fn(&[Finding]) -> Result<Verdict, Error>,
    with: &dyn Fn(&[Finding]) -> Result<Amended, Error>,
    arm: &InterpretedArm,
) -> Result<Settled, Error> {
    let mut barred: Vec<Finding> = Vec::new();
    loop {
        let verdict = ask(&barred)?;
        let (amended, changed) = with(&verdict.findings)?;
        let found = changed.as_ref();
        let vanished = found.and_then(|stage| stage.vanished(&verdict.findings));
        let Some(place) = vanished else {
            return Ok(Settled {
                verdict,
                amended,
                changed,
                vanished,
            });
        };
        let finding = &verdict.findings[place];
        if barred.len() >= MOST_EFFECTS || !is_change(finding, arm) {
            let (amended, changed) = with(&[])?;
            return Ok(Settled {
                verdict: verdict.unexplained(),
                amended,
                changed,
                vanished,
            });
        }
        barred.push(finding.clone());
    }
}

/// Whether a candidate is what was found.
pub(super) fn is_of(finding: &Finding, candidate: &dyn Candidate) -> bool {
    finding.effect == candidate.effect() && finding.joints == candidate.joints()
}

/// Whether what was found changes the arm.
pub(super) fn is_change(finding: &Finding, arm: &InterpretedArm) -> bool {
    let undeclared = arm.undeclared();
    let mut candidates = undeclared.candidates().into_iter();
    candidates.any(|one| one.change().is_some() && is_of(finding, one))
}
