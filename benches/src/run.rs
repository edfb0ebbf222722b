//! The command: arms, programs, rounds, rows.

use std::io::Write as _;
use std::path::Path;
use std::process::ExitCode;

use clap::Parser as _;

use crate::arm::{Arm, FUNCTIONS, workspace};
use crate::options::Options;
use crate::ours::{self, case};
use crate::out_file::OutFile;
use crate::peers::{self, Contender};
use crate::program::Program;
use crate::report::{Generation, Report};
use crate::rounds::{self, Case};
use crate::rows::{OURS_ARE, rows_of};
use crate::table::table;
use crate::{Error, docs, failed, generation, machine, ours_c};

/// States at which all programs must agree.
const COMPARED: usize = 50;

/// How far: products are formed in other orders, by some with contracted products.
const AGREEMENT: f64 = 1e-9;

/// Forms of a program of ours.
const OURS: [&str; 4] = ["baked", "runtime", "lanes4", "lanes8"];

/// Reads the command line, measures, and writes table and rows. Programs are built in `folder`.
#[must_use]
pub fn run(folder: &Path) -> ExitCode {
    match bench(&Options::parse(), folder) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            say(&format!("error: {error}"));
            ExitCode::FAILURE
        }
    }
}

fn say(line: &str) {
    let _ = writeln!(std::io::stderr().lock(), "{line}");
}

fn bench(options: &Options, folder: &Path) -> Result<(), Error> {
    // Before the work: whether its result can be written.
    let target = options.target();
    let target = target.as_deref().map(OutFile::claim).transpose()?;
    let page = options
        .docs
        .then(|| OutFile::claim(&workspace().join("docs/benchmarks.md")));
    let page = page.transpose()?;
    std::fs::create_dir_all(folder).map_err(|error| failed("make", folder, error))?;
    say("deriving the arms ..");
    let arms = options.arms().into_iter().map(Arm::read);
    let arms = arms.collect::<Result<Vec<Arm>, Error>>()?;
    say("building our functions, plain and for this machine ..");
    let ours = ours::build(folder, &arms)?;
    let mut rows = Vec::new();
    let mut missing = Vec::new();
    for arm in &arms {
        let mut contenders: Vec<Contender> = Vec::new();
        let mut tell = |line: String| {
            // Once, and not for each arm.
            if !missing.contains(&line) {
                missing.push(line);
            }
        };
        say(&format!("building our C for {} ..", arm.name));
        match ours_c::contenders(folder, arm) {
            Ok(found) => contenders.extend(found),
            Err(why) => tell(format!("our C is not measured: {why}")),
        }
        for peer in options.peers.iter().filter(|peer| *peer != "none") {
            say(&format!("building {peer} for {} ..", arm.name));
            match peers::contenders(peer, folder, arm) {
                Ok(found) => contenders.extend(found),
                Err(why) => tell(format!("{peer} is not measured: {why}")),
            }
        }
        let states = rounds::write_states(folder, arm.dof())?;
        let own = ours.iter().map(|folder| folder.join(arm.name));
        let others = contenders
            .iter()
            .map(|contender| contender.executable.clone());
        let programs = own
            .chain(others)
            .map(|program| Program::start(&program, &states));
        let mut programs = programs.collect::<Result<Vec<Program>, Error>>()?;
        let cases = agreed(arm, &mut programs, &contenders, &mut missing)?;
        say(&format!("timing {} ..", arm.name));
        let times = rounds::measure(&mut programs, &cases, options.passes)?;
        rows.extend(rows_of(arm, &contenders, &times)?);
    }
    let (mut generation, mut growth) = (Vec::new(), Vec::new());
    if options.growth || options.docs {
        say("compiling, and having rustc compile ..");
        let arms = arms.iter().map(|arm| generation::of_arm(folder, arm.name));
        generation = arms.collect::<Result<Vec<Generation>, Error>>()?;
        say("compiling chains ..");
        growth = generation::growth()?;
    }
    let run = machine::run(options.passes);
    let report = Report {
        rows,
        run,
        generation,
        growth,
    };
    let mut out = std::io::stdout().lock();
    // A reader that has gone away has read what it wanted.
    let _ = out.write_all(table(&report).as_bytes());
    for line in missing {
        say(&line);
    }
    if let Some(target) = target {
        let mut text = serde_json::to_string_pretty(&report).expect("rows are names and numbers");
        text.push('\n');
        say(&format!("wrote {}", target.commit(&text)?.display()));
    }
    if let Some(page) = page {
        // As it is by now: somebody may have written in it while this measured.
        let text = page.current()?;
        let path = page.commit(&docs::renewed(&text, &report)?)?;
        say(&format!("wrote {}", path.display()));
    }
    Ok(())
}

/// Every case whose values are those of our baked function; what a peer computes otherwise is told, what it does not compute is
/// not its affair.
fn agreed(
    arm: &Arm,
    programs: &mut [Program],
    contenders: &[Contender],
    told: &mut Vec<String>,
) -> Result<Vec<Case>, Error> {
    let mut cases = Vec::new();
    for function in FUNCTIONS {
        let first = case(function, "baked", false);
        let wanted = programs[0].values(&first, COMPARED)?.ok_or_else(|| {
            Error::new(format!(
                "our program of {} has no `{first}` to compare with",
                arm.name
            ))
        })?;
        for case in cases_of(function, programs.len()) {
            let Some(found) = programs[case.program].values(&case.name, COMPARED)? else {
                continue;
            };
            let difference = rounds::difference(&found, &wanted);
            if difference <= AGREEMENT {
                cases.push(case);
                continue;
            }
            let what = format!(
                "{} of {} differs from {first} by {difference:e}",
                case.name, arm.name
            );
            match case.program.checked_sub(OURS_ARE) {
                Some(k) if contenders[k].ours.is_none() => {
                    told.push(format!("{}'s {what}: not timed", contenders[k].name));
                }
                _ => return Err(Error::new(what)),
            }
        }
    }
    Ok(cases)
}

/// Cases of a function that are asked for.
fn cases_of(function: &str, programs: usize) -> Vec<Case> {
    let mut cases = Vec::new();
    for given in [false, true] {
        for program in 0..programs {
            let names: Vec<String> = if program < OURS_ARE {
                OURS.map(|form| case(function, form, given)).to_vec()
            } else {
                let ways = 0..peers::WAYS;
                ways.map(|way| peers::case(function, way, given)).collect()
            };
            cases.extend(names.into_iter().map(|name| Case { program, name }));
        }
    }
    cases
}
