//! `cargo bench --bench removed -- SPEC LOG.. --validate LOG`: each effect that a spec declares is removed in turn, and traced.
//!
//! What a trace would have found of one's own arm, on one's own logs, had it not been declared.

use std::fmt::Display;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Parser;
use robot_model::log::Log;
use robot_model_benches::ended;
use robot_model_cli::close_the_loop::{Loop, Progress, Stage, close};
use robot_model_spec::amend::remove;
use robot_model_spec::{Model, load};

/// Remove each declared effect in turn, and trace.
#[derive(Debug, Parser)]
#[command(name = "removed", bin_name = "cargo bench --bench removed --")]
struct Options {
    /// The spec with all of its effects.
    spec: PathBuf,
    /// Logs to fit.
    #[arg(required = true)]
    logs: Vec<PathBuf>,
    /// The log to judge on.
    #[arg(long, value_name = "LOG")]
    validate: PathBuf,
    /// Effects to remove, by name; all without it.
    #[arg(long, value_delimiter = ',', value_name = "EFFECT,..")]
    only: Vec<String>,
    /// What cargo says to every benchmark.
    #[arg(long, hide = true)]
    bench: bool,
}

fn main() -> ExitCode {
    ended(run(&Options::parse()))
}

fn run(options: &Options) -> Result<(), String> {
    let name = options.spec.display().to_string();
    let text = std::fs::read_to_string(&options.spec).map_err(|error| at(&options.spec, &error))?;
    let model = load(&name, &text).map_err(|error| error.to_string())?;
    let read =
        |path: &PathBuf| Log::read(path, model.joints.len()).map_err(|error| at(path, &error));
    let logs = options.logs.iter().map(read);
    let logs = logs.collect::<Result<Vec<Log>, String>>()?;
    let validate = read(&options.validate)?;
    let traced = |text: &str| {
        let closed = close(&name, text, &logs, Some(&validate), &Progress::silent());
        closed.map_err(|error| error.to_string())
    };
    print(&format!(
        "nothing removed: {}",
        named(&model, &traced(&text)?)
    ))?;
    for (number, effect) in model.effects.iter().enumerate() {
        let effect_name = &effect.definition.name;
        if !options.only.is_empty() && !options.only.contains(effect_name) {
            continue;
        }
        let without = remove(&name, &text, number).map_err(|error| error.to_string())?;
        let closed = traced(&without)?;
        print(&format!(
            "{effect_name}{} removed: {}; relative error on the validation log {}",
            on(&model, &effect.joints),
            named(&model, &closed),
            errors(&model, &closed, &effect.joints),
        ))?;
    }
    Ok(())
}

/// The outcome, with what is named.
fn named(model: &Model, closed: &Loop) -> String {
    let faults = closed.faults.iter().map(|fault| fault.kind.to_owned());
    let findings = closed.verdict.findings.iter();
    let findings = findings.map(|one| format!("{}{}", one.kind, on(model, &one.joints)));
    let all: Vec<String> = faults.chain(findings).collect();
    format!("{} {}", closed.outcome().name(), all.join(", "))
        .trim_end()
        .to_owned()
}

/// Before and after on joints of what was removed; on all for what acts on the arm as a whole.
fn errors(model: &Model, closed: &Loop, joints: &[usize]) -> String {
    let all: Vec<usize> = (0..model.joints.len()).collect();
    let joints = if joints.is_empty() { &all } else { joints };
    let of = |stage: &Stage, joint: usize| {
        let errors = stage.validation.as_ref();
        errors.map_or(f64::NAN, |errors| errors.relative_percent[joint])
    };
    let told = joints.iter().map(|&joint| {
        let (before, after) = (of(&closed.before, joint), of(closed.after(), joint));
        format!(
            "of {} {before:.1} % before, {after:.1} % after",
            model.joints[joint].name
        )
    });
    told.collect::<Vec<_>>().join(", ")
}

fn on(model: &Model, joints: &[usize]) -> String {
    let names: Vec<&str> = joints.iter().map(|&j| &model.joints[j].name[..]).collect();
    match names[..] {
        [] => String::new(),
        [one] => format!(" on {one}"),
        _ => format!(" on ({})", names.join(", ")),
    }
}

fn print(text: &str) -> Result<(), String> {
    writeln!(std::io::stdout(), "{text}").map_err(|error| error.to_string())
}

fn at(path: &Path, error: &dyn Display) -> String {
    format!("`{}`: {error}", path.display())
}
