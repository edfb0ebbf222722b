//! `cargo bench --bench tracing`: every effect of the library is put into simulated arms, in three sizes, and traced.
//!
//! An arm moves in closed loop, with an encoder's steps and colored noise; its spec does not declare what is in it. The share of right
//! names, of silence and of wrong names is told for every effect and size, beside that of baselines on the same logs. Seeds from 100 on are
//! looked at while the tracer is built, those below are for figures alone.

mod arms;
mod baselines;
mod catalogue;
mod columns;
mod comparison;
mod draw;
mod experiment;
mod figures;
mod judge;
mod keep;
mod motion;
mod noise;
mod rows;
mod size;
mod table;

use std::collections::BTreeSet;
use std::fmt::Display;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::atomic::{AtomicUsize, Ordering};

use clap::{ArgAction, Parser};
use robot_model_benches::ended;

use arms::ARMS;
use catalogue::{ALL, Injection, Place};
use experiment::Case;
use judge::Row;
use rows::{Rows, read};

/// Put effects into simulated arms, and trace them.
#[derive(Debug, Parser)]
#[command(name = "tracing", bin_name = "cargo bench --bench tracing --")]
struct Options {
    /// Seeds of motion, joint and noise.
    #[arg(long, value_delimiter = ',', value_name = "N,..", default_values_t = [1, 2])]
    seeds: Vec<u64>,
    /// Root mean square of what an effect adds, percent of the torque of its joint.
    #[arg(long, value_delimiter = ',', value_name = "PERCENT,..", default_values_t = [1.0, 3.0, 10.0])]
    sizes: Vec<f64>,
    /// Arms, by name.
    #[arg(long, value_delimiter = ',', value_name = "NAME,..")]
    arms: Vec<String>,
    /// What is put in, by name.
    #[arg(long, value_delimiter = ',', value_name = "EFFECT,..")]
    kinds: Vec<String>,
    /// Experiments at a time.
    #[arg(long, default_value_t = 2)]
    jobs: usize,
    /// Ask LASSO, sequential thresholding and forward selection, by F tests and by blocks, about the same logs.
    #[arg(long, value_name = "BOOL", default_value_t = true, action = ArgAction::Set)]
    baselines: bool,
    /// Run nothing, but take the rows that earlier runs wrote with `--json`.
    #[arg(
        long,
        value_delimiter = ',',
        value_name = "FILE,..",
        conflicts_with_all = ["seeds", "sizes", "arms", "kinds", "jobs", "keep", "baselines"]
    )]
    from: Vec<PathBuf>,
    /// Draw detection over sizes, and the methods beside each other, as SVG files of a folder there.
    #[arg(long, value_name = "FOLDER")]
    figures: Option<PathBuf>,
    /// Write every experiment's row there, as JSON, as soon as it is done; experiments whose rows are there already are not run again: remove
    /// the file for another version of the tracer.
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Keep specs and logs of every experiment in a folder there, to look at with `robot-model trace`.
    #[arg(long, value_name = "FOLDER")]
    keep: Option<PathBuf>,
    /// What cargo says to every benchmark.
    #[arg(long, hide = true)]
    bench: bool,
}

impl Options {
    /// # Errors
    /// An arm or an effect that nobody knows.
    fn cases(&self) -> Result<Vec<Case>, String> {
        let arms: BTreeSet<String> = ARMS.iter().map(|arm| arm.name.to_owned()).collect();
        let effects: BTreeSet<String> = ALL.iter().map(Injection::effect).collect();
        for (names, known) in [(&self.arms, arms), (&self.kinds, effects)] {
            if let Some(name) = names.iter().find(|name| !known.contains(*name)) {
                let known: Vec<String> = known.into_iter().collect();
                return Err(format!("no `{name}`; there are {}", known.join(", ")));
            }
        }
        let wanted =
            |names: &[String], name: &str| names.is_empty() || names.iter().any(|one| one == name);
        let mut cases = Vec::new();
        for arm in ARMS.iter().filter(|arm| wanted(&self.arms, arm.name)) {
            for injection in ALL.iter().filter(|one| wanted(&self.kinds, &one.effect())) {
                for percent in &self.sizes {
                    cases.extend(self.seeds.iter().map(|seed| Case {
                        arm,
                        injection,
                        share: percent / 100.0,
                        seed: *seed,
                    }));
                }
            }
        }
        Ok(cases)
    }
}

fn main() -> ExitCode {
    let options = Options::parse();
    let done = if options.from.is_empty() {
        run(&options)
    } else {
        // Rows of earlier runs, one run after the other.
        let runs: Result<Vec<_>, _> = options.from.iter().map(|path| read(path)).collect();
        runs.map(|runs| (runs.concat(), 0))
    };
    ended(done.and_then(|(rows, failed)| {
        tell(&options, &rows)?;
        match failed {
            0 => Ok(()),
            _ => Err(format!(
                "{failed} experiments failed, see above, and are in no table"
            )),
        }
    }))
}

/// Tables to standard output; figures where they are wanted.
fn tell(options: &Options, rows: &[Row]) -> Result<(), String> {
    let write = |path: &Path, text: &str| {
        std::fs::write(path, text).map_err(|error| cannot("write", path, &error))
    };
    if let Some(folder) = &options.figures {
        std::fs::create_dir_all(folder).map_err(|error| cannot("make", folder, &error))?;
        write(&folder.join("detection.svg"), &figures::detection(rows))?;
        if let Some(picture) = figures::comparison(rows) {
            write(&folder.join("methods.svg"), &picture)?;
        }
    }
    let (own, compared) = (table::table(rows), comparison::table(rows));
    write!(std::io::stdout(), "{own}{compared}").map_err(|error| error.to_string())
}

fn cannot(what: &str, path: &Path, error: &dyn Display) -> String {
    format!("cannot {what} `{}`: {error}", path.display())
}

/// All experiments, in order, and how many failed.
fn run(options: &Options) -> Result<(Vec<Row>, usize), String> {
    let cases = options.cases()?;
    let rows = Rows::of(options.json.as_deref())?;
    let [next, failed] = [AtomicUsize::new(0), AtomicUsize::new(0)];
    let mine = || {
        let number = next.fetch_add(1, Ordering::Relaxed);
        cases.get(number).map(|case| (number + 1, case))
    };
    let work = || {
        while let Some((number, case)) = mine() {
            let label = format!(
                "{} {} {} % seed {}",
                case.arm.name,
                case.injection.effect(),
                100.0 * case.share,
                case.seed
            );
            let is_enough = |row: &Row| {
                let is_fault = case.injection.place == Place::Log;
                !options.baselines || is_fault || !row.baselines.is_empty()
            };
            let row = match rows.row(case).filter(is_enough) {
                Some(row) => Ok(Some(row)),
                None => judged(options, case, &format!("{number:03} {label}")).and_then(|row| {
                    row.iter()
                        .cloned()
                        .try_for_each(|row| rows.put(case, row))?;
                    Ok(row)
                }),
            };
            let text = match row {
                Ok(Some(row)) => told(&row),
                Ok(None) => "not there in this size".to_owned(),
                Err(error) => {
                    failed.fetch_add(1, Ordering::Relaxed);
                    format!("failed: {error}")
                }
            };
            let of = cases.len();
            let _ = writeln!(std::io::stderr(), "[{number}/{of}] {label}: {text}");
        }
    };
    std::thread::scope(|scope| {
        for _ in 0..options.jobs.max(1) {
            scope.spawn(work);
        }
    });
    let rows = cases.iter().filter_map(|case| rows.row(case)).collect();
    Ok((rows, failed.into_inner()))
}

/// One experiment, kept under its name where that is wanted.
fn judged(options: &Options, case: &Case, name: &str) -> Result<Option<Row>, String> {
    let Some(experiment) = case.run()? else {
        return Ok(None);
    };
    if let Some(folder) = &options.keep {
        let name = name.replace(" % seed ", "_").replace(' ', "_");
        let kept = experiment.keep(&folder.join(name));
        kept.map_err(|error| error.to_string())?;
    }
    judge::judge(case, &experiment, options.baselines).map(Some)
}

/// A row for people who wait.
fn told(row: &Row) -> String {
    let own = format!(
        "{:?}: {} {:?} of joints {:?}, {} ({:.1} s)",
        row.mark,
        row.outcome,
        row.said,
        row.joints,
        if row.is_material { "matters" } else { "small" },
        row.seconds
    );
    let others = row.baselines.iter().map(|answer| {
        format!(
            "\n    {}: {:?} {:?} ({:.1} s)",
            answer.method, answer.mark, answer.said, answer.seconds
        )
    });
    std::iter::once(own).chain(others).collect()
}
