//! The robot-model command line.
//!
//! One file a verb; each reads its inputs, calls the libraries once, and writes its results. Results go to standard output
//! or to files, messages and progress to standard error. Exit codes: 0 done, 1 the input is at fault, 2 usage, 130 Ctrl-C.

pub mod audit;
mod calibrate;
mod check;
pub mod close_the_loop;
mod completions;
mod data_checks;
mod data_gate;
mod demo;
mod diff;
mod dissect;
mod emit;

mod error;
mod eval;
mod excite;
mod export;
mod friction;
mod hinted;
mod identify;
mod import;
mod in_order;
mod interrupt;
mod json;
mod log_settings;
mod manual;
mod merge;
mod misplaced;
mod new;

pub mod interpreted;
mod output;
mod parameters;
mod progress;
mod report;
mod rounds;
mod show;
mod simulate;
mod snippet;
mod spec;
mod trace;
mod units;

use std::ffi::OsString;
use std::io::IsTerminal;
use std::process::ExitCode;

use clap::{Parser, Subcommand};

pub use error::Error;

/// Robot arms from one spec: equations, code, identification, and tracing of missing effects.
#[derive(Debug, Parser)]
#[command(
    name = "robot-model",
    version,
    max_term_width = 100,
    after_help = "Examples:
  robot-model new Picker --joints 6
  robot-model check picker.robot
  robot-model identify picker.robot monday.csv --validate tuesday.csv
  robot-model trace picker.robot monday.csv --validate tuesday.csv --amend picker2.robot --report page"
)]
struct CommandLine {
    #[command(subcommand)]
    verb: Verb,
}

#[derive(Debug, Subcommand)]
enum Verb {
    New(new::New),
    Import(import::Import),
    Export(export::Export),
    Check(check::Check),
    Show(show::Show),
    Emit(emit::Emit),
    Eval(eval::Eval),
    Excite(excite::Excite),
    Simulate(simulate::Simulate),
    Identify(identify::IdentifyArguments),
    Merge(merge::Merge),
    Friction(friction::Friction),
    Trace(trace::TraceArguments),
    Dissect(dissect::Dissect),
    Audit(audit::Audit),
    Calibrate(calibrate::Calibrate),
    Demo(demo::Demo),
    Completions(completions::Completions),
    Man(manual::Man),
}

impl Verb {
    fn run(&self) -> Result<(), Error> {
        match self {
            Self::New(verb) => verb.run(),
            Self::Import(verb) => verb.run(),
            Self::Export(verb) => verb.run(),
            Self::Check(verb) => verb.run(),
            Self::Show(verb) => verb.run(),
            Self::Emit(verb) => verb.run(),
            Self::Eval(verb) => verb.run(),
            Self::Excite(verb) => verb.run(),
            Self::Simulate(verb) => verb.run(),
            Self::Identify(verb) => verb.run(),
            Self::Merge(verb) => verb.run(),
            Self::Friction(verb) => verb.run(),
            Self::Trace(verb) => verb.run(),
            Self::Dissect(verb) => verb.run(),
            Self::Audit(verb) => verb.run(),
            Self::Calibrate(verb) => verb.run(),
            Self::Demo(verb) => verb.run(),
            Self::Completions(verb) => verb.run(),
            Self::Man(verb) => verb.run(),
        }
    }
}

/// The program: arguments of the process in, exit code out.
#[must_use]
pub fn main() -> ExitCode {
    keep_decoders_quiet();
    interrupt::heed();
    run(std::env::args_os())
}

/// The decoders of Parquet and MCAP panic at some damaged files; the reader of logs makes errors of these panics, and nobody
/// wants to see them besides.
fn keep_decoders_quiet() {
    let others = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |info| {
        let is_decoder = |place: &std::panic::Location| {
            let mut crates = ["/parquet-", "/mcap-"].iter();
            crates.any(|name| place.file().contains(name))
        };
        if !info.location().is_some_and(is_decoder) {
            others(info);
        }
    }));
}

/// Runs one command. The first argument is the program's name.
#[must_use]
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> ExitCode {
    let line = match CommandLine::try_parse_from(arguments) {
        Ok(line) => line,
        Err(error) => {
            // Nothing is left to say where the terminal is gone.
            let _ = error.print();
            return ExitCode::from(u8::try_from(error.exit_code()).unwrap_or(2));
        }
    };
    match line.verb.run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            output::say(&error.render(std::io::stderr().is_terminal()));
            ExitCode::FAILURE
        }
    }
}

#[cfg(test)]
mod help;
