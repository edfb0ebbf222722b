//! 120 000 rows piece by piece: time and memory of what the publication keeps as one matrix.

use std::thread;
use std::time::Instant;

use robot_model::columns::{Arm as _, Columns as _};
use robot_model::excite::Fourier;
use robot_model::identify::{Factor, JointRows, Method, Segment, Stack};
use robot_model::motion::Motion;
use robot_model::signal::Bands;
use robot_model_cli::interpreted::InterpretedArm;

use super::truth::SAMPLES;
use crate::paper::Error;

/// Samples that are reduced at once.
const PIECE: usize = 1000;

/// Runs; the quickest one counts, as others share the machine.
const RUNS: usize = 3;

/// What reducing the rows of a period took.
#[derive(Debug, Clone, Copy)]
pub struct Streamed {
    /// Rows of all joints, and columns.
    pub size: [usize; 2],
    /// s, from positions to an estimate.
    pub seconds: f64,
    /// Rows of a piece: the most that is in memory.
    pub piece: usize,
    /// Largest relative error of the parameters that the rows were made with.
    pub error: f64,
}

/// A parameter that the rows are made with.
fn value(column: usize) -> f64 {
    1.0 + 0.1 * column as f64
}

/// Rows of a piece of a motion.
fn piece(arm: &InterpretedArm, motion: &Fourier, first: usize) -> Stack {
    let time: Vec<f64> = (first..first + PIECE).map(|k| 1e-3 * k as f64).collect();
    let kinematics = motion.motion(&time);
    let motion = Motion {
        time: time.clone(),
        wide: kinematics.clone(),
        smooth: kinematics,
        ..Motion::default()
    };
    let mut joints = vec![JointRows::default(); arm.dof()];
    for entry in arm.entries(&motion, &[]) {
        let rows = &mut joints[entry.joint];
        rows.target.resize(entry.values.len(), 0.0);
        for (tau, x) in rows.target.iter_mut().zip(&entry.values) {
            *tau += value(entry.column) * x;
        }
        rows.columns.push((entry.column, entry.values));
    }
    for (joint, rows) in joints.iter_mut().enumerate() {
        for (k, tau) in rows.target.iter_mut().enumerate() {
            *tau += 0.1 * (12.9898 * ((first + k) * (joint + 3)) as f64).sin();
        }
        rows.tau.clone_from(&rows.target);
    }
    Stack {
        unknowns: arm.unknowns().to_vec(),
        joints,
        segments: vec![Segment { start: 0, time }],
        ..Stack::default()
    }
}

/// Reduces one period of a motion at 1 kHz on two threads.
///
/// # Errors
/// Those of the runtime.
pub fn stream(arm: &InterpretedArm, motion: &Fourier) -> Result<Streamed, Error> {
    let mut streamed = Streamed {
        size: [SAMPLES * arm.dof(), arm.unknowns().len()],
        seconds: f64::INFINITY,
        piece: PIECE * arm.dof(),
        error: 0.0,
    };
    for _ in 0..RUNS {
        let start = Instant::now();
        let half = |from: usize| -> Result<Factor, Error> {
            let mut factor = Factor::new(arm, Bands::DEFAULT)?;
            for first in (from..from + SAMPLES / 2).step_by(PIECE) {
                factor.push_rows(&piece(arm, motion, first));
            }
            Ok(factor)
        };
        let mut whole = half_by_half(&half)?;
        let [first, second] = &mut whole;
        first.merge(second.clone())?;
        let estimate = first.estimate(arm, Method::Wls, false)?;
        streamed.seconds = streamed.seconds.min(start.elapsed().as_secs_f64());
        let values = estimate.values();
        let errors = values.iter().enumerate();
        let errors = errors.map(|(column, found)| (found / value(column) - 1.0).abs());
        streamed.error = errors.fold(0.0, f64::max);
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
