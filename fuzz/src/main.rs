//! `cargo run --release -p robot-model-fuzz -- --kind spec --seconds 1200`: damages files of a kind until the time is up; exits with 1
//! after a failure, whose file is saved in `--failures`.
#![expect(clippy::print_stdout, reason = "a program for people")]

use std::alloc::System;
use std::collections::BTreeSet;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::{Duration, Instant};

use cap::Cap;
use clap::Parser;
use rand::{RngExt as _, SeedableRng as _};
use rand_chacha::ChaCha8Rng;
use robot_model_fuzz::answer::Answer;
use robot_model_fuzz::kind::Kind;
use robot_model_fuzz::minimize::minimize;
use robot_model_fuzz::run::{Failure, watched};

/// What is asked for beyond [`MOST_MEMORY`] is not given, which ends the program: the file is `current` in `--failures` then.
#[global_allocator]
static ALLOCATOR: Cap<System> = Cap::new(System, MOST_MEMORY);

/// Pages of Parquet take up to 2 GiB, and the library that reads bags reserves as many bytes as a text of 32 bits of length may have,
/// which it does not touch.
const MOST_MEMORY: usize = 6 << 30;

/// Longer texts say nothing that shorter ones do not, and take the time of many.
const LONGEST: usize = 20_000;

/// Damages files and gives them to what reads them.
#[derive(Debug, Parser)]
struct Arguments {
    /// Which kind of files.
    #[arg(long, value_enum, default_value = "spec")]
    kind: Kind,
    /// How long.
    #[arg(long, default_value_t = 60)]
    seconds: u64,
    /// Same seed, same damage, as far as time allows.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Folders of files to start from, beside the sound ones that each kind has.
    #[arg(long, default_values_os_t = [PathBuf::from("fuzz/corpus"), "tests/specs/pass".into(), "tests/specs/run".into(), "tests/specs/fail".into(), "model-spec/effects".into()])]
    from: Vec<PathBuf>,
    /// Where files with new answers are kept; without it they are forgotten at the end.
    #[arg(long)]
    keep: Option<PathBuf>,
    /// Where failures are saved.
    #[arg(long, default_value = "fuzz/failures")]
    failures: PathBuf,
    /// Longest time for one file.
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
    let kind = arguments.kind;
    let sound = kind.seeds().into_iter().enumerate();
    let mut start: Vec<(String, Vec<u8>)> = sound
        .map(|(k, file)| (format!("sound file {k}"), file))
        .collect();
    for folder in &arguments.from {
        start.extend(files(folder, kind)?);
    }
    for (name, file) in start {
        match watched(kind, &file, limit) {
            Ok((answer, _)) => drop(pool.take(&answer, &file)),
            Err(failure) => {
                println!("{name}: {failure}");
                return Ok(false);
            }
        }
    }
    fs::create_dir_all(&arguments.failures)?;
    let current = arguments
        .failures
        .join(format!("current.{}", kind.extension()));
    let mut dice = ChaCha8Rng::seed_from_u64(arguments.seed);
    let (start, mut count, mut taken) = (Instant::now(), 0_u64, 0_u64);
    let mut slowest = (Duration::ZERO, Vec::new());
    let mut is_clean = true;
    while start.elapsed() < Duration::from_secs(arguments.seconds) {
        let file = kind.mutate(pool.pick(&mut dice), pool.pick(&mut dice), &mut dice);
        if file.len() > LONGEST {
            continue;
        }
        // A stack overflow or an abort leaves its file here.
        fs::write(&current, &file)?;
        count += 1;
        match watched(kind, &file, limit) {
            Ok((answer, time)) => {
                taken += u64::from(matches!(
                    answer,
                    Answer::Emitted { .. } | Answer::Read { .. }
                ));
                if time > slowest.0 {
                    slowest = (time, file.clone());
                }
                if pool.take(&answer, &file)
                    && let Some(folder) = &arguments.keep
                {
                    fs::create_dir_all(folder)?;
                    let name = format!("{:05}.{}", pool.answers(), kind.extension());
                    fs::write(folder.join(name), &file)?;
                }
            }
            Err(failure) => {
                is_clean = false;
                let path = save(arguments, &file, &failure)?;
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
    let name = format!("slowest.{}", kind.extension());
    fs::write(arguments.failures.join(name), &slowest.1)?;
    println!(
        "{count} files in {:.0?}, {taken} of them taken, {} different answers; the slowest took {:.1?}",
        start.elapsed(),
        pool.answers(),
        slowest.0
    );
    Ok(is_clean)
}

/// Files that are damaged further, and the answers seen.
#[derive(Default)]
struct Pool {
    sound: Vec<Vec<u8>>,
    refused: Vec<Vec<u8>>,
    messages: BTreeSet<String>,
    sizes: BTreeSet<Answer>,
}

impl Pool {
    /// Whether the answer has anything new; then the file is kept.
    fn take(&mut self, answer: &Answer, file: &[u8]) -> bool {
        match answer {
            Answer::Refused(messages) => {
                let before = self.messages.len();
                self.messages.extend(messages.iter().cloned());
                let is_new = self.messages.len() > before;
                if is_new {
                    self.refused.push(file.to_owned());
                }
                is_new
            }
            Answer::Emitted { .. } | Answer::Uncertain { .. } | Answer::Read { .. } => {
                let is_new = self.sizes.insert(answer.clone());
                if is_new {
                    self.sound.push(file.to_owned());
                }
                is_new
            }
        }
    }

    fn answers(&self) -> usize {
        self.messages.len() + self.sizes.len()
    }

    /// Mostly a file that is taken: what is behind the checks is reached by few others.
    fn pick(&self, dice: &mut ChaCha8Rng) -> &[u8] {
        let files =
            if self.refused.is_empty() || (!self.sound.is_empty() && dice.random_range(0..8) > 0) {
                &self.sound
            } else {
                &self.refused
            };
        files
            .get(dice.random_range(0..files.len().max(1)))
            .map_or(&[], Vec::as_slice)
    }
}

/// Files of a kind in a folder, with their names.
fn files(folder: &Path, kind: Kind) -> io::Result<Vec<(String, Vec<u8>)>> {
    let mut paths: Vec<PathBuf> = fs::read_dir(folder)?
        .map(|entry| entry.map(|entry| entry.path()))
        .collect::<io::Result<_>>()?;
    paths.retain(|path| Kind::of(path) == Some(kind));
    paths.sort();
    let read = |path: PathBuf| Ok((path.display().to_string(), fs::read(&path)?));
    paths.into_iter().map(read).collect()
}

/// Saves the file, made as small as it gets without losing the failure.
fn save(arguments: &Arguments, file: &[u8], failure: &Failure) -> io::Result<PathBuf> {
    let (kind, limit) = (arguments.kind, Duration::from_secs(arguments.limit_seconds));
    let smallest = match failure {
        Failure::Panic(wanted) => minimize(
            file,
            &|candidate| matches!(watched(kind, candidate, limit), Err(Failure::Panic(message)) if message == *wanted),
        ),
        Failure::Slow(_) => file.to_owned(),
    };
    let digest = smallest
        .iter()
        .fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
            (hash ^ u64::from(*byte)).wrapping_mul(0x100_0000_01b3)
        });
    let name = format!("{digest:016x}.{}", kind.extension());
    let path = arguments.failures.join(name);
    fs::write(&path, smallest)?;
    Ok(path)
}
