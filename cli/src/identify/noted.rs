//! What is said of logs and of what was found of them, besides numbers.

use robot_model::identify::{Errors, Estimate};
use robot_model::log::Log;

use super::fit::Fit;
use super::{IdentifyArguments, brief, coarse, doubts, nominal, steps, twice, untold};
use crate::Error;

/// That all parameters have values, or the ways out.
pub(crate) fn told_apart(estimate: &Estimate) -> Result<(), Error> {
    let rows = |of: &[usize], joint: usize| of.get(joint).copied().unwrap_or_default();
    let joints = estimate.joints.iter().enumerate();
    // Nearly all of its rows, so that what is left is its way from here to there.
    let standing = joints.filter(|(k, _)| {
        10 * (rows(&estimate.turns, *k) + rows(&estimate.held, *k)) > 9 * estimate.samples
    });
    let standing: Vec<String> = standing.map(|(_, joint)| format!("`{joint}`")).collect();
    let standing = match standing.len() {
        0 => String::new(),
        1 => format!(
            "; {} stands or turns nearly all the time, where dry friction holds it with what no law says",
            standing[0]
        ),
        _ => format!(
            "; {} stand or turn nearly all the time, where dry friction holds them with what no law says",
            standing.join(", ")
        ),
    };
    let drowned = match estimate.drowned {
        0 => String::new(),
        count => format!(
            "; {} noise of the positions alone: lower `--bands` leave less of it, and `iv` needs none",
            match count {
                1 => "one of these directions is".to_owned(),
                _ => format!("{count} of these directions are"),
            }
        ),
    };
    estimate.separated().map_err(|error| {
        Error::Argument(format!(
            "{error}{standing}{drowned}; move the joints concerned (`excite` makes a motion for them), write what is known into the spec, let its nominal values \
             part the sums (`--method ridge`; `physical` finds an arm that makes them), or take what the logs tell: `--partial`"
        ))
    })
}

/// That a log is not judged in the band of the fit, since it comes too slowly for that.
pub(crate) fn too_slow(estimate: &Estimate, log: &Log) -> Option<String> {
    let rate_hz = log.rate_hz();
    let bands = estimate.bands.at_rate(rate_hz);
    (bands != estimate.bands).then(|| {
        format!(
            "{}: {rate_hz:.0} samples a second are too few for the filters of the identification, so its errors are those below {:.1} Hz, in \
             place of {:.1} Hz",
            log.source, bands.shared_hz, estimate.bands.shared_hz
        )
    })
}

/// What is doubtful about an estimate from factors, without their logs.
pub(crate) fn factor_doubts(estimate: &Estimate, form: &dyn Fit) -> Vec<String> {
    let negative = doubts::negative(estimate, form.unknowns());
    let explained = doubts::explained(estimate, None);
    let blocks = [brief::blocks_doubt(estimate), brief::lone_doubt(estimate)];
    let all = blocks.into_iter().flatten().chain(negative);
    all.chain(explained).collect()
}

impl IdentifyArguments {
    /// What is doubtful about logs and what was found of them.
    pub(super) fn doubts(
        &self,
        form: &dyn Fit,
        estimate: &Estimate,
        logs: &[Log],
        validation: Option<&Errors>,
        reading: Option<String>,
    ) -> Vec<String> {
        let mut all = twice::doubts(&self.logs, self.validate.as_deref());
        // All else follows from columns that are read in another way than they are meant.
        if let Some(reading) = reading {
            all.insert(0, reading);
            return all;
        }
        let negative = doubts::negative(estimate, form.unknowns());
        let explained = doubts::explained(estimate, validation);
        let is_odd = negative.is_some() || !explained.is_empty();
        all.extend(negative.into_iter().chain(explained));
        all.extend(nominal::doubt(form, estimate, logs, is_odd));
        all.extend(nominal::pulled(estimate));
        all.extend(doubts::at_ends(&estimate.shapes, form.shapes()));
        all.extend(doubts::untold_shapes(estimate));
        all.extend(doubts::at_turns(form.arm(), estimate));
        let held = doubts::held_torques(form.model(), estimate);
        all.extend(held.or_else(|| steps::doubt(&estimate.joints, logs)));
        all.extend(brief::doubt(estimate));
        let resting = doubts::resting(form.model(), logs);
        all.extend(coarse::doubt(estimate, form.model(), logs, &resting));
        let apart = doubts::hardly_apart(estimate, form.model(), logs);
        match apart {
            Some(apart) => all.push(apart),
            None => all.extend(untold::doubts(estimate, form.compiled(), &resting)),
        }
        all
    }
}
