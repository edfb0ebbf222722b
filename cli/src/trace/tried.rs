//! What was tried in the rounds of a trace, and why it is not named, for people.

use std::fmt::Write;

use robot_model::trace::{Finding, Refusal, Tried};

use super::doubt::on_joints;
use crate::close_the_loop::{DataFault, Loop};

/// Rows of a round.
const MOST: usize = 5;

/// Scores beyond this are told by their power of ten.
const MOST_SCORE: f64 = 1e6;

const HEAD: &str = "Candidates that are significant or take a fifth off both errors, best first in each round; `held-out` and `raw`: largest \
     fall of a joint's error on folds not fitted and on raw samples";

const PUT: &str = "a string takes all";

/// Round, effect, score, fall of the errors and outcome of so many a round that count.
pub(super) fn rows(
    closed: &Loop,
    most: usize,
    counts: &dyn Fn(&Tried) -> bool,
) -> Vec<[String; 6]> {
    let all = &closed.verdict.tried;
    let rounds = all.iter().map(|one| one.round + 1).max().unwrap_or(0);
    let of_round = |round: usize| {
        let of_round = all.iter().filter(move |one| one.round == round);
        of_round.filter(|one| counts(one)).take(most)
    };
    let told = (0..rounds).flat_map(of_round);
    told.map(|one| row(closed, one)).collect()
}

/// A table of what explained more than chance or takes much off, round by round; nothing where none did.
pub(super) fn tried(closed: &Loop) -> String {
    let mut rows = rows(closed, MOST, &|one| {
        one.takes_much() || !one.refusals.contains(&Refusal::Chance)
    });
    if rows.is_empty() {
        return String::new();
    }
    let head = ["round", "effect", "score", "held-out", "raw", "outcome"].map(str::to_owned);
    rows.insert(0, head);
    let width = |column: usize| rows.iter().map(|row| row[column].len()).max().unwrap_or(0);
    let widths = [0, 1, 2, 3, 4].map(width);
    let mut out = format!("\n{HEAD}:\n");
    for [round, effect, score, held_out, raw, end] in &rows {
        let [of_round, of_effect, of_score, of_held_out, of_raw] = widths;
        let line = format!(
            "{round:of_round$}   {effect:of_effect$}   {score:>of_score$}   {held_out:>of_held_out$}   {raw:>of_raw$}   {end}"
        );
        writeln!(out, "{}", line.trim_end()).expect(PUT);
    }
    out
}

fn row(closed: &Loop, one: &Tried) -> [String; 6] {
    let best = |percents: &[f64]| {
        let best = percents.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        // What is many times as large, as errors of another part of the log can be, is no number to compare.
        if best <= -100.0 {
            return "worse".to_owned();
        }
        // No zero has a sign.
        format!("{:.1} %", (10.0 * best).round() / 10.0 + 0.0)
    };
    let score = one.evidence.score;
    let reasons: Vec<String> = one.refusals.iter().map(ToString::to_string).collect();
    let end = if reasons.is_empty() {
        passed(closed, one).to_owned()
    } else {
        reasons.join(", ")
    };
    let is_found = |fault: &DataFault| {
        fault.kind == one.kind && (fault.joints.is_empty() || fault.joints == one.joints)
    };
    let end = if closed.faults.iter().any(is_found) {
        format!("found by the data gate and removed from the logs; remainder: {end}")
    } else {
        end
    };
    [
        (one.round + 1).to_string(),
        on_joints(closed, &one.effect, &one.joints),
        if score < MOST_SCORE {
            format!("{score:.1}")
        } else {
            format!("{score:.0e}")
        },
        best(&one.evidence.held_out_percent),
        best(&one.evidence.raw_percent),
        end,
    ]
}

/// What became of an effect that passes every gate.
fn passed(closed: &Loop, one: &Tried) -> &'static str {
    let verdict = &closed.verdict;
    let is_one = |effect: &str, joints: &[usize]| (effect, joints) == (&one.effect, &one.joints);
    // A second ripple has another period.
    let is_taken = |found: &[Finding]| {
        found.iter().any(|finding| {
            let shapes = finding.parameters.iter().filter(|found| found.shape);
            let shapes = shapes.map(|found| found.value);
            is_one(&finding.effect, &finding.joints) && shapes.eq(one.shapes.iter().copied())
        })
    };
    // What is without shapes passes in every round until it is taken.
    let passes_later = verdict.tried.iter().any(|other| {
        let is_same = is_one(&other.effect, &other.joints) && other.shapes == one.shapes;
        other.round > one.round && is_same && other.refusals.is_empty()
    });
    let mut rivals = verdict.alternatives.iter();
    if !passes_later && is_taken(&verdict.findings) {
        "named"
    } else if !passes_later && is_taken(&verdict.leads) {
        "a lead"
    } else if rivals.any(|rival| is_one(&rival.effect, &rival.joints)) {
        "an alternative"
    } else {
        "another effect lowers the error more"
    }
}
