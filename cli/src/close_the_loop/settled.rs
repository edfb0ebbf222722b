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

#[cfg(test)]
mod tests {
    use std::cell::{Cell, RefCell};

    use robot_model::trace::Outcome;

    use super::super::close;
    use super::*;
    use crate::progress::Progress;
    use crate::trace::cart::{CART, log};

    /// A finding of which nothing is left is a lead, but for a change of the arm: that is not asked for again.
    #[test]
    fn a_change_that_vanishes_is_left_out_and_a_law_is_a_lead() {
        for (effect, asked) in [("coulomb_friction", 1), ("joint_elasticity", 2)] {
            let closed = close("cart.robot", CART, &[log()], None, &Progress::new())
                .unwrap_or_else(|error| panic!("{error}"));
            let arm = &closed.before.arm;
            let mut verdict = closed.verdict.clone();
            verdict.findings[0].effect = effect.to_owned();
            let mut stage = closed.changed.expect("an amended model");
            let mut all = stage.estimate.parameters.iter_mut();
            let friction = all.find(|one| one.name == "rail.coulomb_friction.fc");
            friction.expect("dry friction").value = 0.0;
            let (stage, times) = (RefCell::new(Some(stage)), Cell::new(0));
            let ask = |barred: &[Finding]| {
                times.set(times.get() + 1);
                let mut verdict = verdict.clone();
                if !barred.is_empty() {
                    verdict.findings.clear();
                    verdict.outcome = Outcome::NothingMissing;
                }
                Ok(verdict)
            };
            let with = |findings: &[Finding]| {
                let stage = (!findings.is_empty()).then(|| stage.take()).flatten();
                Ok((String::new(), stage))
            };
            let found = settled(&ask, &with, arm).unwrap_or_else(|error| panic!("{error}"));
            assert_eq!(times.get(), asked, "{effect}");
            assert!(found.changed.is_none() && found.verdict.findings.is_empty());
            let told = (found.verdict.outcome, found.vanished);
            let wanted = if asked == 1 {
                (Outcome::Unexplained, Some(0))
            } else {
                (Outcome::NothingMissing, None)
            };
            assert_eq!(told, wanted, "{effect}");
        }
    }
}
