//! `cargo bench --bench identification`: a regressor is evaluated, stacked and solved by streaming QR, beside `numpy.linalg.lstsq` on a matrix
//! that is there already. It fails where that takes more than a third as long, where memory reaches a bound, and where a log of a hundred times
//! the length takes more of it than one that fills all blocks which are kept apart. What cannot be measured here is said not to be judged, and fails nothing.

use std::borrow::Cow;
use std::io::Write;
use std::process::{Command, ExitCode};
use std::time::Instant;

use robot_model::columns::{Arm, Columns};
use robot_model::identify::{Factor, Identify, JointRows, Segment, Stack};
use robot_model::motion::{Kinematics, Motion};
use robot_model::signal::Bands;
use robot_model_cli::interpreted::InterpretedArm;
use robot_model_codegen::compile_model;

/// Samples of the log, and of a piece that is reduced at once.
const SAMPLES: usize = 20_000;
const PIECE: usize = 1000;

/// Base parameters of the arm.
const COLUMNS: usize = 70;

/// How the libraries below `NumPy` are told how many threads to take.
const BLAS_THREADS: [&str; 3] = ["OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"];

/// Runs of each; the least counts.
const RUNS: usize = 7;

/// Largest part of the reference's time, and memory of the whole process that is too much, MB.
const MOST_TIME: f64 = 1.0 / 3.0;
const MOST_MEMORY: f64 = 200.0;

/// How many times as long the long log is, and by what share it may have more memory than one that is long enough to fill all blocks that
/// are kept apart: a process that runs longer has crumbs.
const LONGER: usize = 100;
const FULL: usize = 5;
const MORE_MEMORY: f64 = 0.1;

/// The argument of a process that reduces a log for its memory.
const ALONE: &str = "--pieces";

const NUMPY: &str = r"
import sys, time
import numpy
rows, columns, runs = map(int, sys.argv[1:])
random = numpy.random.default_rng(1)
A = random.standard_normal((rows, columns))
b = A @ random.standard_normal(columns) + random.standard_normal(rows)
least = float('inf')
for _ in range(runs):
    start = time.perf_counter()
    numpy.linalg.lstsq(A, b, rcond=None)
    least = min(least, time.perf_counter() - start)
print(least)
";

fn arm() -> InterpretedArm {
    let text = include_str!("../tests/specs/pass/rokae_like.robot");
    let model = robot_model_spec::load("rokae_like.robot", text).unwrap_or_else(|e| panic!("{e}"));
    InterpretedArm::new(compile_model(&model))
}

/// A sum of sines with its exact derivatives, from a sample on.
fn motion(dof: usize, first: usize, count: usize) -> Motion {
    let series = |joint: usize, of: &dyn Fn(f64, f64, f64) -> f64| -> Vec<f64> {
        let at = |k: usize| {
            let t = 0.001 * (first + k) as f64;
            let terms = (1..=5).map(|l| {
                let w = 0.6 * l as f64 + 0.11 * joint as f64;
                of(w, w * t + 0.7 * (joint * l) as f64, 0.5 / l as f64)
            });
            terms.sum()
        };
        (0..count).map(at).collect()
    };
    let all = |of: &dyn Fn(f64, f64, f64) -> f64| (0..dof).map(|joint| series(joint, of)).collect();
    let kinematics = Kinematics {
        q: all(&|_, phase, a| a * phase.sin()),
        dq: all(&|w, phase, a| a * w * phase.cos()),
        ddq: all(&|w, phase, a| -a * w * w * phase.sin()),
    };
    Motion {
        time: (first..first + count).map(|k| 0.001 * k as f64).collect(),
        wide: kinematics.clone(),
        smooth: kinematics,
        ..Motion::default()
    }
}

/// Columns of a motion, and a torque that is a sum of them and of some noise.
fn stack(arm: &InterpretedArm, motion: &Motion) -> Stack {
    let mut joints = vec![JointRows::default(); arm.dof()];
    for entry in arm.entries(motion, &[]) {
        let rows = &mut joints[entry.joint];
        rows.target.resize(entry.values.len(), 0.0);
        let value = 1.0 + 0.1 * entry.column as f64;
        for (tau, x) in rows.target.iter_mut().zip(&entry.values) {
            *tau += value * x;
        }
        rows.columns.push((entry.column, entry.values));
    }
    for (joint, rows) in joints.iter_mut().enumerate() {
        for (k, tau) in rows.target.iter_mut().enumerate() {
            *tau += 0.1 * (12.9898 * (k * (joint + 3)) as f64).sin();
        }
        rows.tau.clone_from(&rows.target);
    }
    Stack {
        turns: Vec::new(),
        silent: Vec::new(),
        clipped: Vec::new(),
        held: Vec::new(),
        noise: Vec::new(),
        unknowns: arm.unknowns().to_vec(),
        joints,
        segments: vec![Segment {
            start: 0,
            time: Vec::new(),
        }],
    }
}

/// Pieces of a log by their number.
type Pieces<'a> = &'a (dyn Fn(usize) -> Cow<'a, Motion> + Sync);

/// Cores of this machine.
fn cores() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

/// So many pieces one after the other, by so many threads: seconds, the estimate's errors.
fn ours(arm: &InterpretedArm, count: usize, pieces: Pieces<'_>, workers: usize) -> (f64, f64) {
    let start = Instant::now();
    let share = count.div_ceil(workers);
    let new = || Factor::new(arm, Bands::DEFAULT).expect("every shape has a value");
    let factors: Vec<Factor> = std::thread::scope(|scope| {
        let reduce = |worker: usize| {
            let mut factor = new();
            for k in worker * share..count.min((worker + 1) * share) {
                factor.push_rows(&stack(arm, &pieces(k)));
            }
            factor
        };
        let running: Vec<_> = (0..workers)
            .map(|worker| scope.spawn(move || reduce(worker)))
            .collect();
        let joined = running.into_iter().map(|one| one.join().expect("no panic"));
        joined.collect()
    });
    let mut whole = new();
    for factor in factors {
        whole.merge(factor).expect("one arm");
    }
    let estimate = whole.estimate(arm, &Identify::default()).expect("excited");
    let seconds = start.elapsed().as_secs_f64();
    let values = estimate.values();
    let errors = values.iter().enumerate();
    let errors = errors.map(|(c, value)| (value / (1.0 + 0.1 * c as f64) - 1.0).abs());
    (seconds, errors.fold(0.0, f64::max))
}

/// Largest memory of this process so far, MB, where the system says it.
fn memory() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = text.lines().find(|line| line.starts_with("VmHWM:"))?;
    let kilobytes: f64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(kilobytes / 1024.0)
}

/// Reduces so many pieces, which are made where they are needed, as a file would be read; largest memory of that, MB.
fn reduce_alone(pieces: usize) -> Option<f64> {
    let arm = arm();
    let made = |k| Cow::Owned(motion(arm.dof(), k * PIECE, PIECE));
    let (_, error) = ours(&arm, pieces, &made, cores());
    assert!(error < 0.05, "values are found: {error}");
    memory()
}

/// The same in a process of its own: one that has done other work before has crumbs of that.
fn memory_of(pieces: usize) -> Option<f64> {
    let program = std::env::current_exe().ok()?;
    let run = Command::new(program)
        .args([ALONE, &pieces.to_string()])
        .output();
    let run = run.ok().filter(|run| run.status.success())?;
    String::from_utf8(run.stdout).ok()?.trim().parse().ok()
}

/// Seconds of the reference with so many threads.
fn numpy(rows: usize, columns: usize, threads: usize) -> Option<f64> {
    let python = std::env::var_os("PYTHON").unwrap_or_else(|| "python3".into());
    let arguments = [rows, columns, RUNS].map(|number| number.to_string());
    let run = Command::new(python)
        .arg("-c")
        .arg(NUMPY)
        .args(arguments)
        .envs(BLAS_THREADS.map(|name| (name, threads.to_string())))
        .output();
    let run = run.ok().filter(|run| run.status.success())?;
    String::from_utf8(run.stdout).ok()?.trim().parse().ok()
}

/// Both with so many threads.
struct Timed {
    threads: usize,
    seconds: f64,
    /// Of the reference.
    numpy: Option<f64>,
}

/// What was measured, where it could be.
struct Measured {
    rows: usize,
    columns: usize,
    /// With one thread, and with one a core.
    timed: [Timed; 2],
    /// MB: of the log, of one that fills the blocks, of the long one.
    memory: Option<f64>,
    memory_full: Option<f64>,
    memory_long: Option<f64>,
    /// The long log alone.
    seconds_long: f64,
}

fn measure() -> Measured {
    let arm = arm();
    let pieces = SAMPLES / PIECE;
    let of = |k: usize| motion(arm.dof(), k * PIECE, PIECE);
    let motions: Vec<Motion> = (0..pieces).map(of).collect();
    let (rows, columns) = (SAMPLES * arm.dof(), arm.unknowns().len());
    assert_eq!(columns, COLUMNS);
    let timed = [1, cores()].map(|threads| {
        let mut seconds = f64::INFINITY;
        for _ in 0..RUNS {
            let (run, error) = ours(&arm, pieces, &|k| Cow::Borrowed(&motions[k]), threads);
            assert!(error < 0.05, "values are found: {error}");
            seconds = seconds.min(run);
        }
        Timed {
            threads,
            seconds,
            numpy: numpy(rows, columns, threads),
        }
    });
    let start = Instant::now();
    let memory_long = memory_of(LONGER * pieces);
    let seconds_long = start.elapsed().as_secs_f64();
    Measured {
        rows,
        columns,
        timed,
        memory: memory_of(pieces),
        memory_full: memory_of(FULL * pieces),
        memory_long,
        seconds_long,
    }
}

/// What is to hold of measured values.
enum Verdict {
    Holds(String),
    Fails(String),
    /// What nobody asks for, or what cannot be measured here.
    NotJudged(String),
}

impl Verdict {
    fn of(holds: bool, what: String) -> Self {
        if holds {
            Self::Holds(what)
        } else {
            Self::Fails(what)
        }
    }

    fn line(&self) -> String {
        let (word, what) = match self {
            Self::Holds(what) => ("holds", what),
            Self::Fails(what) => ("FAILS", what),
            Self::NotJudged(what) => ("not judged", what),
        };
        format!("{word}: {what}\n")
    }
}

impl Timed {
    fn verdict(&self) -> Verdict {
        let threads = match self.threads {
            1 => "1 thread".to_owned(),
            more => format!("{more} threads"),
        };
        let ours = 1e3 * self.seconds;
        match self.numpy {
            Some(numpy) => {
                let said = format!(
                    "{threads}: {ours:.1} ms are {:.2} of the {:.1} ms of numpy.linalg.lstsq on the matrix alone; {MOST_TIME:.2} at most",
                    self.seconds / numpy,
                    1e3 * numpy
                );
                // The tool takes all cores that there are.
                if self.threads == cores() {
                    Verdict::of(self.seconds <= MOST_TIME * numpy, said)
                } else {
                    Verdict::NotJudged(said)
                }
            }
            None => Verdict::NotJudged(format!(
                "{threads}: {ours:.1} ms, beside nothing: the reference is NumPy, which was not found; set PYTHON to a Python that has it"
            )),
        }
    }
}

fn verdicts(measured: &Measured) -> [Verdict; 4] {
    let [one, all] = measured.timed.each_ref().map(Timed::verdict);
    let (Some(memory), Some(full), Some(long)) =
        (measured.memory, measured.memory_full, measured.memory_long)
    else {
        let says_nothing = || Verdict::NotJudged("memory: the system does not say it".to_owned());
        return [one, all, says_nothing(), says_nothing()];
    };
    [
        one,
        all,
        Verdict::of(
            memory < MOST_MEMORY,
            format!("{memory:.0} MB at most in memory; below {MOST_MEMORY:.0}"),
        ),
        Verdict::of(
            long <= (1.0 + MORE_MEMORY) * full && long < MOST_MEMORY,
            format!(
                "{full:.0} MB with {FULL} times the rows, which fill all blocks, {long:.0} MB with {LONGER} times, which took {:.1} s; {:.0} at most",
                measured.seconds_long,
                (1.0 + MORE_MEMORY) * full
            ),
        ),
    ]
}

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().collect();
    if let [_, alone, pieces] = arguments.as_slice()
        && alone == ALONE
    {
        let memory = pieces.parse().ok().and_then(reduce_alone);
        let said = memory.map(|memory| writeln!(std::io::stdout(), "{memory}"));
        return if matches!(said, Some(Ok(()))) {
            ExitCode::SUCCESS
        } else {
            ExitCode::FAILURE
        };
    }
    let measured = measure();
    let verdicts = verdicts(&measured);
    let lines: String = verdicts.iter().map(Verdict::line).collect();
    let said = write!(
        std::io::stdout(),
        "{} rows, {} columns, least of {RUNS} runs: regressor, stack, streaming QR, weights\n{lines}",
        measured.rows,
        measured.columns
    );
    let fails = verdicts
        .iter()
        .any(|verdict| matches!(verdict, Verdict::Fails(_)));
    if fails || said.is_err() {
        return ExitCode::FAILURE;
    }
    ExitCode::SUCCESS
}
