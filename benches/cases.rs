//! `cargo bench --bench cases -- FOLDER`: cases with keys, each traced from its URDF and logs as a user would, and judged by its key.
//!
//! A folder has a folder for each case: `robot.urdf`, `robot.json` with what is known of the arm, `identify.csv.gz`, `validate.csv.gz` and
//! `key.json`. One case after the other, so that times are those of a whole machine.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;

use clap::Parser;
use robot_model::log::Log;
use robot_model_benches::ended;
use robot_model_cli::close_the_loop::{Progress, close};
use robot_model_tests::cases::{self, Case};
use serde_json::json;

/// Trace cases and judge them by their keys.
#[derive(Debug, Parser)]
#[command(name = "cases", bin_name = "cargo bench --bench cases --")]
struct Options {
    /// The folder of the cases.
    folder: PathBuf,
    /// Cases, by name; all without it.
    #[arg(long, value_delimiter = ',', value_name = "NAME,..")]
    only: Vec<String>,
    /// Write an answer for each case into this folder, as a scorer reads it.
    #[arg(long, value_name = "FOLDER")]
    answers: Option<PathBuf>,
    /// What cargo says to every benchmark.
    #[arg(long, hide = true)]
    bench: bool,
}

/// What was said of a case.
struct Answer {
    outcome: &'static str,
    /// Kinds with joints from 1.
    said: Vec<(String, Vec<usize>)>,
    is_met: bool,
    /// Error on the log to judge on over the least that it can be, where something is missing that has a name.
    over_achievable: Option<f64>,
    seconds: f64,
}

fn main() -> ExitCode {
    ended(run(&Options::parse()))
}

fn run(options: &Options) -> Result<(), String> {
    let mut cases = cases::all(&options.folder);
    cases.retain(|case| options.only.is_empty() || options.only.contains(&case.name));
    if cases.is_empty() {
        let folder = options.folder.display();
        return Err(format!("no case with a key in `{folder}`"));
    }
    if let Some(folder) = &options.answers {
        std::fs::create_dir_all(folder).map_err(|error| cannot("make", folder, &error))?;
    }
    let mut answers = Vec::new();
    for case in &cases {
        let answer = answered(case, options.answers.as_deref())?;
        print(&line(case, &answer))?;
        answers.push(answer);
    }
    print(&summary(&cases, &answers))
}

fn print(text: &str) -> Result<(), String> {
    writeln!(std::io::stdout(), "{text}").map_err(|error| error.to_string())
}

/// Closes the loop on a case; reading logs counts as its time, too.
fn answered(case: &Case, folder: Option<&Path>) -> Result<Answer, String> {
    let start = Instant::now();
    let said = |error: &dyn std::fmt::Display| format!("{}: {error}", case.name);
    let read = |path: &Path| Log::read(path, case.dof).map_err(|error| said(&error));
    let (identify, validate) = (read(&case.identify)?, read(&case.validate)?);
    let name = format!("{}.robot", case.name);
    let progress = Progress::silent();
    let closed = close(&name, &case.spec, &[identify], Some(&validate), &progress)
        .map_err(|error| said(&error))?;
    let seconds = start.elapsed().as_secs_f64();
    let named = cases::named(&closed);
    let outcome = closed.outcome().name();
    let errors = [&closed.before, closed.after()].map(|stage| {
        let errors = stage.validation.as_ref();
        errors.map_or_else(Vec::new, |errors| errors.rmse.clone())
    });
    if let Some(folder) = folder {
        let effects = named.iter().map(|(kind, joints)| match joints[..] {
            [] => json!({ "kind": kind, "joint": null }),
            [joint] => json!({ "kind": kind, "joint": joint }),
            _ => json!({ "kind": kind, "joints": joints }),
        });
        let answer = json!({
            "case": case.name,
            "outcome": outcome,
            "effects": effects.collect::<Vec<_>>(),
            "rmse_before": errors[0],
            "rmse_after": errors[1],
            "domain": "raw",
        });
        let path = folder.join(format!("{}.json", case.name));
        std::fs::write(&path, format!("{answer:#}\n"))
            .map_err(|error| cannot("write", &path, &error))?;
    }
    let is_explained = case.key.expected_outcome == "explained";
    Ok(Answer {
        outcome,
        is_met: case.key.is_met(outcome, &named),
        over_achievable: is_explained.then(|| case.key.over_achievable(&errors[1])),
        said: named,
        seconds,
    })
}

fn line(case: &Case, answer: &Answer) -> String {
    let wanted = case.key.effects.iter().map(|effect| &effect.kind[..]);
    let wanted: Vec<&str> = wanted.collect();
    let said = answer.said.iter().map(|(kind, joints)| {
        let joints: Vec<String> = joints.iter().map(ToString::to_string).collect();
        format!("{kind}@{}", joints.join("+"))
    });
    let said: Vec<String> = said.collect();
    let mark = if answer.is_met { "as its key" } else { "NOT" };
    let over = answer.over_achievable;
    let over = over.map_or_else(String::new, |over| {
        format!(", after over achievable {over:.2}")
    });
    format!(
        "{} {mark}: {} {} for {} {}{over}, {:.0} s",
        case.name,
        answer.outcome,
        said.join(", "),
        case.key.expected_outcome,
        wanted.join(", "),
        answer.seconds
    )
}

/// Shares of each outcome that came out as keys say, errors and times.
fn summary(cases: &[Case], answers: &[Answer]) -> String {
    let shares = ["explained", "nothing-missing", "unexplained"].map(|wanted| {
        let pairs = cases.iter().zip(answers);
        let of: Vec<bool> = pairs
            .filter(|(case, _)| case.key.expected_outcome == wanted)
            .map(|(_, answer)| answer.is_met)
            .collect();
        let met = of.iter().filter(|is_met| **is_met).count();
        format!("{wanted}: {met} of {} as their keys", of.len())
    });
    let mut over: Vec<f64> = answers
        .iter()
        .filter_map(|one| one.over_achievable)
        .collect();
    over.sort_by(f64::total_cmp);
    let middle = [over.len().saturating_sub(1) / 2, over.len() / 2];
    let median = over.get(middle[0]).zip(over.get(middle[1]));
    let median = median.map(|(low, high)| 0.5 * (low + high));
    let median = median.map_or_else(String::new, |median| {
        format!("; error after over the achievable one: {median:.2} in the median")
    });
    let longest = answers.iter().map(|one| one.seconds).fold(0.0, f64::max);
    format!("{}{median}; at most {longest:.0} s", shares.join("; "))
}

fn cannot(what: &str, path: &Path, error: &dyn std::fmt::Display) -> String {
    format!("cannot {what} `{}`: {error}", path.display())
}
