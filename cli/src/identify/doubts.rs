//! What looks like another unit, sign or order than the spec's.

use robot_model::columns::{Shape, Unknown};
use robot_model::identify::{Errors, Estimate, Identified, is_shape_told};
use robot_model::log::Log;
use robot_model_spec::Model;

use crate::interpreted::is_delaying;
use crate::output::names;

/// What is left of each joint's torque, from where on the model says nothing of it, percent.
const LITTLE: f64 = 85.0;

/// A model that explains next to nothing. What instruments leave of the torque has the noise of the columns in it, so least squares is
/// asked beside them.
pub(super) fn unexplained(estimate: &Estimate) -> Option<&'static str> {
    let is_nothing = left(estimate).iter().all(|percent| *percent > LITTLE);
    is_nothing.then_some(
        "the model explains almost none of the torque of any joint; check that positions are in rad and m, torques in N m and N (else set \
         `actuator_gain`), that signs and order are those of the spec's joints, and that positions and torques have the same time",
    )
}

/// What is left of a joint's torque, from where on the model says little of it, percent; and of all joints of several, where two that
/// are exchanged explain something of each other.
pub(super) const MUCH: f64 = 50.0;
const MUCH_OF_ALL: f64 = 25.0;

/// The same of a joint of a log that was not fitted, where effects that the other log hardly shows are often missing: a torque with the
/// other sign leaves 200 %.
const TURNED: f64 = 180.0;

/// Joints of which the model explains little in the logs that are fitted.
fn ill_fitted(percents: &[f64]) -> impl Iterator<Item = usize> + '_ {
    let of_all = percents.len() > 1 && percents.iter().all(|percent| *percent > MUCH_OF_ALL);
    (0..percents.len()).filter(move |&joint| of_all || percents[joint] > MUCH)
}

/// The same in a log that is not: one that is far off, or half of them.
fn ill_judged(percents: &[f64]) -> impl Iterator<Item = usize> + '_ {
    let ill = percents.iter().filter(|percent| **percent > MUCH).count();
    let is_half = 2 * ill >= percents.len();
    let least = if is_half { MUCH } else { TURNED };
    (0..percents.len()).filter(move |&joint| percents[joint] > least)
}

fn little(
    ill: impl Iterator<Item = usize>,
    percents: &[f64],
    joints: &[String],
    of: &str,
) -> Option<String> {
    let ill = ill.map(|joint| format!("`{}` {:.0} %", joints[joint], percents[joint]));
    let ill: Vec<String> = ill.collect();
    (!ill.is_empty()).then(|| {
        format!(
            "the model explains little of the torque {of}; residual: {}; check that signs, order and units of the columns are those of the \
             spec's joints, then ask `trace` what the model lacks",
            ill.join(", ")
        )
    })
}

/// That the spec says of joints which nothing explains that they have no friction.
pub(super) fn frictionless(model: &Model) -> Option<String> {
    model.effects.is_empty().then(|| {
        "the spec declares no effects, and real joints have friction: write `effects { viscous_friction on all; coulomb_friction on all; }` \
         into it"
            .to_owned()
    })
}

/// What is left by least squares, which is asked beside instruments.
pub(super) fn left(estimate: &Estimate) -> &[f64] {
    let hausman = estimate.hausman.as_ref();
    hausman.map_or(&estimate.relative_percent, |both| {
        &both.least_squares_percent
    })
}

/// What the model explains little of, in the logs that are fitted and in the one that is not.
pub(super) fn explained(estimate: &Estimate, validation: Option<&Errors>) -> Vec<String> {
    let fitted = unexplained(estimate).map(str::to_owned);
    let percents = left(estimate);
    let fitted = fitted.or_else(|| {
        let of = "of the fitted logs";
        little(ill_fitted(percents), percents, &estimate.joints, of)
    });
    let other = validation.and_then(|errors| {
        let percents = &errors.relative_percent;
        let of = "of the validation log";
        little(ill_judged(percents), percents, &estimate.joints, of)
    });
    let other = other.or_else(|| {
        let percents = &validation?.relative_percent;
        worse_judged(left(estimate), percents, &estimate.joints)
    });
    fitted.into_iter().chain(other).collect()
}

/// Joints that are explained where they are fitted, and of which next to nothing is on the other log: by these their own logs are no less
/// in doubt, but what they lack is another thing than a sign or a unit.
fn worse_judged(fitted: &[f64], judged: &[f64], joints: &[String]) -> Option<String> {
    let pairs = fitted.iter().zip(judged).zip(joints);
    let worse: Vec<String> = pairs
        .filter(|((fitted, judged), _)| **judged > LITTLE && **fitted < MUCH)
        .map(|((fitted, judged), joint)| format!("`{joint}` {judged:.0} % ({fitted:.0} %)"))
        .collect();
    (!worse.is_empty()).then(|| {
        format!(
            "the model explains the fitted logs, but almost nothing of the validation log; residual there (on the fitted logs): {}; either \
             the validation log shows an effect that the fitted logs hardly show, such as a coupling or a load (`trace` with both finds it), \
             or it is of another arm or has another order of columns",
            worse.join(", ")
        )
    })
}

/// Shapes that the logs do not tell: what has such a shape may not be there at all.
pub(super) fn untold_shapes(estimate: &Estimate) -> Vec<String> {
    let pairs = estimate.shapes.iter().zip(&estimate.shape_std);
    let told = pairs.filter_map(|((name, value), std)| untold_shape(name, *value, (*std)?));
    told.collect()
}

fn untold_shape(name: &str, value: f64, std: f64) -> Option<String> {
    let effect = name.rsplit_once('.').map_or(name, |(effect, _)| effect);
    (!is_shape_told(value, std)).then(|| {
        format!(
            "the logs do not determine `{name}` ({value:.2e} +- {std:.2e}), and so not the values of `{effect}`; remove this effect unless \
             it reduces errors on a validation log"
        )
    })
}

/// Torques that are early by half of a sample, where the model knows of no delay.
pub(super) fn held_torques(model: &Model, estimate: &Estimate) -> Option<String> {
    let mut effects = model.effects.iter();
    if effects.any(|effect| is_delaying(&effect.definition)) {
        return None;
    }
    let held = estimate.held_torques.iter();
    let held: Vec<String> = held
        .map(|held| {
            format!(
                "`{}` by {:.1} +- {:.1} ms ({:.0} % of its error)",
                estimate.joints[held.joint],
                -1e3 * held.seconds,
                1e3 * held.std,
                100.0 * held.gain
            )
        })
        .collect();
    (!held.is_empty()).then(|| {
        format!(
            "torques are early by less than a sample, as commands are that are held until the next sample: {}; this biases the values: log \
             at a higher rate, declare `time_delay;` in `effects`, or use `--method output-error`, which holds torques between samples",
            held.join(", ")
        )
    })
}

/// Share of the last step of a grid within which a search that goes to its end comes.
const AT_END: f64 = 0.02;

/// Shapes that the search has left at an end of their range.
pub(super) fn at_ends(found: &[(String, f64)], shapes: &[Shape]) -> Vec<String> {
    let pairs = found.iter().zip(shapes);
    let told = pairs.filter_map(|((name, value), shape)| {
        let [low, .., high] = shape.grid[..] else {
            return None;
        };
        let count = shape.grid.len();
        let within_low = AT_END * (shape.grid[1] - low);
        let within_high = AT_END * (high - shape.grid[count - 2]);
        let end = if *value <= low + within_low {
            "lower"
        } else if *value >= high - within_high {
            "upper"
        } else {
            return None;
        };
        Some(format!(
            "`{name}` is at the {end} end of its range {low} .. {high}: either the logs do not determine it, or it lies outside; to widen \
             the range, define a copy of the effect under another name in the spec"
        ))
    });
    told.collect()
}

/// Below zero by more than three deviations, where no arm has it.
fn is_impossible(value: f64, std: f64, unknown: &Unknown) -> bool {
    unknown.nonnegative && value < 0.0 && value < -3.0 * std
}

/// Parameters that no arm has below zero, and that are so: they stand for something that the spec lacks.
pub(crate) fn impossible<'a>(
    estimate: &'a Estimate,
    unknowns: &'a [Unknown],
) -> impl Iterator<Item = &'a Identified> {
    let found = estimate.parameters.iter().zip(unknowns);
    let found = found.filter(|(found, unknown)| is_impossible(found.value, found.std, unknown));
    found.map(|(found, _)| found)
}

/// The same, told.
pub(super) fn negative(estimate: &Estimate, unknowns: &[Unknown]) -> Option<String> {
    let found = estimate.parameters.iter();
    let found = found.map(|found| (found.name.as_str(), found.value, found.std));
    below_zero(found.zip(unknowns))
}

/// The same of names, values and deviations.
pub(super) fn below_zero<'a>(
    found: impl Iterator<Item = ((&'a str, f64, f64), &'a Unknown)>,
) -> Option<String> {
    let below: Vec<&str> = found
        .filter(|((_, value, std), unknown)| is_impossible(*value, *std, unknown))
        .map(|((name, ..), _)| name)
        .collect();
    if below.is_empty() {
        return None;
    }
    Some(format!(
        "{} below zero by more than three standard deviations, which is physically impossible: check that torques have the signs and the \
         order of the spec's joints, then run `trace` and `audit`",
        names_are(&below)
    ))
}

/// Times the noise of positions from where on simulated positions are off by something else, and their share of a joint's range that
/// is nothing.
const NOISE: f64 = 5.0;
const NOTHING: f64 = 1e-5;

/// Joints whose simulated positions are off by much more than their logs have noise, by root mean squares. That noise is told by third
/// differences, to which motion adds next to nothing.
pub(super) fn beyond_noise(model: &Model, logs: &[Log], rmse: &[f64]) -> Option<String> {
    let joints = model.joints.iter().enumerate();
    let told: Vec<String> = joints
        .filter_map(|(k, joint)| {
            let (mut squares, mut count, mut range) = (0.0, 0.0, 0.0_f64);
            for log in logs {
                let thirds = log.q[k].windows(4);
                squares += thirds
                    .map(|q| (q[3] - 3.0 * q[2] + 3.0 * q[1] - q[0]).powi(2) / 20.0)
                    .sum::<f64>();
                count += log.q[k].len() as f64;
                let high = log.q[k].iter().copied().fold(f64::NEG_INFINITY, f64::max);
                let low = log.q[k].iter().copied().fold(f64::INFINITY, f64::min);
                range = range.max(high - low);
            }
            let noise = (squares / count).sqrt();
            let is_beyond = rmse[k] > NOISE * noise && rmse[k] > NOTHING * range;
            is_beyond.then(|| format!("{:.0} times on `{}`", rmse[k] / noise, joint.name))
        })
        .collect();
    (!told.is_empty()).then(|| {
        format!(
            "errors of simulated positions exceed the noise of the logs ({}): torques are noisy, which standard deviations include; or the \
             model or its controller differs from the arm's, or the search ended in a local minimum, which they do not include; compare the \
             costs of other starts and windows",
            told.join(", ")
        )
    })
}

/// Condition numbers from where on noise of the columns themselves, which no deviation knows of, is in the values.
const APART: f64 = 3000.0;

/// Rad or m within which a joint hardly moves.
const HARDLY: f64 = 0.05;

/// Columns that are hardly apart, with the joints that hardly move.
pub(super) fn hardly_apart(estimate: &Estimate, model: &Model, logs: &[Log]) -> Option<String> {
    if estimate.condition <= APART {
        return None;
    }
    let resting = resting(model, logs);
    let who = if resting.is_empty() {
        String::new()
    } else {
        format!("; {} hardly moving in these logs", names_are(&resting))
    };
    Some(format!(
        "the regressor's columns are nearly dependent (condition {:.0}): position noise in them, which standard deviations do not include, \
         may dominate a value{who}; `excite` designs a motion that separates them",
        estimate.condition
    ))
}

/// Joints that hardly move.
pub(super) fn resting<'a>(model: &'a Model, logs: &[Log]) -> Vec<&'a str> {
    let joints = model.joints.iter().enumerate();
    let resting = joints.filter_map(|(k, joint)| {
        let all = logs.iter().flat_map(|log| log.q[k].iter().copied());
        let (low, high) = all.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), q| {
            (low.min(q), high.max(q))
        });
        (high - low < HARDLY).then_some(joint.name.as_str())
    });
    resting.collect()
}

fn names_are(below: &[&str]) -> String {
    let verb = if below.len() == 1 { "is" } else { "are" };
    format!("{} {verb}", names(below))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn joints_of_which_little_is_explained_are_named() {
        let joints = ["one", "two"].map(str::to_owned);
        let said = |percents: [f64; 2]| little(ill_fitted(&percents), &percents, &joints, "");
        assert_eq!(said([3.0, 49.0]), None);
        let one = said([3.0, 123.0]).expect("a joint");
        assert!(
            one.contains("`two` 123 %") && !one.contains("`one`"),
            "{one}"
        );
        let both = said([41.0, 43.0]).expect("all joints");
        assert!(both.contains("`one` 41 %, `two` 43 %"), "{both}");
        assert_eq!(ill_fitted(&[41.0]).count(), 0);
    }

    #[test]
    fn a_log_that_is_not_fitted_may_show_what_the_other_hardly_does() {
        let ill = |percents: &[f64]| ill_judged(percents).collect::<Vec<usize>>();
        assert!(ill(&[6.0, 12.0, 8.0, 172.0, 96.0]).is_empty());
        assert_eq!(ill(&[6.0, 12.0, 8.0, 12.0, 199.0]), [4]);
        assert_eq!(ill(&[99.9, 99.9, 99.9, 3.0, 4.0]), [0, 1, 2]);
    }

    #[test]
    fn a_log_that_shows_what_the_model_lacks_is_told_as_one() {
        let joints = ["one", "two"].map(str::to_owned);
        let said = |fitted: [f64; 2], judged: [f64; 2]| worse_judged(&fitted, &judged, &joints);
        let told = said([3.0, 6.0], [8.0, 172.0]).expect("a joint");
        assert!(
            told.contains("`two` 172 % (6 %)") && !told.contains("`one`"),
            "{told}"
        );
        assert_eq!(said([3.0, 6.0], [8.0, 60.0]), None);
        // One that is not explained anywhere is told as that.
        assert_eq!(said([3.0, 90.0], [8.0, 95.0]), None);
    }

    #[test]
    fn a_shape_with_a_deviation_of_its_size_is_told() {
        let told = untold_shape("turn.stribeck.vs", 0.0072, 0.0072).expect("not told");
        assert!(told.contains("values of `turn.stribeck`"), "{told}");
        assert_eq!(untold_shape("turn.stribeck.vs", 0.4, 0.05), None);
    }

    #[test]
    fn shapes_at_an_end_of_their_range_are_named() {
        let grid: Vec<f64> = (0..=10).map(f64::from).collect();
        let name = "turn.stribeck.vs".to_owned();
        let shapes = [Shape {
            name: name.clone(),
            grid,
        }];
        let said = |value: f64| at_ends(&[(name.clone(), value)], &shapes);
        assert!(said(9.996)[0].contains("the upper end of its range 0 .. 10"));
        assert!(said(0.0)[0].contains("the lower end of its range 0 .. 10"));
        for inside in [0.2, 5.0, 9.9] {
            assert_eq!(said(inside), Vec::<String>::new());
        }
    }
}
