//! Bodies that a spec fixes and whose numbers are not those of the arm.

use robot_model::identify::{Beyond, Estimate, Identify, Method};
use robot_model::log::Log;
use robot_model_codegen::compile_for_rows;
use robot_model_spec::model::Inertial;

use super::fit::{Fit, of_form};
use crate::output::names;

/// By which share the error of a joint has to be less where a body is free, for its fixed numbers to be doubted: ten more unknowns take a few
/// percent of any error, and a part of what other effects leave. So many independent samples have to say that it is no chance: deviations of
/// what as many unknowns take off by chance.
const LESS: f64 = 0.25;
const DEVIATIONS: f64 = 3.0;

/// The same of a smaller share.
const LITTLE_LESS: f64 = 0.05;
const MANY_DEVIATIONS: f64 = 8.0;

/// Bodies that leave no more than so many times the least do as well, as those of which the logs tell the same sums.
const AS_WELL: f64 = 1.05;

/// What is left of a joint's torque, percent, below which nobody asks why.
const NOTHING: f64 = 0.1;

/// The bodies without whose numbers the least is left of the torques, or all that are fixed where no single one does; least squares are asked
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
        at_turns: estimate.at_turns(),
        beyond: Beyond::Deviations,
        ..Identify::default()
    };
    let free = |links: &[usize]| {
        let form = of_form(compile_for_rows(&model.freeing(links)), estimate.form).ok()?;
        form.fit(&identify, logs).ok()
    };
    let before = form.fit(&identify, logs).ok()?;
    let all = free(&fixed)?;
    if !is_less(&before, &all) {
        return None;
    }
    let single = fixed
        .iter()
        .filter_map(|&link| Some((link, free(&[link])?)));
    let single: Vec<(usize, Estimate)> = single
        .filter(|(_, after)| is_less(&before, after))
        .collect();
    let left = single.iter().map(|(_, after)| sum(after));
    let least = left.fold(f64::INFINITY, f64::min);
    let best = single.iter();
    let best: Vec<&(usize, Estimate)> = best
        .filter(|(_, after)| sum(after) <= AS_WELL * least)
        .collect();
    let is_together = best.is_empty();
    let bodies = if is_together {
        fixed
    } else {
        best.iter().map(|(link, _)| *link).collect()
    };
    let bodies: Vec<&str> = bodies.iter().map(|&k| links[k].name.as_str()).collect();
    let after = best.first().map_or(&all, |(_, after)| after);
    let percents = [&before, after].map(|one| one.relative_percent.as_slice());
    Some(said(&bodies, is_together, &estimate.joints, percents))
}

fn sum(estimate: &Estimate) -> f64 {
    estimate.relative_percent.iter().sum()
}

/// Whether an estimate with more unknowns leaves so much less that what the other has for them is not so.
fn is_less(before: &Estimate, after: &Estimate) -> bool {
    let more = after.rank.saturating_sub(before.rank).max(1) as f64;
    let [left, less] = [before, after].map(|one| one.relative_percent.as_slice());
    let independent = after.effective_samples.as_deref().unwrap_or_default();
    let chance = chance(left, less, independent, more);
    [(LESS, DEVIATIONS), (LITTLE_LESS, MANY_DEVIATIONS)]
        .into_iter()
        .any(|(share, deviations)| {
            relieved(left, less, share).next().is_some() && chance > deviations
        })
}

/// Deviations beyond the mean of the chi-squared distribution of as many more unknowns, of twice the logarithm of a ratio of likelihoods.
fn chance(before: &[f64], after: &[f64], independent: &[f64], more: f64) -> f64 {
    let all = before.iter().zip(after).zip(independent);
    let gains = all
        .filter(|((before, after), _)| **before > NOTHING && **after > 0.0)
        .map(|((before, after), independent)| 2.0 * independent * (before / after).ln());
    (gains.sum::<f64>() - more) / (2.0 * more).sqrt()
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

fn said(
    bodies: &[&str],
    is_together: bool,
    joints: &[String],
    [before, after]: [&[f64]; 2],
) -> String {
    let errors = relieved(before, after, LITTLE_LESS).map(|k| {
        format!(
            "{:.1} % instead of {:.1} % of the torque of `{}`",
            after[k], before[k], joints[k]
        )
    });
    let errors: Vec<String> = errors.collect();
    let free = match (bodies.len(), is_together) {
        (1, _) => "identified instead of `fixed`",
        (_, true) => "all identified instead of `fixed`",
        (_, false) => "(any one of them) identified instead of `fixed`",
    };
    format!(
        "these logs fit better with {} {free}: residual {}; check its numbers, frame and units, and whether it carries more, or write \
         `nominal` instead of `fixed`; the cause may also be a missing effect, such as rotor inertia: `trace` distinguishes them",
        names(bodies),
        errors.join(", ")
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn joints_that_are_far_better_are_told_with_the_body() {
        let better = |before: &[f64], after: &[f64]| relieved(before, after, LESS).count();
        assert_eq!(better(&[9.0, 4.0], &[8.9, 2.0]), 1);
        assert_eq!(better(&[9.0, 4.0], &[8.0, 3.5]), 0);
        // Rounding is less of next to nothing.
        assert_eq!(better(&[1e-6, 1e-6], &[1e-9, 1e-9]), 0);
        let joints = ["one", "two"].map(str::to_owned);
        let told = said(&["cup"], false, &joints, [&[9.0, 4.0], &[8.9, 2.0]]);
        let wanted = "these logs fit better with `cup` identified instead of `fixed`: residual 2.0 % instead of 4.0 % of the torque of `two`;";
        assert!(told.starts_with(wanted), "{told}");
    }

    /// Ten more unknowns take a tenth off 50 independent samples, and hardly anything off 1000.
    #[test]
    fn a_little_less_of_much_noise_is_no_chance() {
        let [before, after] = [[4.0, 2.0], [3.6, 2.0]];
        assert!(chance(&before, &after, &[1000.0, 1000.0], 10.0) > MANY_DEVIATIONS);
        assert!(chance(&before, &after, &[50.0, 50.0], 10.0) < DEVIATIONS);
    }
}
