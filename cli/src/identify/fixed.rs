//! Bodies that a spec fixes and whose numbers are not those of the arm.

use robot_model::identify::{Beyond, Estimate, Identify, Method};
use robot_model::log::Log;
use robot_model_codegen::compile_model;
use robot_model_spec::Model;
use robot_model_spec::model::Inertial;

use super::fit::{Fit, of_form};
use crate::output::names;

/// By which share the error of a joint has to be less where a body is free, for its fixed numbers to be doubted. Ten more unknowns take a few
/// percent of any error, and a part of what other effects leave.
const LESS: f64 = 0.25;

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
    let left = |model: &Model| -> Option<Vec<f64>> {
        let form = of_form(compile_model(model), estimate.form).ok()?;
        Some(form.fit(&identify, logs).ok()?.relative_percent)
    };
    let before = form.fit(&identify, logs).ok()?.relative_percent;
    let all = left(&model.freeing(&fixed))?;
    if !is_less(&before, &all) {
        return None;
    }
    let single = |&link: &usize| Some(([link], left(&model.freeing(&[link]))?));
    let single = fixed.iter().filter_map(single);
    let best = single
        .min_by(|(_, one), (_, other)| sum(one).total_cmp(&sum(other)))
        .filter(|(_, after)| is_less(&before, after));
    let (bodies, after) = match &best {
        Some((link, after)) => (link.as_slice(), after),
        None => (fixed.as_slice(), &all),
    };
    let bodies: Vec<&str> = bodies.iter().map(|&k| links[k].name.as_str()).collect();
    Some(said(&bodies, &estimate.joints, &before, after))
}

fn sum(percents: &[f64]) -> f64 {
    percents.iter().sum()
}

/// Joints whose error is far less.
fn relieved<'a>(before: &'a [f64], after: &'a [f64]) -> impl Iterator<Item = usize> + 'a {
    let pairs = before.iter().zip(after).enumerate();
    pairs
        .filter(|(_, (before, after))| **before > NOTHING && **after < (1.0 - LESS) * **before)
        .map(|(joint, _)| joint)
}

fn is_less(before: &[f64], after: &[f64]) -> bool {
    relieved(before, after).next().is_some()
}

fn said(bodies: &[&str], joints: &[String], before: &[f64], after: &[f64]) -> String {
    let errors = relieved(before, after).map(|k| {
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
         frame and units are those of the arm, or leave them to identification with `nominal` for `fixed`; `trace` tells it from other effects",
        names(bodies),
        errors.join(", ")
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_body_is_doubted_where_a_joint_is_far_better_without_its_numbers() {
        assert!(is_less(&[9.0, 4.0], &[8.9, 2.0]));
        assert!(!is_less(&[9.0, 4.0], &[8.0, 3.5]));
        // Rounding is less of next to nothing.
        assert!(!is_less(&[1e-6, 1e-6], &[1e-9, 1e-9]));
        let joints = ["one", "two"].map(str::to_owned);
        let told = said(&["cup"], &joints, &[9.0, 4.0], &[8.9, 2.0]);
        assert!(
            told.contains("`fixed` of `cup` does not fit")
                && told.contains("2.0 % for 4.0 % of `two`;"),
            "{told}"
        );
    }
}
