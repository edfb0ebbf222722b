//! Bodies that a spec fixes and whose numbers are not those of the arm.

use robot_model::identify::{Beyond, Estimate, Identify, Method};
use robot_model::log::Log;
use robot_model_codegen::compile_model;
use robot_model_spec::model::Inertial;

use super::fit::{Fit, of_form};
use crate::output::names;

/// By which share the error of a joint has to be less where a body is free, for its fixed numbers to be doubted whatever noise is. Ten more
/// unknowns take a few percent of any error, and a part of what other effects leave.
const LESS: f64 = 0.25;

/// The same where what is left is noise, of which so many independent samples say that it is no chance: deviations of what as many unknowns
/// take off by chance.
const LESS_OF_NOISE: f64 = 0.05;
const DEVIATIONS: f64 = 8.0;

/// What is left of a joint's torque, percent, below which nobody asks why.
const NOTHING: f64 = 0.1;

/// The body without whose numbers the least is left of the torques, or all that are fixed where no single one does; least squares are asked
/// whatever the method is.
pub(super) fn doubt(form: &dyn Fit, estimate: &Estimate, logs: &[Log]) -> Option<String> {
    let model = form.model();
    let links = &model.chain()?.links;
    let is_fixed = |k: &usize| matches!(links[*k].inertial, Inertial::Fixed(_));
    let fixed: Vec<usize> = (0..links.len()).filter(is_fixed).collect();
    if fixed.is_empty() {
        return None;
    }
    let identify = Identify {
        method: Method::Wls,
        bands: Some(estimate.bands),
        shapes: Some(estimate.shapes.iter().map(|(_, value)| *value).collect()),
        beyond: Beyond::Deviations,
        ..Identify::default()
    };
    let free = |links: &[usize]| {
        let form = of_form(compile_model(&model.freeing(links)), estimate.form).ok()?;
        form.fit(&identify, logs).ok()
    };
    let before = form.fit(&identify, logs).ok()?;
    let all = free(&fixed)?;
    if !is_less(&before, &all) {
        return None;
    }
    let single = fixed
        .iter()
        .filter_map(|&link| Some(([link], free(&[link])?)));
    let sum = |one: &Estimate| one.relative_percent.iter().sum::<f64>();
    let best = single
        .min_by(|(_, one), (_, other)| sum(one).total_cmp(&sum(other)))
        .filter(|(_, after)| is_less(&before, after));
    let (bodies, after) = match &best {
        Some((link, after)) => (link.as_slice(), after),
        None => (fixed.as_slice(), &all),
    };
    let bodies: Vec<&str> = bodies.iter().map(|&k| links[k].name.as_str()).collect();
    let [before, after] = [&before, after].map(|one| one.relative_percent.as_slice());
    Some(said(&bodies, &estimate.joints, before, after))
}

/// Whether an estimate with more unknowns leaves so much less that what the other has for them is not so.
fn is_less(before: &Estimate, after: &Estimate) -> bool {
    let more = after.rank.saturating_sub(before.rank) as f64;
    let [left, less] = [before, after].map(|one| one.relative_percent.as_slice());
    let independent = after.effective_samples.as_deref().unwrap_or_default();
    relieved(left, less, LESS).next().is_some()
        || relieved(left, less, LESS_OF_NOISE).next().is_some()
            && is_no_chance(left, less, independent, more)
}

/// Twice the logarithm of a ratio of likelihoods beside the chi-squared distribution of as many more unknowns.
fn is_no_chance(before: &[f64], after: &[f64], independent: &[f64], more: f64) -> bool {
    let all = before.iter().zip(after).zip(independent);
    let gains = all
        .filter(|((before, after), _)| **before > NOTHING && **after > 0.0)
        .map(|((before, after), independent)| 2.0 * independent * (before / after).ln());
    gains.sum::<f64>() > more + DEVIATIONS * (2.0 * more).sqrt()
}

/// Joints whose error is less by more than a share of it.
fn relieved<'a>(
    before: &'a [f64],
    after: &'a [f64],
    share: f64,
) -> impl Iterator<Item = usize> + 'a {
    let pairs = before.iter().zip(after).enumerate();
    pairs
        .filter(move |(_, (before, after))| {
            **before > NOTHING && **after < (1.0 - share) * **before
        })
        .map(|(joint, _)| joint)
}

fn said(bodies: &[&str], joints: &[String], before: &[f64], after: &[f64]) -> String {
    let errors = relieved(before, after, LESS_OF_NOISE).map(|k| {
        format!(
            "{:.1} % for {:.1} % of `{}`",
            after[k], before[k], joints[k]
        )
    });
    let errors: Vec<String> = errors.collect();
    let [verb, body] = if bodies.len() == 1 {
        ["does", "that body"]
    } else {
        ["do", "these bodies"]
    };
    format!(
        "what the spec has `fixed` of {} {verb} not fit these logs: with {body} left free there is left of the torque {}; see whether its numbers, \
         frame and units are those of the arm and whether it carries more, or leave them to identification with `nominal` for `fixed`; `trace` tells it from other effects",
        names(bodies),
        errors.join(", ")
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_joint_that_is_far_better_without_the_numbers_tells() {
        let tells = |before: &[f64], after: &[f64]| relieved(before, after, LESS).count() > 0;
        assert!(tells(&[9.0, 4.0], &[8.9, 2.0]));
        assert!(!tells(&[9.0, 4.0], &[8.0, 3.5]));
        // Rounding is less of next to nothing.
        assert!(!tells(&[1e-6, 1e-6], &[1e-9, 1e-9]));
        let joints = ["one", "two"].map(str::to_owned);
        let told = said(&["cup"], &joints, &[9.0, 4.0], &[8.9, 2.0]);
        assert!(
            told.contains("`fixed` of `cup` does not fit")
                && told.contains("2.0 % for 4.0 % of `two`;"),
            "{told}"
        );
    }

    /// Ten more unknowns take a tenth off 50 independent samples, and hardly anything off 1000.
    #[test]
    fn a_little_less_of_much_noise_is_no_chance() {
        let [before, after] = [[4.0, 2.0], [3.6, 2.0]];
        assert!(is_no_chance(&before, &after, &[1000.0, 1000.0], 10.0));
        assert!(!is_no_chance(&before, &after, &[50.0, 50.0], 10.0));
    }
}
