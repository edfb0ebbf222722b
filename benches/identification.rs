//! `cargo bench --bench identification`: a regressor is evaluated, stacked and solved by streaming QR, beside `numpy.linalg.lstsq` on a matrix
//! that is there already.

use std::io::Write;
use std::process::{Command, ExitCode};
use std::time::Instant;

use robot_model::columns::{Arm, Columns};
use robot_model::identify::{Factor, JointRows, Method, Segment, Stack};
use robot_model::motion::{Kinematics, Motion};
use robot_model::signal::Bands;
use robot_model_cli::interpreted::InterpretedArm;
use robot_model_codegen::compile_model;

/// Samples of the log, and of a piece that is reduced at once.
const SAMPLES: usize = 20_000;
const PIECE: usize = 1000;

/// Runs of each; the least counts.
const RUNS: usize = 7;

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
        clipped: Vec::new(),
        unknowns: arm.unknowns().to_vec(),
        joints,
        segments: vec![Segment {
            start: 0,
            time: Vec::new(),
        }],
    }
}

/// Pieces one after the other, on all cores: seconds, the estimate's errors.
fn ours(arm: &InterpretedArm, motions: &[Motion]) -> (f64, f64) {
    let start = Instant::now();
    let workers = std::thread::available_parallelism().map_or(1, usize::from);
    let share = motions.len().div_ceil(workers);
    let new = || Factor::new(arm, Bands::DEFAULT).expect("every shape has a value");
    let factors: Vec<Factor> = std::thread::scope(|scope| {
        let reduce = |part: &[Motion]| {
            let mut factor = new();
            for motion in part {
                factor.push_rows(&stack(arm, motion));
            }
            factor
        };
        let parts = motions.chunks(share);
        let running: Vec<_> = parts
            .map(|part| scope.spawn(move || reduce(part)))
            .collect();
        let joined = running.into_iter().map(|one| one.join().expect("no panic"));
        joined.collect()
    });
    let mut whole = new();
    for factor in factors {
        whole.merge(factor).expect("one arm");
    }
    let estimate = whole.estimate(arm, Method::Wls).expect("excited");
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

fn numpy(rows: usize, columns: usize) -> Option<f64> {
    let python = std::env::var_os("PYTHON").unwrap_or_else(|| "python3".into());
    let arguments = [rows, columns, RUNS].map(|number| number.to_string());
    let run = Command::new(python)
        .arg("-c")
        .arg(NUMPY)
        .args(arguments)
        .output();
    let run = run.ok().filter(|run| run.status.success())?;
    String::from_utf8(run.stdout).ok()?.trim().parse().ok()
}

fn main() -> ExitCode {
    let arm = arm();
    let columns = arm.unknowns().len();
    let motions: Vec<Motion> = (0..SAMPLES / PIECE)
        .map(|k| motion(arm.dof(), k * PIECE, PIECE))
        .collect();
    let mut least = f64::INFINITY;
    for _ in 0..RUNS {
        let (seconds, error) = ours(&arm, &motions);
        assert!(error < 0.05, "values are found: {error}");
        least = least.min(seconds);
    }
    let rows = SAMPLES * arm.dof();
    let memory = memory().map_or_else(String::new, |memory| {
        format!("largest memory: {memory:.0} MB\n")
    });
    let numpy = match numpy(rows, columns) {
        Some(seconds) => format!(
            "numpy.linalg.lstsq on the matrix alone: {:.1} ms, of which ours is {:.2}",
            1e3 * seconds,
            least / seconds
        ),
        None => "NumPy was not found: set PYTHON".to_owned(),
    };
    let said = writeln!(
        std::io::stdout(),
        "{rows} rows, {columns} columns, least of {RUNS} runs\nregressor, stack, streaming QR, weights: {:.1} ms\n{memory}{numpy}",
        1e3 * least
    );
    match said {
        Ok(()) => ExitCode::SUCCESS,
        Err(_) => ExitCode::FAILURE,
    }
}
