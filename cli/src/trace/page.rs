//! The report of a trace.

mod verdict;

use std::path::PathBuf;

use robot_model::columns::Arm;
use robot_model::trace::FloorFrom;
use robot_model_spec::model::{Joint, JointKind};

use super::next::Next;
use super::parameters::{found, parameters as of_all};
use super::said::{errors_of, nothing_added};
use super::tried::rows;
use crate::Error;
use crate::close_the_loop::{Loop, Stage};
use crate::diff::diff;
use crate::output::{sentence, significant, unmarked};
use crate::report::{
    Bars, Drawn, Ink, Page, Shown, again, as_read, base_parameters, figures, parameters,
};

/// Joints whose figures are open from the start.
const OPEN: usize = 2;

/// The page on a traced spec at a path, whose text is given, and on files that were read, with what was noted of these; and what comes next.
pub(super) fn page(
    (spec, text): (&str, &str),
    closed: &Loop,
    (inputs, read): (&[PathBuf], &[String]),
    next: Option<Next>,
) -> Result<String, Error> {
    let mut page = Page::new(
        &format!("Trace of {}", closed.before.arm.compiled().model.name),
        &format!("Effects in the logs that {spec} does not declare."),
    );
    page.section("Verdict");
    verdict::verdict(&mut page, closed);
    verdict::open_questions(&mut page, spec, text, closed);
    if let Some(next) = next {
        page.part("Next");
        page.text(&next.what);
        page.commands(&next.commands.join("\n"));
    }
    page.section(if closed.changed.is_some() {
        "Errors before and after"
    } else {
        "Errors"
    });
    errors(&mut page, closed);
    page.section("Change of the spec");
    match nothing_added(closed) {
        Some(why) => page.text(&sentence(&why)),
        None => page.preformatted(&diff(text, &closed.amended)),
    }
    page.section("Residuals");
    residuals(&mut page, closed)?;
    page.section("What was tried");
    tried(&mut page, closed);
    page.section("Data");
    let plain = |note: &String| unmarked(note).to_owned();
    as_read(&mut page, &read.iter().map(plain).collect::<Vec<_>>());
    data(&mut page, closed);
    page.section("Parameters");
    let compiled = closed.after().arm.compiled();
    let found = found(closed);
    parameters(&mut page, compiled, &of_all(closed, &found));
    page.section("Base parameters");
    base_parameters(&mut page, compiled);
    again(&mut page, inputs)?;
    Ok(page.finish())
}

fn errors(page: &mut Page, closed: &Loop) {
    let stages: Vec<(&str, &Stage)> = match &closed.changed {
        Some(after) => vec![(" before", &closed.before), (" after", after)],
        None => vec![("", &closed.before)],
    };
    let torque = torque_unit(closed);
    let heads = [
        "fitted, %".to_owned(),
        "validation, %".to_owned(),
        format!("validation RMSE, {torque}"),
    ];
    let stages_of = |of: &String| {
        let (of, unit) = of.split_once(", ").expect("a name and a unit");
        let whiches = stages.iter();
        let heads = whiches.map(|(which, _)| format!("{of}{which}, {unit}"));
        heads.collect::<Vec<_>>()
    };
    let heads = heads.iter().flat_map(stages_of);
    let heads: Vec<String> = std::iter::once("joint".to_owned())
        .chain(heads)
        .chain([format!("floor, {torque}")])
        .collect();
    let joints = closed.before.arm.joints().iter().enumerate();
    let rows = joints.map(|(j, name)| {
        let percent = |values: &[f64]| format!("{:.2}", values[j]);
        let or_none = |told: Option<String>| told.unwrap_or_else(|| "-".to_owned());
        let fitted = stages
            .iter()
            .map(|(_, stage)| percent(&stage.estimate.relative_percent));
        let rmse = stages.iter().map(|(_, stage)| {
            let errors = stage.validation.as_ref();
            or_none(errors.map(|errors| significant(errors.rmse[j], 4)))
        });
        let unseen = stages.iter().map(|(_, stage)| {
            let errors = stage.validation.as_ref();
            or_none(errors.map(|errors| percent(&errors.relative_percent)))
        });
        let floor = &closed.verdict.noise_floor[j];
        let floor = format!(
            "{} +- {}",
            significant(floor.rms, 3),
            significant(floor.std, 1)
        );
        let cells = fitted.chain(unseen).chain(rmse);
        std::iter::once(name.clone())
            .chain(cells)
            .chain([floor])
            .collect()
    });
    let rows: Vec<Vec<String>> = rows.collect();
    let from = closed.verdict.noise_floor.first().map(|floor| floor.from);
    let floor = match from {
        Some(FloorFrom::Periods) => "variation between periods of the motion",
        _ => "upper bound: residual of curves over the motion, on data they were not fitted to",
    };
    page.figures(
        &[bars(closed)],
        &models(closed),
        &format!(
            "Error over torque, in the filtered band, on {}.",
            if closed.before.validation.is_some() {
                "the validation log"
            } else {
                "the fitted logs"
            }
        ),
    );
    let of: Vec<String> = errors_of(closed)
        .iter()
        .map(|said| sentence(said))
        .collect();
    page.cards(
        &format!(
            "RMSE of raw samples, first and last second cut; relative errors (%) in the filtered band. Noise floor, of raw samples of the \
             fitted logs: {floor}. {}",
            of.join(" ")
        ),
        &heads.iter().map(String::as_str).collect::<Vec<_>>(),
        &rows,
    );
    if closed.before.validation.is_none() {
        page.text("Give a validation log with --validate.");
    }
}

/// The unit of torques, of all joints.
fn torque_unit(closed: &Loop) -> &'static str {
    let joints = &closed.before.arm.compiled().model.joints;
    let slides = |joint: &Joint| joint.kind == JointKind::Prismatic;
    if joints.iter().all(slides) {
        "N"
    } else if joints.iter().any(slides) {
        "N m or N"
    } else {
        "N m"
    }
}

/// Relative errors of every joint, of the validation log where there is one.
fn bars(closed: &Loop) -> String {
    let percents = |stage: &Stage| {
        let unseen = stage.validation.as_ref();
        unseen.map_or_else(
            || stage.estimate.relative_percent.clone(),
            |errors| errors.relative_percent.clone(),
        )
    };
    let mut models = vec![(Ink::Before, percents(&closed.before))];
    if closed.changed.is_some() {
        models.push((Ink::After, percents(closed.after())));
    }
    let bars = Bars {
        label: if closed.changed.is_some() {
            "relative errors of every joint before and after the amendment"
        } else {
            "relative errors of every joint, of the declared model"
        },
        x: "relative error, %",
        joints: closed.before.arm.joints(),
        models,
    };
    bars.svg()
}

/// Models that are drawn, and their colors: the amended one where something was added.
fn models(closed: &Loop) -> Vec<(&'static str, &'static str)> {
    let mut models = vec![("before", "declared model")];
    if closed.changed.is_some() {
        models.push(("after", "amended model"));
    }
    models
}

fn residuals(page: &mut Page, closed: &Loop) -> Result<(), Error> {
    let shown = |color| {
        let stage = match color {
            Ink::Before => &closed.before,
            _ => closed.after(),
        };
        Shown {
            color,
            arm: &stage.arm,
            estimate: &stage.estimate,
        }
    };
    let mut drawn = vec![shown(Ink::Before)];
    if closed.changed.is_some() {
        drawn.push(shown(Ink::After));
    }
    let (log, which) = match &closed.unseen {
        Some(log) => (log, "the validation log"),
        None => (&closed.traced[0], "the first fitted log"),
    };
    page.text(&format!("On {which}, {}.", log.source));
    let model = &closed.before.arm.compiled().model;
    let drawn = Drawn::new(model, &drawn, log)?;
    let named = |joint: usize| {
        let mut found = closed.verdict.findings.iter().chain(&closed.verdict.leads);
        found.any(|finding| finding.joints.contains(&joint))
            || closed.verdict.after[joint].is_material()
    };
    let joints = 0..closed.before.arm.dof();
    let mut open: Vec<usize> = joints.filter(|&joint| named(joint)).take(OPEN).collect();
    if open.is_empty() {
        open.push(0);
    }
    figures(
        page,
        closed.before.arm.joints(),
        &drawn,
        &models(closed),
        &|joint| open.contains(&joint),
    );
    Ok(())
}

fn tried(page: &mut Page, closed: &Loop) {
    let rows = rows(closed, usize::MAX, &|_| true);
    if rows.is_empty() {
        page.text(if closed.faults.iter().any(|fault| fault.is_last) {
            "Nothing: logs with such a fault cannot show effects."
        } else {
            "Nothing: the spec declares all known effects."
        });
        return;
    }
    let effect_first = |row: [String; 6]| {
        let [round, effect, score, held_out, raw, outcome] = row;
        vec![effect, round, score, held_out, raw, outcome]
    };
    page.cards(
        "Effects that explained most in each round; score: Wald test over blocks of time; held-out and raw: largest \
         fall of a joint's error on folds not fitted.",
        &["effect", "round", "score", "held-out", "raw", "outcome"],
        &rows.into_iter().map(effect_first).collect::<Vec<_>>(),
    );
}

fn data(page: &mut Page, closed: &Loop) {
    if closed.faults.is_empty() {
        page.text(
            "No fault of the logs is part of the verdict. What the checks below say of errors is beside the declared model: a missing effect \
             may look like a delay there.",
        );
    } else {
        let faults = closed.faults.iter();
        let told = faults.map(|fault| format!("{}: {}", fault.kind, fault.told));
        page.list(&told.collect::<Vec<_>>());
    }
    let checks = closed.checks.iter();
    let rows = checks.map(|check| vec![check.of.to_owned(), check.found.join("; ")]);
    page.table(
        "Checks of the fitted logs before tracing",
        &["looked for", "found"],
        &rows.collect::<Vec<_>>(),
    );
    let structure = closed.verdict.before.iter().zip(&closed.verdict.after);
    let joints = closed.before.arm.joints().iter().zip(structure);
    let rows = joints.map(|(name, (before, after))| {
        let percent = |share: f64| format!("{:.0} %", 100.0 * share);
        let mut row = vec![name.clone(), percent(before.share)];
        if !closed.verdict.findings.is_empty() {
            row.push(percent(after.share));
        }
        row
    });
    // What was traced are logs without their faults; errors are told of the logs as they are.
    let declared = if closed.faults.is_empty() {
        "declared model"
    } else {
        "declared model, once the faults are removed"
    };
    let mut heads = vec!["joint", declared];
    if !closed.verdict.findings.is_empty() {
        heads.push("with the findings");
    }
    page.table(
        "Share of the error's power that follows the motion",
        &heads,
        &rows.collect::<Vec<_>>(),
    );
}
