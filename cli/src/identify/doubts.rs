//! What looks like another unit, sign or order than the spec's.

use robot_model::columns::Unknown;
use robot_model::identify::Estimate;
use robot_model::log::Log;
use robot_model_spec::Model;
use robot_model_spec::model::JointKind;

use crate::output::names;

/// Positions beyond this many times their limit are of another unit.
const BEYOND: f64 = 3.0;

/// A joint without limits that turns further than this, rad, in a log.
const FAR: f64 = 30.0;

/// What is left of each joint's torque, from where on the model says nothing of it, percent.
const LITTLE: f64 = 85.0;

/// Joints that go where none goes in radians or meters.
pub(super) fn far_positions(model: &Model, log: &Log) -> Vec<String> {
    let joints = model.joints.iter().enumerate();
    let far = joints.filter_map(|(k, joint)| {
        let is_prismatic = joint.kind == JointKind::Prismatic;
        let most = log.q[k].iter().map(|q| q.abs()).fold(0.0, f64::max);
        let limit = joint.limits.position;
        let free = if is_prismatic { f64::INFINITY } else { FAR };
        let limit = limit.map_or(free, |(low, high)| BEYOND * low.abs().max(high.abs()));
        (most > limit).then(|| {
            if is_prismatic {
                return format!(
                    "q{} of joint `{}` reaches {most:.1} m, {:.0} times its limit: is it in mm? Logs are in m",
                    k + 1,
                    joint.name,
                    BEYOND * most / limit
                );
            }
            format!(
                "q{} of joint `{}` reaches {most:.1} rad, which is {:.1} turns: is it in degrees? Logs are in rad",
                k + 1,
                joint.name,
                most / std::f64::consts::TAU
            )
        })
    });
    far.collect()
}

/// A model that explains next to nothing. What instruments leave of the torque has the noise of the columns in it, so least squares is
/// asked beside them.
pub(super) fn unexplained(estimate: &Estimate) -> Option<&'static str> {
    let hausman = estimate.hausman.as_ref();
    let all = hausman.map_or(&estimate.relative_percent, |both| {
        &both.least_squares_percent
    });
    let is_nothing = all.iter().all(|percent| *percent > LITTLE);
    is_nothing.then_some(
        "the model explains next to nothing of the torque of any joint; see whether the log has positions in rad and m, torques in N m \
         and N (else `actuator_gain`), signs and order of the spec's joints, and both of the same time",
    )
}

/// Parameters that no arm has below zero, and that are so by more than three deviations.
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
        .filter(|((_, value, std), unknown)| unknown.nonnegative && *value < -3.0 * std)
        .filter(|((_, value, _), _)| *value < 0.0)
        .map(|((name, ..), _)| name)
        .collect();
    if below.is_empty() {
        return None;
    }
    Some(format!(
        "{} below zero by more than three deviations, as no arm has it: see whether torques have the signs and the order of the spec's joints, \
         and what `trace` and `audit` say",
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
            "simulated positions are off by more than the noise of the logs ({}): torques have noise of their own, the model or its controller \
             is another than the arm's, or the search has ended in a valley that is not the deepest; deviations do not know of that, so \
             compare the costs of other starts and windows",
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
    let joints = model.joints.iter().enumerate();
    let resting = joints.filter_map(|(k, joint)| {
        let all = logs.iter().flat_map(|log| log.q[k].iter().copied());
        let (low, high) = all.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), q| {
            (low.min(q), high.max(q))
        });
        (high - low < HARDLY).then_some(joint.name.as_str())
    });
    let resting: Vec<&str> = resting.collect();
    let who = if resting.is_empty() {
        String::new()
    } else {
        format!("; {} hardly moving in these logs", names_are(&resting))
    };
    Some(format!(
        "the columns are hardly apart (condition {:.0}): noise of positions in them, which no deviation knows of, may be most of a value{who}; \
         `excite` makes a motion that tells them apart",
        estimate.condition
    ))
}

fn names_are(below: &[&str]) -> String {
    let verb = if below.len() == 1 { "is" } else { "are" };
    format!("{} {verb}", names(below))
}
