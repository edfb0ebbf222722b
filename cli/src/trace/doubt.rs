//! What is to be known of a verdict before anybody acts on it.

use robot_model::columns::Arm;
use robot_model::trace::{Floor, Outcome};
use robot_model_spec::model::{EffectExpr, EffectLeaf, Expr, Signal};

use crate::close_the_loop::Loop;
use crate::identify::hidden_delay;
use crate::identify::noted::mixed;
use crate::output::{names, significant};

/// An error that is smaller is at most this share of what it was.
const LEAST_FALL: f64 = 0.99;

/// Joints of which so many times as much is left, relative to the torque, on the log that was not fitted as on those that were, and more than so
/// many percent, are told: that is no matter of another motion.
const UNLIKE: [(f64, f64); 2] = [(3.0, 5.0), (5.0, 2.0)];

/// A law that takes this share off a joint's error on the logs that were fitted takes more than this part of it off on any log that shows it.
const FALL: f64 = 0.2;
const PART: f64 = 0.25;

/// What is to be known of a verdict before anybody acts on it, a sentence each.
pub(super) fn doubts(closed: &Loop) -> impl Iterator<Item = String> {
    let of_logs = closed.reading.clone().into_iter();
    let of_logs = of_logs
        .chain(vanished(closed))
        .chain(said_of_doubtful(closed))
        .chain(impossible(closed))
        .chain(of_springs(closed))
        .chain(hidden_delay(closed))
        .chain(beyond_floor(closed));
    of_logs
        .chain(not_borne_out(closed))
        .chain(hardly_borne_out(closed))
        .chain(said_of_unlike(closed))
}

/// That an effect is named no more once the arm was identified with it.
fn vanished(closed: &Loop) -> Option<String> {
    let lead = closed.verdict.leads.get(closed.vanished?)?;
    Some(format!(
        "the trace named {}, but identified with it, its size is below two standard deviations: the cause is something else, or the motion \
         does not separate this law from parameters of the spec",
        on_joints(closed, &lead.effect, &lead.joints)
    ))
}

/// The law that says that something is missing although it may not be named.
fn said_of_doubtful(closed: &Loop) -> Option<String> {
    let tried = closed.verdict.doubtful()?;
    let percent = tried
        .joints
        .iter()
        .map(|&joint| tried.evidence.raw_percent[joint]);
    let refusals: Vec<String> = tried.refusals.iter().map(ToString::to_string).collect();
    Some(format!(
        "{} reduces an error that it was not fitted to by {:.0} %, but is not the law ({}): something similar is missing",
        on_joints(closed, &tried.effect, &tried.joints),
        percent.fold(f64::NEG_INFINITY, f64::max),
        refusals.join(", ")
    ))
}

/// Whether some joint's error on the log that was not fitted is smaller with what was found; none where that was not asked.
pub(super) fn borne_out(closed: &Loop) -> Option<bool> {
    let (before, after) = (
        &closed.before.validation,
        &closed.changed.as_ref()?.validation,
    );
    let (before, after) = (&before.as_ref()?.rmse, &after.as_ref()?.rmse);
    let mut pairs = before.iter().zip(after);
    let is_smaller = |(before, after): (&f64, &f64)| *after < LEAST_FALL * before;
    Some(pairs.any(is_smaller))
}

/// Joints, from 0, of which much more is left on the log that was not fitted than on the logs that were.
pub(super) fn unlike(closed: &Loop) -> Vec<usize> {
    let Some((unseen, fitted)) = relative_percent(closed) else {
        return Vec::new();
    };
    (0..fitted.len())
        .filter(|&joint| is_unlike(unseen[joint], fitted[joint]))
        .collect()
}

fn is_unlike(unseen: f64, fitted: f64) -> bool {
    let mut limits = UNLIKE.iter();
    limits.any(|(times, percent)| unseen > *percent && unseen > times * fitted)
}

/// What the last model leaves on the log that was not fitted and on those that were, percent of each joint's torque.
fn relative_percent(closed: &Loop) -> Option<(&[f64], &[f64])> {
    let after = closed.after();
    let unseen = &after.validation.as_ref()?.relative_percent;
    Some((unseen, &after.estimate.relative_percent))
}

/// That the amended model shows a delay which the declared one, with more in its residual, did not.
fn hidden_delay(closed: &Loop) -> Option<String> {
    let late = hidden_delay::said(&closed.changed.as_ref()?.estimate)?;
    Some(format!(
        "with what was found, {late}: a small delay, or friction that is still another law"
    ))
}

/// That a spring which was found may have a share of its motor in it.
fn of_springs(closed: &Loop) -> Option<String> {
    let is_declared = mixed(closed.before.arm.compiled()).is_some();
    let changed = closed.changed.as_ref().filter(|_| !is_declared)?;
    mixed(changed.arm.compiled()).or_else(|| without_motor(closed))
}

/// That a spring which was found carries all inertia of its joint, since the spec has none of its motor.
fn without_motor(closed: &Loop) -> Option<String> {
    let model = &closed.after().arm.compiled().model;
    let has_motor = |joint: usize| {
        let reads = |part: &EffectExpr| {
            matches!(
                part,
                Expr::Leaf(EffectLeaf::Signal(Signal::Acceleration, _))
            )
        };
        // The coupling of a wrist is one of several joints, whatever else moves them.
        let mut own = model.effects.iter();
        own.any(|effect| {
            effect.joints == [joint]
                && effect
                    .definition
                    .torque_equations()
                    .any(|value| value.contains(&reads))
        })
    };
    let findings = closed.verdict.findings.iter();
    let springs = findings.filter(|finding| closed.is_spring(finding));
    let joints = springs.flat_map(|finding| &finding.joints);
    let joints: Vec<&str> = joints
        .filter(|joint| !has_motor(**joint))
        .map(|joint| model.joints[*joint].name.as_str())
        .collect();
    (!joints.is_empty()).then(|| {
        format!(
            "the spec has no motor inertia on {}, so the load that deflects the spring includes the motor's: if it is not small beside the link's, \
             declare `motor_inertia` there and trace again",
            names(&joints)
        )
    })
}

/// That a model with what was found leaves far more than noise: a name is no claim that nothing else is missing.
fn beyond_floor(closed: &Loop) -> Option<String> {
    if closed.outcome() != Outcome::Explained {
        return None;
    }
    let names = closed.before.arm.joints().iter().map(String::as_str);
    let floors = closed.verdict.noise_floor.iter();
    said_of_floors(names.zip(floors.map(Floor::exceeded)))
}

/// Joints with how many times the floor is left of them, where that is too much.
fn said_of_floors<'a>(joints: impl Iterator<Item = (&'a str, Option<f64>)>) -> Option<String> {
    let told = joints.filter_map(|(name, times)| Some(format!("{:.1} on {name}", times?)));
    let told: Vec<String> = told.collect();
    (!told.is_empty()).then(|| {
        format!(
            "away from velocity reversals the amended model leaves a residual this many times the noise floor: {}; the logs contain more than the effects named here",
            told.join(", ")
        )
    })
}

/// That the log which was not fitted shows what those that were do not: no verdict is of that.
fn said_of_unlike(closed: &Loop) -> Option<String> {
    let (unseen, fitted) = relative_percent(closed)?;
    let names = closed.before.arm.joints();
    let joints = unlike(closed).into_iter().map(|joint| {
        format!(
            "{}: residual {:.1} % of its torque, on the traced logs {:.1} %",
            names[joint], unseen[joint], fitted[joint]
        )
    });
    let joints: Vec<String> = joints.collect();
    (!joints.is_empty()).then(|| {
        format!(
            "the validation log shows an effect that the traced logs do not ({}): trace it too, and validate on another log",
            joints.join("; ")
        )
    })
}

/// That the log which was not fitted is against what was found.
fn not_borne_out(closed: &Loop) -> Option<String> {
    let is_against = closed.outcome() == Outcome::Explained && borne_out(closed) == Some(false);
    is_against.then(|| {
        "it reduces no joint's error on the validation log by even 1 %: the validation log does not confirm it, so treat it as a guess \
         until another log does".to_owned()
    })
}

/// That what was found does far less on the log that was not fitted: a law that looks like another one along one motion does not along the
/// next.
fn hardly_borne_out(closed: &Loop) -> Option<String> {
    if closed.outcome() != Outcome::Explained || borne_out(closed) != Some(true) {
        return None;
    }
    let after = closed.changed.as_ref()?;
    let (unseen, unseen_after) = (
        closed.before.validation.as_ref()?,
        after.validation.as_ref()?,
    );
    let fall = |before: &[f64], after: &[f64]| -> Vec<f64> {
        let pairs = before.iter().zip(after);
        pairs.map(|(before, after)| 1.0 - after / before).collect()
    };
    let fitted = fall(
        &closed.before.estimate.relative_percent,
        &after.estimate.relative_percent,
    );
    let unseen = fall(&unseen.relative_percent, &unseen_after.relative_percent);
    // A joint without any error has no fall.
    let joints = (0..fitted.len()).filter(|&k| fitted[k].is_finite() && unseen[k].is_finite());
    let joint = joints.max_by(|&a, &b| fitted[a].total_cmp(&fitted[b]))?;
    said_of_falls(
        closed.before.arm.joints().get(joint)?,
        fitted[joint],
        unseen[joint],
    )
}

fn said_of_falls(joint: &str, fitted: f64, unseen: f64) -> Option<String> {
    (fitted > FALL && unseen < PART * fitted).then(|| {
        format!(
            "it reduces {joint}'s error by {:.0} % on the traced logs, but by {:.0} % on the validation log: either the validation log \
             hardly shows it, or another law looks like it along the traced motion; trace a log of another motion too",
            100.0 * fitted,
            100.0 * unseen.max(0.0)
        )
    })
}

/// Parameters in which something that is missing hides.
fn impossible(closed: &Loop) -> impl Iterator<Item = String> {
    closed.impossible().map(|found| {
        format!(
            "{} = {:.4} +- {} is negative, which is physically impossible: an undeclared effect looks like it along these logs, for example \
             friction that falls with speed over the whole motion; measure friction at constant speeds (`robot-model friction`)",
            found.name,
            found.value,
            significant(found.std, 2)
        )
    })
}

/// An effect by its name in the language, as reports spell names.
pub(super) fn called(effect: &str) -> String {
    effect.replace('_', "-")
}

/// An effect and its joints, where it has some.
pub(super) fn on_joints(closed: &Loop, effect: &str, on: &[usize]) -> String {
    let name = called(effect);
    if on.is_empty() {
        return name;
    }
    let names = closed.before.arm.joints();
    let names: Vec<&str> = on.iter().map(|&joint| names[joint].as_str()).collect();
    format!("{name} on {}", names.join(", "))
}

#[cfg(test)]
mod tests {
    use super::{is_unlike, said_of_falls, said_of_floors};

    #[test]
    fn a_log_that_shows_more_has_several_times_the_error() {
        assert!(is_unlike(6.0, 1.9) && is_unlike(4.9, 0.6));
        assert!(!is_unlike(6.0, 2.1) && !is_unlike(4.9, 1.2) && !is_unlike(1.9, 0.1));
    }

    #[test]
    fn a_law_that_does_far_less_on_another_motion_is_told() {
        let told = said_of_falls("elbow", 0.6, 0.14).expect("an approximation");
        assert!(
            told.starts_with("it reduces elbow's error by 60 % on the traced logs, but by 14 % on"),
            "{told}"
        );
        assert_eq!(said_of_falls("elbow", 0.6, 0.4), None);
        // Little that is hardly there.
        assert_eq!(said_of_falls("elbow", 0.1, 0.01), None);
    }

    #[test]
    fn joints_that_are_left_far_from_the_floor_are_told() {
        let told = said_of_floors([("hip", None), ("knee", Some(4.96))].into_iter());
        let told = told.expect("one joint is far from it");
        assert!(
            told.contains("this many times the noise floor: 5.0 on knee;"),
            "{told}"
        );
        assert_eq!(said_of_floors([("hip", None)].into_iter()), None);
    }
}
