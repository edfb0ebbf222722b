//! `cargo run --release -p robot-model-fuzz -- --seconds 1200`: damages specs until the time is up; exits with 1 after a
//! failure, whose text is saved in `--failures`.
#![expect(clippy::print_stdout, reason = "a program for people")]

use std::collections::BTreeSet;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::{Duration, Instant};

use clap::Parser;
use rand::{RngExt as _, SeedableRng as _};
use rand_chacha::ChaCha8Rng;
use robot_model_fuzz::answer::Answer;
use robot_model_fuzz::minimize::minimize;
use robot_model_fuzz::mutate::mutate;
use robot_model_fuzz::run::{Failure, watched};

/// Longer texts say nothing that shorter ones do not, and take the time of many.
const LONGEST: usize = 12_000;

/// Damages specs and gives them to the compiler.
#[derive(Debug, Parser)]
struct Arguments {
    /// How long.
    #[arg(long, default_value_t = 60)]
    seconds: u64,
    /// Same seed, same damage, as far as time allows.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Folders of specs to start from.
    #[arg(long, default_values_os_t = [PathBuf::from("fuzz/corpus"), "tests/specs/pass".into(), "tests/specs/run".into(), "tests/specs/fail".into(), "model-spec/effects".into()])]
    from: Vec<PathBuf>,
    /// Where texts with new answers are kept; without it they are forgotten at the end.
    #[arg(long)]
    keep: Option<PathBuf>,
    /// Where failures are saved.
    #[arg(long, default_value = "fuzz/failures")]
    failures: PathBuf,
    /// Longest time for one text.
    #[arg(long, default_value_t = 30)]
    limit_seconds: u64,
}

fn main() -> ExitCode {
    match fuzz(&Arguments::parse()) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            println!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn fuzz(arguments: &Arguments) -> io::Result<bool> {
    // Panics are reported once, at the end.
    std::panic::set_hook(Box::new(|_| {}));
    let limit = Duration::from_secs(arguments.limit_seconds);
    let mut pool = Pool::default();
    for folder in &arguments.from {
        for text in specs(folder)? {
            match watched(&text, limit) {
                Ok((answer, _)) => drop(pool.take(&answer, &text)),
                Err(failure) => {
                    println!("{}: {failure}", folder.display());
                    return Ok(false);
                }
            }
        }
    }
    fs::create_dir_all(&arguments.failures)?;
    let current = arguments.failures.join("current.robot");
    let mut dice = ChaCha8Rng::seed_from_u64(arguments.seed);
    let (start, mut count, mut emitted) = (Instant::now(), 0_u64, 0_u64);
    let mut slowest = (Duration::ZERO, String::new());
    let mut is_clean = true;
    while start.elapsed() < Duration::from_secs(arguments.seconds) {
        let text = mutate(pool.pick(&mut dice), pool.pick(&mut dice), &mut dice);
        if text.len() > LONGEST {
            continue;
        }
        // A stack overflow or an abort leaves its text here.
        fs::write(&current, &text)?;
        count += 1;
        match watched(&text, limit) {
            Ok((answer, time)) => {
                emitted += u64::from(matches!(answer, Answer::Emitted { .. }));
                if time > slowest.0 {
                    slowest = (time, text.clone());
                }
                if pool.take(&answer, &text)
                    && let Some(folder) = &arguments.keep
                {
                    fs::create_dir_all(folder)?;
                    fs::write(folder.join(format!("{:05}.robot", pool.answers())), &text)?;
                }
            }
            Err(failure) => {
                is_clean = false;
                let path = save(&arguments.failures, &text, &failure, limit)?;
                println!("{failure}\n  {}", path.display());
                if matches!(failure, Failure::Slow(_)) {
                    // Its thread still runs: the times of others would be wrong.
                    break;
                }
            }
        }
    }
    if count > 0 {
        fs::remove_file(&current)?;
    }
    fs::write(arguments.failures.join("slowest.robot"), &slowest.1)?;
    println!(
        "{count} texts in {:.0?}, {emitted} of them compiled, {} different answers; the slowest took {:.1?}",
        start.elapsed(),
        pool.answers(),
        slowest.0
    );
    Ok(is_clean)
}

/// Texts that are damaged further, and the answers seen.
#[derive(Default)]
struct Pool {
    sound: Vec<String>,
    refused: Vec<String>,
    messages: BTreeSet<String>,
    sizes: BTreeSet<Answer>,
}

impl Pool {
    /// Whether the answer has anything new; then the text is kept.
    fn take(&mut self, answer: &Answer, text: &str) -> bool {
        match answer {
            Answer::Refused(messages) => {
                let before = self.messages.len();
                self.messages.extend(messages.iter().cloned());
                let is_new = self.messages.len() > before;
                if is_new {
                    self.refused.push(text.to_owned());
                }
                is_new
            }
            Answer::Emitted { .. } | Answer::Uncertain { .. } => {
                let is_new = self.sizes.insert(answer.clone());
                if is_new {
                    self.sound.push(text.to_owned());
                }
                is_new
            }
        }
    }

    fn answers(&self) -> usize {
        self.messages.len() + self.sizes.len()
    }

    /// Mostly a text that compiles: what is behind the checks is reached by few others.
    fn pick(&self, dice: &mut ChaCha8Rng) -> &str {
        let texts =
            if self.refused.is_empty() || (!self.sound.is_empty() && dice.random_range(0..8) > 0) {
                &self.sound
            } else {
                &self.refused
            };
        texts
            .get(dice.random_range(0..texts.len().max(1)))
            .map_or("", String::as_str)
    }
}

fn specs(folder: &Path) -> io::Result<Vec<String>> {
    let mut paths: Vec<PathBuf> = fs::read_dir(folder)?
        .map(|entry| entry.map(|entry| entry.path()))
        .collect::<io::Result<_>>()?;
    paths.retain(|path| {
        path.extension()
            .is_some_and(|extension| extension == "robot")
    });
    paths.sort();
    paths.iter().map(fs::read_to_string).collect()
}

/// Saves the text, made as small as it gets without losing the failure.
fn save(folder: &Path, text: &str, failure: &Failure, limit: Duration) -> io::Result<PathBuf> {
    let smallest = match failure {
        Failure::Panic(wanted) => minimize(
            text,
            &|candidate| matches!(watched(candidate, limit), Err(Failure::Panic(message)) if message == *wanted),
        ),
        Failure::Slow(_) => text.to_owned(),
    };
    let digest = smallest
        .bytes()
        .fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3)
        });
    let path = folder.join(format!("{digest:016x}.robot"));
    fs::write(&path, smallest)?;
    Ok(path)
}
