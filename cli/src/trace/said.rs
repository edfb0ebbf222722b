//! How a trace ended and what its errors are of: sentences that the terminal and the page have in common.

use robot_model::columns::Arm;
use robot_model::trace::{Finding, Outcome};

use crate::close_the_loop::{Loop, Stage, Sure};
use crate::output::{decimals, significant};
use crate::report::unit_and_meaning;
use crate::units::Units;

use super::doubt::called;
use super::whereabouts::Along;

/// How it ended, without a capital and a full stop.
pub(super) fn outcome(closed: &Loop) -> &'static str {
    let (has_effects, has_faults) = (
        !closed.verdict.findings.is_empty(),
        !closed.faults.is_empty(),
    );
    match closed.outcome() {
        Outcome::NothingMissing => "the declared model leaves no significant structure",
        Outcome::Explained if closed.faults.iter().any(|fault| fault.is_last) => {
            "the logs have faults; fix these first, nothing else was traced"
        }
        Outcome::Explained if has_effects && has_faults => {
            "these effects and the faults of the logs explain the residual of the declared model"
        }
        Outcome::Explained if has_faults => {
            "the faults of the logs explain the residual of the declared model"
        }
        Outcome::Explained if leaves_more(closed) => {
            "these effects explain most of the residual of the declared model; where the rest is, follows below"
        }
        Outcome::Explained => "these effects explain the residual of the declared model",
        Outcome::Unexplained if !closed.verdict.series.is_empty() => {
            "the residual follows the motion; the listed effects are several laws of one joint's position, which together fit any curve, so none is named"
        }
        Outcome::Unexplained if closed.reading.is_some() => {
            "the logs seem to be misread; fix this first, nothing else was traced"
        }
        // Unexplained, or an outcome of which nothing more is known here.
        _ => unexplained(Along::all(closed), !closed.verdict.leads.is_empty()),
    }
}

/// What structure goes along with that no effect explains, and whether some pass the gates all the same.
const fn unexplained(along: Along, has_leads: bool) -> &'static str {
    match (along, has_leads) {
        (Along::Motion, false) => {
            "the residual follows the motion, but no known effect explains it"
        }
        (Along::Motion, true) => {
            "the residual follows the motion; the listed effects pass the gates but do not explain its structure, so none is named"
        }
        (Along::Time, false) => {
            "the residual wanders in time, more than it follows the motion; no known effect explains it"
        }
        (Along::Time, true) => {
            "the residual wanders in time, more than it follows the motion; the listed effects pass the gates but do not explain that, so none \
             is named"
        }
        (Along::Step, false) => "the residual's level changes, and no known effect explains it",
        (Along::Step, true) => {
            "the residual's level changes; the listed effects pass the gates but do not explain that, so none is named"
        }
        (Along::Nothing, false) => {
            "the residual is more than noise, but most of it follows from no quantity that it was compared with; no known effect explains it"
        }
        (Along::Nothing, true) => {
            "the residual is more than noise, but most of it follows from no quantity that it was compared with; the listed effects pass the \
             gates but do not explain it, so none is named"
        }
    }
}

/// Whether structure is left beside what explains most of it, or far more than noise.
fn leaves_more(closed: &Loop) -> bool {
    let mut floors = closed.verdict.noise_floor.iter();
    !closed.verdict.left.is_empty() || floors.any(|floor| floor.exceeded().is_some())
}

/// What stands behind `explained` in a headline where more is left than should be.
pub(super) fn in_part(closed: &Loop) -> &'static str {
    if leaves_more(closed) { " in part" } else { "" }
}

/// Why the spec is as it was; none where it is not.
pub(super) fn nothing_added(closed: &Loop) -> Option<String> {
    let why = match closed.outcome() {
        Outcome::Explained => "a spec cannot declare faults of logs",
        Outcome::Unexplained
            if closed.verdict.series.is_empty() && !closed.verdict.leads.is_empty() =>
        {
            "no lead explains the structure of the residual"
        }
        _ => outcome(closed),
    };
    closed
        .changed
        .is_none()
        .then(|| format!("nothing was added to the spec: {why}"))
}

/// A parameter of a finding with its unit, and what stands beside its value where there is a deviation: `fc = 1.82 +- 0.01 N m`. The value
/// has the decimals of two digits of the deviation. One that others replace has no value of its own.
pub(super) fn parameter(
    closed: &Loop,
    finding: &Finding,
    (name, value, sure): (&str, f64, Sure),
    beside: impl FnOnce(usize) -> String,
) -> String {
    let unit = match unit(closed, finding, name).as_str() {
        "" | "1" => String::new(),
        unit => format!(" {unit}"),
    };
    let value_in_unit = || format!("{}{unit}", significant(value, 4));
    let why = sure.without_interval().unwrap_or_default();
    let mut traced = finding.parameters.iter();
    let has_turned = traced.any(|one| one.name == name && !one.is_possible);
    let sign = if has_turned {
        " (must not be negative)"
    } else {
        ""
    };
    match sure {
        Sure::Std(std) if std > 0.0 => {
            let decimals = decimals(std, 2);
            let beside = beside(decimals);
            format!("{name} = {value:.decimals$}{beside}{unit}{sign}")
        }
        Sure::Std(_) => format!("{name} = {}{sign}", value_in_unit()),
        Sure::Nominal => format!("{name} = {}, {why}", value_in_unit()),
        Sure::Traded => format!("{name} {why}"),
        Sure::Unfelt => format!("{name} {why} ({} in the spec)", value_in_unit()),
    }
}

/// What JSON calls a finding that its spec has by another name.
pub(super) fn of_kind(finding: &Finding) -> String {
    if called(&finding.effect) == finding.kind {
        String::new()
    } else {
        format!(" (of the kind {})", finding.kind)
    }
}

/// The unit of a finding's parameter, as its effect's definition has it.
fn unit(closed: &Loop, finding: &Finding, name: &str) -> String {
    let model = &closed.before.arm.compiled().model;
    let definition = model.definitions.iter();
    let definition = definition.filter(|one| one.name == finding.effect);
    let docs = definition.flat_map(|one| {
        let linear = one.linear.iter().map(|own| (&own.name, &own.doc));
        linear.chain(one.shapes.iter().map(|own| (&own.name, &own.doc)))
    });
    let mut docs = docs.filter(|(own, _)| *own == name);
    let joint = finding.joints.first();
    let joint = joint.map(|joint| model.joints[*joint].kind);
    docs.next()
        .map_or_else(String::new, |(_, doc)| unit_and_meaning(doc, joint).0)
}

/// Joints whose fall is told.
const MOST_FALLS: usize = 3;

/// By how much the error falls on the log that was not fitted, of the joints where that is most of their torque; none where it does not.
pub(super) fn fall(closed: &Loop) -> Option<String> {
    let after = closed.changed.as_ref()?.validation.as_ref()?;
    let before = closed.before.validation.as_ref()?;
    let (before, after) = (&before.relative_percent, &after.relative_percent);
    falls(closed.before.arm.joints(), before, after)
}

/// The same of joints by their names, with percents of their torque.
fn falls(names: &[String], before: &[f64], after: &[f64]) -> Option<String> {
    let fall = |joint: usize| before[joint] - after[joint];
    let mut joints: Vec<usize> = (0..before.len()).collect();
    joints.sort_by(|a, b| fall(*b).total_cmp(&fall(*a)));
    let first = *joints.first()?;
    if fall(first) <= 0.01 * before[first] {
        return None;
    }
    // Beside the largest those that take a twentieth off.
    let counts = |joint: &usize| *joint == first || fall(*joint) > 0.05 * before[*joint];
    let told = joints.into_iter().filter(counts).take(MOST_FALLS);
    let told = told.map(|joint| {
        let falls = if joint == first { " falls" } else { "" };
        let (name, before, after) = (&names[joint], before[joint], after[joint]);
        format!("{name}{falls} from {before:.2} to {after:.2} %")
    });
    let told: Vec<String> = told.collect();
    Some(format!(
        "on the validation log the error of {} of its torque",
        told.join(", that of ")
    ))
}

/// What errors before and after are of, beside what [`ERRORS`](crate::output::ERRORS) says: how joints turn round, and bands where they differ.
pub(super) fn errors_of(closed: &Loop) -> Vec<String> {
    turning(closed).into_iter().chain(bands(closed)).collect()
}

/// How slowly joints turn round, where the logs tell.
fn turning(closed: &Loop) -> Option<String> {
    let joints = &closed.before.arm.compiled().model.joints;
    let told = |stage: &Stage| {
        let speeds = joints.iter().zip(&stage.turn_speeds);
        let speeds = speeds.filter(|(_, speed)| **speed > 0.0);
        let speeds = speeds.map(|(joint, speed)| {
            let unit = Units::of(joint.kind).velocity;
            format!("{} {unit} on {}", significant(*speed, 2), joint.name)
        });
        let speeds: Vec<String> = speeds.collect();
        if speeds.is_empty() {
            "0".to_owned()
        } else {
            speeds.join(", ")
        }
    };
    let stages = [&closed.before, closed.after()];
    let mut speeds = stages.iter().flat_map(|stage| &stage.turn_speeds);
    if !speeds.any(|speed| *speed > 0.0) {
        return None;
    }
    let [before, after] = stages.map(told);
    let widths = if before == after {
        format!("w = {after}")
    } else {
        format!("w = {before} before, and {after} after")
    };
    Some(format!(
        "velocity reversals are smoothed as fitted to the logs: sign(dq) becomes tanh(dq / w), {widths}; `identify` does not do that, so \
         its errors for the same model and log differ"
    ))
}

/// The bands of both models, where they are not the same.
fn bands(closed: &Loop) -> Option<String> {
    let [before, after] = [&closed.before, closed.after()].map(|stage| stage.estimate.bands);
    (before != after).then(|| {
        format!(
            "bands of the filters (shared, smooth, wide) are {before} before, and {after} after, since links follow the load"
        )
    })
}

#[cfg(test)]
mod tests {
    use super::falls;

    #[test]
    fn falls_of_several_joints_are_told_the_largest_first() {
        let names = ["a", "b", "c"].map(str::to_owned);
        let told = |before: [f64; 3], after: [f64; 3]| falls(&names, &before, &after);
        assert_eq!(
            told([5.0, 30.0, 1.0], [0.5, 0.5, 0.99]).as_deref(),
            Some(
                "on the validation log the error of b falls from 30.00 to 0.50 %, that of a from 5.00 to 0.50 % of its torque"
            )
        );
        assert_eq!(told([5.0, 3.0, 1.0], [5.0, 2.99, 1.1]), None);
    }
}
