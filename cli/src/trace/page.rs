//! The report of a trace.

use robot_model::columns::Arm;
use robot_model::trace::{FloorFrom, Outcome};

use super::doubt::{doubt, doubts, on_joints};
use super::report::effect;
use super::tried::rows;
use super::whereabouts::structure_left;
use crate::Error;
use crate::close_the_loop::{Loop, Stage};
use crate::diff::diff;
use crate::identify::report::identified;
use crate::output::significant;
use crate::report::{
    Bars, Drawn, Ink, Page, Shown, base_parameters, figures, invocation, parameters,
};

/// Joints whose figures are open from the start.
const OPEN: usize = 2;

/// The page on a traced spec at a path, whose text is given.
pub(super) fn page(spec: &str, closed: &Loop, text: &str) -> Result<String, Error> {
    let mut page = Page::new(
        &format!("Trace of {}", closed.before.arm.compiled().model.name),
        &format!("What {spec} does not say of the arm, by its logs."),
    );
    page.section("Verdict");
    verdict(&mut page, spec, text, closed);
    page.section("Errors before and after");
    errors(&mut page, closed);
    let change = diff(text, &closed.amended);
    if !change.is_empty() {
        page.section("Change of the spec");
        page.preformatted(&change);
    }
    page.section("Residuals");
    residuals(&mut page, closed)?;
    page.section("What was tried");
    tried(&mut page, closed);
    page.section("Data");
    data(&mut page, closed);
    let after = closed.after();
    page.section("Parameters");
    let compiled = after.arm.compiled();
    parameters(&mut page, compiled, &identified(&after.estimate));
    page.section("Base parameters");
    base_parameters(&mut page, compiled);
    page.section("Again");
    page.text("The same page from the same files:");
    page.preformatted(&invocation());
    Ok(page.finish())
}

fn verdict(page: &mut Page, spec: &str, text: &str, closed: &Loop) {
    let verdict = &closed.verdict;
    match closed.outcome() {
        Outcome::NothingMissing => page.verdict(
            "good",
            "Nothing missing",
            "The declared model leaves no structure that matters.",
        ),
        Outcome::Explained => page.verdict(
            "known",
            "Explained",
            "These effects account for what the declared model left.",
        ),
        // Unexplained, or an outcome of which this page knows no more.
        _ => page.verdict(
            "open",
            "Unexplained",
            "The residual follows the motion, and no known effect accounts for it.",
        ),
    }
    let faults = closed.faults.iter();
    let mut items: Vec<String> = faults
        .map(|fault| format!("{}: {}", fault.kind, fault.told))
        .collect();
    let found = verdict.findings.iter().chain(&verdict.leads).enumerate();
    items.extend(found.map(|(place, finding)| {
        let values = effect(finding, closed, place).parameters;
        let values = values.iter().map(|one| match one.interval {
            Some([low, high]) => format!(
                "{} = {} ({} .. {})",
                one.name,
                significant(one.value, 4),
                significant(low, 4),
                significant(high, 4)
            ),
            None => format!("{} = {}", one.name, significant(one.value, 4)),
        });
        let lead = if verdict.outcome == Outcome::Unexplained {
            "a lead: "
        } else {
            ""
        };
        format!(
            "{lead}{}: {}",
            on_joints(closed, &finding.kind, &finding.joints),
            values.collect::<Vec<_>>().join(", ")
        )
    }));
    items.extend(doubts(closed));
    if !items.is_empty() {
        page.list(&items);
    }
    if verdict.outcome == Outcome::Explained && !verdict.alternatives.is_empty() {
        page.part("What these logs cannot tell from it");
        let doubt = doubt(spec, text, closed);
        let lines = doubt.lines().map(|line| line.trim().to_owned());
        page.list(&lines.collect::<Vec<_>>());
    }
    let left = structure_left(closed).into_iter();
    let left: Vec<String> = left.map(|said| said.join("; ")).collect();
    if !left.is_empty() {
        page.part("Where the structure lives that is left");
        page.list(&left);
    }
}

fn errors(page: &mut Page, closed: &Loop) {
    let (before, after) = (&closed.before, closed.after());
    let rows = closed
        .before
        .arm
        .joints()
        .iter()
        .enumerate()
        .map(|(j, name)| {
            let percent = |values: &[f64]| format!("{:.2} %", values[j]);
            let mut row = vec![
                name.clone(),
                percent(&before.estimate.relative_percent),
                percent(&after.estimate.relative_percent),
            ];
            for stage in [before, after] {
                let rmse = stage.validation.as_ref().map(|errors| errors.rmse[j]);
                row.push(rmse.map_or("-".to_owned(), |rmse| significant(rmse, 4)));
            }
            for stage in [before, after] {
                let share = stage.validation.as_ref();
                let share = share.map(|errors| percent(&errors.relative_percent));
                row.push(share.unwrap_or_else(|| "-".to_owned()));
            }
            let floor = &closed.verdict.noise_floor[j];
            row.push(format!(
                "{} +- {}",
                significant(floor.rms, 3),
                significant(floor.std, 1)
            ));
            row
        });
    let from = closed.verdict.noise_floor.first().map(|floor| floor.from);
    let floor = match from {
        Some(FloorFrom::Periods) => "what differs from period to period of the motion",
        _ => "what curves in quantities of the motion leave of data that they were not fitted on",
    };
    page.figures(
        &[bars(closed)],
        &[("before", "declared model"), ("after", "amended model")],
        &format!(
            "Error over torque, in the filtered band, on {}.",
            if closed.before.validation.is_some() {
                "the log that was not fitted"
            } else {
                "the logs that were fitted"
            }
        ),
    );
    page.table(
        &format!(
            "RMSE of raw samples in N m (prismatic joints: N), first and last second cut; relative errors in the filtered band. \
             The floor is of the fitted logs: {floor}."
        ),
        &[
            "joint",
            "fitted before",
            "fitted after",
            "unseen RMSE before",
            "unseen RMSE after",
            "unseen before",
            "unseen after",
            "floor",
        ],
        &rows.collect::<Vec<_>>(),
    );
    if closed.before.validation.is_none() {
        page.text("Give --validate for a log that is not fitted.");
    }
}

/// Relative errors of every joint, of the log that was not fitted where there is one.
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
        label: "relative errors of every joint before and after the amendment",
        x: "relative error, %",
        joints: closed.before.arm.joints(),
        models,
    };
    bars.svg()
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
    let mut models = vec![shown(Ink::Before)];
    let mut legend = vec![("before", "declared model")];
    if closed.changed.is_some() {
        models.push(shown(Ink::After));
        legend.push(("after", "amended model"));
    }
    let (log, which) = match &closed.unseen {
        Some(log) => (log, "the log that was not fitted"),
        None => (&closed.traced[0], "the first log that was fitted"),
    };
    page.text(&format!("On {which}, {}.", log.source));
    let model = &closed.before.arm.compiled().model;
    let drawn = Drawn::new(model, &models, log)?;
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
        &legend,
        &|joint| open.contains(&joint),
    );
    Ok(())
}

fn tried(page: &mut Page, closed: &Loop) {
    let rows = rows(closed, usize::MAX, &|_| true);
    if rows.is_empty() {
        page.text("Nothing: no effect is left that the spec does not declare.");
        return;
    }
    let rows: Vec<Vec<String>> = rows.into_iter().map(|row| row.to_vec()).collect();
    page.table(
        "Effects that explained most in each round; score: Wald test over blocks of time; held-out and raw: fall of the error on folds that \
         were not fitted, on the joint where it is most.",
        &["round", "effect", "score", "held-out", "raw", "outcome"],
        &rows,
    );
}

fn data(page: &mut Page, closed: &Loop) {
    if closed.faults.is_empty() {
        page.text("No fault of the logs changes what a joint's error is.");
    }
    let structure = closed.verdict.before.iter().zip(&closed.verdict.after);
    let joints = closed.before.arm.joints().iter().zip(structure);
    let rows = joints.map(|(name, (before, after))| {
        let percent = |share: f64| format!("{:.0} %", 100.0 * share);
        vec![name.clone(), percent(before.share), percent(after.share)]
    });
    page.table(
        "Share of the error's power that follows the motion",
        &["joint", "declared model", "with the findings"],
        &rows.collect::<Vec<_>>(),
    );
}
