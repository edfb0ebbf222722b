//! What a trace says, and what it leaves open: the head of its report.

use robot_model::trace::Outcome;

use super::super::apart::{apart, undistinguished};
use super::super::doubt::{doubts, on_joints};
use super::super::report::effect;
use super::super::said::{fall, in_part, of_kind, outcome, parameter};
use super::super::whereabouts::structure_left;
use crate::close_the_loop::Loop;
use crate::output::sentence;
use crate::report::Page;

/// What is between words and the command that they ask for.
const COMMAND: &str = ": robot-model ";

/// Effects that a headline names; of more it says how many.
const MOST_NAMED: usize = 3;

/// The verdict, what was found, and what is doubtful about it.
pub(super) fn verdict(page: &mut Page, closed: &Loop) {
    let verdict = &closed.verdict;
    let (class, word) = match closed.outcome() {
        Outcome::NothingMissing => ("good", "Nothing missing"),
        Outcome::Explained => ("known", "Explained"),
        // Unexplained, or an outcome of which this page knows no more.
        _ => ("open", "Unexplained"),
    };
    let word = match closed.outcome() {
        Outcome::Explained => explained(closed),
        _ => word.to_owned(),
    };
    page.verdict(class, &word, &sentence(outcome(closed)));
    let faults = closed.faults.iter();
    let mut items: Vec<String> = faults
        .map(|fault| format!("{}: {}", fault.kind, fault.told))
        .collect();
    let found = verdict.findings.iter().chain(&verdict.leads).enumerate();
    items.extend(found.map(|(place, finding)| {
        let values = effect(finding, closed, place).parameters;
        let values = values.iter().map(|own| {
            let told = (own.name, own.value, own.sure);
            parameter(closed, finding, told, |decimals| match own.interval {
                Some([low, high]) => format!(" ({low:.decimals$} .. {high:.decimals$})"),
                None => String::new(),
            })
        });
        let lead = if verdict.outcome == Outcome::Unexplained {
            "a lead: "
        } else {
            ""
        };
        format!(
            "{lead}{}{}: {}",
            on_joints(closed, &finding.effect, &finding.joints),
            of_kind(finding),
            values.collect::<Vec<_>>().join(", ")
        )
    }));
    items.extend(fall(closed));
    items.extend(doubts(closed));
    if !items.is_empty() {
        page.list(&items);
    }
}

/// By what, whether that is all, and whether others do as well: `Explained: stribeck on elbow, with 1 alternative`.
fn explained(closed: &Loop) -> String {
    let verdict = &closed.verdict;
    let faults = closed.faults.iter().map(|fault| fault.kind.to_owned());
    let effects = verdict.findings.iter();
    let effects = effects.map(|finding| on_joints(closed, &finding.effect, &finding.joints));
    let names: Vec<String> = faults.chain(effects).collect();
    let by = if names.len() > MOST_NAMED {
        format!("{} effects", names.len())
    } else {
        names.join(", ")
    };
    let with = match undistinguished(&verdict.alternatives) {
        0 => String::new(),
        1 => ", with 1 alternative".to_owned(),
        others => format!(", with {others} alternatives"),
    };
    format!("Explained{}: {by}{with}", in_part(closed))
}

/// What the logs leave open.
pub(super) fn open_questions(page: &mut Page, spec: &str, text: &str, closed: &Loop) {
    let verdict = &closed.verdict;
    if verdict.outcome == Outcome::Explained && !verdict.alternatives.is_empty() {
        page.part("Effects that do nearly as well on these logs");
        page.text("Of effects that lower the error equally, the simplest is named.");
        let open = apart(spec, text, closed);
        let ends = |line: &str| line.contains(COMMAND);
        let is_one = open.lines().filter(|line| ends(line)).count() == 1;
        let (mut lines, mut commands) = (Vec::new(), Vec::new());
        for line in open.lines().map(str::trim) {
            match line.split_once(COMMAND) {
                Some((what, command)) if is_one => {
                    lines.push(format!("{what}, by the command below"));
                    commands.push(format!("robot-model {command}"));
                }
                Some((what, command)) => {
                    let number = commands.len() + 1;
                    lines.push(format!("{what} (command {number} below)"));
                    commands.push(format!("robot-model {command}    # {number}"));
                }
                None => lines.push(line.to_owned()),
            }
        }
        page.list(&lines);
        if !commands.is_empty() {
            page.commands(&commands.join("\n"));
        }
    }
    let left = structure_left(closed).into_iter();
    let left: Vec<String> = left.map(|said| said.join("; ")).collect();
    if !left.is_empty() {
        page.part("Where the remaining structure is");
        page.list(&left);
    }
}
