//! What is said of logs and of what was found of them, besides numbers.

use robot_model::identify::{Errors, Estimate};
use robot_model::log::Log;
use robot_model_codegen::Compiled;

use super::fit::Fit;
use super::{
    IdentifyArguments, at_turns, brief, coarse, doubts, fixed, hidden_delay, leftover, nominal,
    one_sine, other_friction, steps, twice, untold,
};
use crate::Error;
use crate::output::names;

/// That all parameters have values, or the ways out.
pub(crate) fn told_apart(estimate: &Estimate) -> Result<(), Error> {
    estimate.separated().map_err(|error| {
        let error = error.to_string();
        // Where sums have lines of their own, so has what follows.
        let between = if error.contains('\n') { "\n" } else { "; " };
        let ways = "excite the joints concerned (`excite` designs a motion), write known values into the spec, let its nominal values split \
                    the sums (`--method ridge`; `physical` finds a possible arm with these sums), or accept the sums: `--partial`";
        let clauses = [Some(error), standing(estimate), drowned(estimate), Some(ways.to_owned())];
        let clauses: Vec<String> = clauses.into_iter().flatten().collect();
        Error::Argument(clauses.join(between))
    })
}

/// That a parameter is of a motor and of a link that a spring parts from it.
pub(crate) fn mixed(compiled: &Compiled) -> Option<String> {
    let effects = compiled.model.effects.iter();
    let springs = effects.filter(|effect| effect.definition.gives_way());
    let joints: Vec<usize> = springs.flat_map(|effect| effect.joints.clone()).collect();
    let mixed = compiled.mixed_on(&joints);
    let name = mixed.first()?;
    let (share, wrong) = match compiled.motor_torque() {
        Some(_) => ("its nominal part", "as far as that is wrong"),
        None => ("both", "if the motor contributes to it"),
    };
    Some(format!(
        "`{name}` sums a motor and its link, and the load that deflects the spring includes {share}; stiffnesses are wrong {wrong}; \
         `identify --method output-error` separates motor and link"
    ))
}

/// Joints that tell nothing since they hardly move.
fn standing(estimate: &Estimate) -> Option<String> {
    let rows = |of: &[usize], joint: usize| of.get(joint).copied().unwrap_or_default();
    let joints = estimate.joints.iter().enumerate();
    // Nearly all of its rows, so that what is left is its way from here to there.
    let standing = joints.filter(|(k, _)| {
        10 * (rows(&estimate.turns, *k) + rows(&estimate.held, *k)) > 9 * estimate.samples
    });
    let standing: Vec<&str> = standing.map(|(_, joint)| joint.as_str()).collect();
    let verbs = match standing.len() {
        0 => return None,
        1 => "is at rest or reverses nearly all the time, held by dry friction",
        _ => "are at rest or reverse nearly all the time, held by dry friction",
    };
    Some(format!("{} {verbs} of an unknown torque", names(&standing)))
}

/// Directions of which all that is seen is noise.
fn drowned(estimate: &Estimate) -> Option<String> {
    let of_which = match estimate.drowned {
        0 => return None,
        1 => "one of these directions is".to_owned(),
        count => format!("{count} of these directions are"),
    };
    Some(format!(
        "{of_which} only position noise: lower `--bands` reduce it, `--method iv` avoids it"
    ))
}

/// That a log is not judged in the band of the fit, since it comes too slowly for that.
pub(crate) fn too_slow(estimate: &Estimate, log: &Log) -> Option<String> {
    let rate_hz = log.rate_hz();
    let bands = estimate.bands.at_rate(rate_hz);
    (bands != estimate.bands).then(|| {
        format!(
            "{}: {rate_hz:.0} samples a second are too few for the filters of the identification, so its errors are computed below {:.1} Hz \
             instead of {:.1} Hz",
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

/// What puts all numbers in doubt: units, signs and an order of columns that are not those of the spec, as torques tell.
pub(super) fn warnings(
    form: &dyn Fit,
    estimate: &Estimate,
    logs: &[Log],
    validation: Option<&Errors>,
    reading: Option<String>,
) -> Vec<String> {
    let is_odd = || {
        doubts::negative(estimate, form.unknowns()).is_some()
            || !doubts::explained(estimate, validation).is_empty()
    };
    let warning = reading.or_else(|| nominal::doubt(form, estimate, logs, is_odd()));
    warning.into_iter().collect()
}

impl IdentifyArguments {
    /// What is doubtful about logs and what was found of them; what puts most of it in doubt is last, where it is seen.
    pub(super) fn doubts(
        &self,
        form: &dyn Fit,
        estimate: &Estimate,
        logs: &[Log],
        validation: Option<&Errors>,
        is_as_meant: bool,
    ) -> Vec<String> {
        let mut all = twice::doubts(&self.logs, self.validate.as_deref());
        // All else follows from columns that are read in another way than they are meant.
        if !is_as_meant {
            return all;
        }
        let negative = doubts::negative(estimate, form.unknowns());
        let explained = doubts::explained(estimate, validation);
        let fixed = fixed::doubt(form, estimate, logs);
        let is_told = fixed.is_some() || !explained.is_empty();
        let leftover = (!is_told).then(|| leftover::doubt(estimate)).flatten();
        let is_misfit = fixed.is_some() || leftover.is_some();
        all.extend(negative);
        all.extend(nominal::pulled(estimate));
        all.extend(doubts::at_ends(&estimate.shapes, form.shapes()));
        all.extend(doubts::untold_shapes(estimate));
        all.extend(at_turns::bent_shapes(form.arm(), estimate));
        all.extend(at_turns::told_there_alone(estimate));
        let held = doubts::held_torques(form.model(), estimate);
        all.extend(held.or_else(|| steps::doubt(&estimate.joints, logs)));
        // Errors that a misfit makes are alike along the whole motion, and longer logs would have no more of them.
        if !is_misfit {
            all.extend(brief::doubt(estimate));
        }
        if leftover.is_none() && !is_told {
            all.extend(other_friction::doubt(estimate));
            all.extend(hidden_delay::doubt(estimate));
        }
        all.extend(leftover);
        all.extend(one_sine::doubt(estimate, logs));
        let resting = doubts::resting(form.model(), logs);
        all.extend(coarse::doubt(estimate, form.model(), logs, &resting));
        let apart = doubts::hardly_apart(estimate, form.model(), logs);
        if apart.is_none() && fixed.is_none() {
            all.extend(untold::doubts(estimate, form.compiled(), &resting));
        }
        all.extend(fixed.into_iter().chain(apart));
        let is_bare = (!explained.is_empty()).then(|| doubts::frictionless(form.model()));
        all.extend(explained);
        all.extend(is_bare.flatten());
        all
    }
}
