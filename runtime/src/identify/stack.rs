//! Regressor rows of measured logs: filtered, decimated, one block a joint.
//!
//! In: an [`Arm`] and prepared logs. Out: a [`Stack`]. Invariant gained: torque and every column of a log went through the
//! same filter, and all blocks have the same samples.

mod columns;

use std::ops::Range;

use super::drowned::PositionNoise;
use super::hac::correlation_time;
use crate::columns::{Arm, Entry, Unknown};
use crate::signal::Prepared;

pub(super) use columns::nameless;
pub(crate) use columns::whole_torque;
pub use columns::{filtered_columns, torque_of};

/// Entries of a column below this, per unit of its parameter in SI, are rounding.
const ROUNDING: f64 = 1e-12;

/// Positions (rad or m) and torques that change by no more than this stand still.
const STILL: f64 = 1e-9;

/// The rows of one joint: `target[k] = sum over columns of values[k] * unknown + residual`.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct JointRows {
    /// Filtered measured torque, N m or N.
    pub tau: Vec<f64>,
    /// The same less the torque of parameters that the spec fixes.
    pub target: Vec<f64>,
    /// Columns that are not zero by structure: index of the unknown, one value a sample. Ascending.
    pub columns: Vec<(usize, Vec<f64>)>,
}

/// The stacked regressor of one or several logs.
///
/// # Examples
/// A spring whose torque has something else in it:
/// ```
/// use robot_model::columns::{Entry, Unknown};
/// use robot_model::identify::{JointRows, Stack};
/// let unknown = |name: &str| Unknown { name: name.to_owned(), nonnegative: true };
/// let tau = vec![3.0, 2.0];
/// let spring = JointRows { target: tau.clone(), tau, columns: vec![(0, vec![0.25, 0.25])] };
/// let mut stack = Stack { unknowns: vec![unknown("k")], joints: vec![spring], ..Stack::default() };
/// assert_eq!((stack.dof(), stack.samples(), stack.counts()), (1, 2, vec![2]));
/// assert_eq!(stack.residuals(&[10.0]), [[0.5, -0.5]]);
///
/// let friction = Entry { joint: 0, column: 0, values: vec![1.0, -1.0] };
/// assert_eq!(stack.append(&[unknown("fc")], &[friction]), 1);
/// assert_eq!(stack.residuals(&[10.0, 0.5]), [[0.0, 0.0]]);
/// stack.truncate(1);
/// assert_eq!(stack.residuals(&[10.0]), [[0.5, -0.5]]);
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Stack {
    /// The unknowns, one per column.
    pub unknowns: Vec<Unknown>,
    /// One block of rows a joint.
    pub joints: Vec<JointRows>,
    /// Where each log's samples are in every block, and their times.
    pub segments: Vec<Segment>,
    /// Rows of each joint with dry friction where it turns; no joints where none were looked for.
    pub turns: Vec<Vec<usize>>,
    /// Rows of each joint that are left out because its torque stands at a limit; no joints where none were looked for.
    pub clipped: Vec<Vec<usize>>,
    /// Rows of each joint that are left out because the log says nothing of it: it stands still, or its torque does.
    pub silent: Vec<Vec<usize>>,
    /// Rows of each joint that are left out because dry friction holds it nearly all the time; no joints where none were looked for.
    pub held: Vec<Vec<usize>>,
    /// Of each joint a factor of what noise of positions makes of the columns; no joints where none was looked for.
    pub noise: Vec<PositionNoise>,
}

/// One log's share of the rows.
#[derive(Debug, Clone, PartialEq)]
pub struct Segment {
    /// First row.
    pub start: usize,
    /// Time of each row, s since the start of the log.
    pub time: Vec<f64>,
}

impl JointRows {
    /// Whether a row says something: of one that was left out the target and all columns are zero.
    pub(super) fn is_there(&self, row: usize) -> bool {
        let mut columns = self.columns.iter();
        self.target[row] != 0.0 || columns.any(|(_, values)| values[row] != 0.0)
    }

    /// How many rows say something.
    pub(super) fn count(&self) -> usize {
        let rows = 0..self.target.len();
        rows.filter(|&row| self.is_there(row)).count()
    }

    /// Rows that say nothing.
    pub(super) fn clear(&mut self, rows: Range<usize>) {
        let columns = self.columns.iter_mut().map(|(_, values)| values);
        for values in columns.chain([&mut self.tau, &mut self.target]) {
            values[rows.clone()].fill(0.0);
        }
    }
}

/// Joints of which a log says nothing: a brake or dry friction holds one that stands still, with a torque that nobody knows, and a
/// torque that never changes was not measured.
pub(super) fn says_nothing(log: &Prepared) -> Vec<usize> {
    let stands = |values: &[f64]| {
        let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let low = values.iter().copied().fold(f64::INFINITY, f64::min);
        high - low <= STILL
    };
    let (positions, torques) = (&log.motion.smooth.q, &log.tau);
    let joints = 0..positions.len();
    joints
        .filter(|&joint| stands(&positions[joint]) || stands(&torques[joint]))
        .collect()
}

impl Stack {
    /// Evaluates the arm over the logs, filters and decimates.
    ///
    /// `shapes` has one value per [`Columns::shapes`](crate::columns::Columns::shapes) of the arm.
    ///
    /// # Examples
    /// ```
    /// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
    /// # use pendulum::{measure, pendulum};
    /// # use robot_model::{identify::Stack, signal::{Bands, prepare}};
    /// let log = measure(0.0);
    /// let prepared = prepare(&log, &Bands::for_log(&log))?;
    /// let stack = Stack::new(&pendulum(), &[prepared], &[]);
    /// // izz, mx and fv of the log say its torque but for the noise, of 0.03 N m before the filter.
    /// let left = &stack.residuals(&[2.0, 9.0, 1.0])[0];
    /// assert!(left.iter().map(|x| x * x).sum::<f64>() / (left.len() as f64) < 0.03_f64.powi(2));
    /// # Ok::<(), robot_model::signal::SignalError>(())
    /// ```
    #[must_use]
    pub fn new(arm: &dyn Arm, logs: &[Prepared], shapes: &[f64]) -> Self {
        let mut stack = Self {
            unknowns: arm.unknowns().to_vec(),
            joints: vec![JointRows::default(); arm.dof()],
            silent: vec![Vec::new(); arm.dof()],
            ..Self::default()
        };
        let mut filtered = Vec::new();
        let mut silent = Vec::new();
        for log in logs {
            let start = stack.samples();
            let count = log.motion.time.len();
            let time = log.shared.kept(count).map(|k| log.motion.time[k]).collect();
            stack.segments.push(Segment { start, time });
            let known = arm.known_torque(&log.motion, shapes);
            silent.push((start, says_nothing(log)));
            for (joint, rows) in stack.joints.iter_mut().enumerate() {
                let gain = arm.actuator_gain()[joint];
                let tau: Vec<f64> = log.tau[joint].iter().map(|tau| gain * tau).collect();
                let target: Vec<f64> = tau
                    .iter()
                    .zip(&known[joint])
                    .map(|(tau, known)| tau - known)
                    .collect();
                log.shared.apply(&tau, &mut filtered);
                rows.tau.extend_from_slice(&filtered);
                log.shared.apply(&target, &mut filtered);
                rows.target.extend_from_slice(&filtered);
            }
        }
        let columns = filtered_columns(arm, logs, shapes);
        for Entry {
            joint,
            column,
            values,
        } in columns
        {
            // What rounding leaves of a column that is zero is no excitation.
            if values.iter().all(|value| value.abs() < ROUNDING) {
                continue;
            }
            stack.joints[joint].columns.push((column, values));
        }
        for rows in &mut stack.joints {
            rows.columns.sort_by_key(|(column, _)| *column);
        }
        let end = stack.samples();
        let ends = silent.iter().skip(1).map(|(start, _)| *start).chain([end]);
        let ends: Vec<usize> = ends.collect();
        for ((start, joints), end) in silent.into_iter().zip(ends) {
            for joint in joints {
                stack.joints[joint].clear(start..end);
                stack.silent[joint].extend(start..end);
            }
        }
        stack
    }

    /// Rows per joint.
    ///
    /// # Examples
    /// ```
    /// # mod spring { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/spring.rs")); }
    /// assert_eq!(spring::spring().samples(), 2); // on the way there and back
    /// ```
    #[must_use]
    pub fn samples(&self) -> usize {
        self.joints.first().map_or(0, |rows| rows.target.len())
    }

    /// Rows of each joint that say something: those that were left out do not.
    ///
    /// # Examples
    /// ```
    /// # mod spring { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/spring.rs")); }
    /// let mut stack = spring::spring();
    /// // A row that was left out: torque and columns are zero.
    /// stack.joints[0].target[1] = 0.0;
    /// stack.joints[0].columns.iter_mut().for_each(|(_, values)| values[1] = 0.0);
    /// assert_eq!((stack.samples(), stack.counts()), (2, vec![1]));
    /// ```
    #[must_use]
    pub fn counts(&self) -> Vec<usize> {
        self.joints.iter().map(JointRows::count).collect()
    }

    /// [`correlation_time`] of each joint's residuals, of rows that say something.
    pub(super) fn correlation_times(&self, residuals: &[Vec<f64>]) -> Vec<f64> {
        let pairs = self.joints.iter().zip(residuals);
        let time = |(rows, residuals): (&JointRows, &Vec<f64>)| {
            let all = residuals.iter().enumerate();
            let there = all.filter(|(row, _)| rows.is_there(*row));
            correlation_time(&there.map(|(_, residual)| *residual).collect::<Vec<f64>>())
        };
        pairs.map(time).collect()
    }

    /// Some of the rows, without their times.
    pub(super) fn part(&self, range: Range<usize>) -> Self {
        let joints = self.joints.iter().map(|rows| JointRows {
            tau: rows.tau[range.clone()].to_vec(),
            target: rows.target[range.clone()].to_vec(),
            columns: rows
                .columns
                .iter()
                .map(|(column, values)| (*column, values[range.clone()].to_vec()))
                .collect(),
        });
        let turns = self.turns.iter().map(|rows| {
            let rows = rows.iter().filter(|row| range.contains(row));
            rows.map(|row| row - range.start).collect()
        });
        Self {
            unknowns: self.unknowns.clone(),
            joints: joints.collect(),
            turns: turns.collect(),
            ..Self::default()
        }
    }

    /// Makes rows of columns zero that the fit leaves out.
    pub(crate) fn clear_left_out(&self, entries: &mut [Entry]) {
        for rows in [&self.silent, &self.clipped, &self.held] {
            for entry in &mut *entries {
                for &row in rows.get(entry.joint).into_iter().flatten() {
                    entry.values[row] = 0.0;
                }
            }
        }
    }

    /// Degrees of freedom.
    ///
    /// # Examples
    /// ```
    /// # mod spring { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/spring.rs")); }
    /// assert_eq!(spring::spring().dof(), 1);
    /// ```
    #[must_use]
    pub fn dof(&self) -> usize {
        self.joints.len()
    }

    /// Appends columns of an effect that the arm does not have; returns the index of the first.
    ///
    /// # Examples
    /// ```
    /// # mod spring { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/spring.rs")); }
    /// let mut stack = spring::spring(); // k = 10 and fc = 0.5 make 3 N m and 2 N m
    /// let bump = robot_model::columns::Entry { joint: 0, column: 0, values: vec![1.0, 0.0] };
    /// assert_eq!(stack.append(&[spring::unknown("bump")], &[bump]), 2);
    /// assert_eq!(stack.residuals(&[10.0, 0.5, 0.2]), [[-0.2, 0.0]]);
    /// ```
    pub fn append(&mut self, unknowns: &[Unknown], columns: &[Entry]) -> usize {
        let first = self.unknowns.len();
        self.unknowns.extend_from_slice(unknowns);
        for entry in columns {
            self.joints[entry.joint]
                .columns
                .push((first + entry.column, entry.values.clone()));
        }
        for rows in &mut self.joints {
            rows.columns.sort_by_key(|(column, _)| *column);
        }
        first
    }

    /// Makes columns zero, so that their unknowns are out of every fit.
    ///
    /// # Examples
    /// ```
    /// # mod spring { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/spring.rs")); }
    /// let mut stack = spring::spring(); // k = 10 and fc = 0.5 make 3 N m and 2 N m
    /// stack.silence(&[1]);
    /// assert_eq!(stack.residuals(&[10.0, 0.5]), [[0.5, -0.5]]); // fc says nothing now
    /// ```
    pub fn silence(&mut self, unknowns: &[usize]) {
        for rows in &mut self.joints {
            rows.columns
                .retain(|(column, _)| !unknowns.contains(column));
        }
    }

    /// Forgets the columns behind the first `unknowns`.
    ///
    /// # Examples
    /// ```
    /// # mod spring { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/spring.rs")); }
    /// let mut stack = spring::spring(); // k = 10 and fc = 0.5 make 3 N m and 2 N m
    /// stack.truncate(1);
    /// assert_eq!((stack.unknowns.len(), stack.residuals(&[10.0])), (1, vec![vec![0.5, -0.5]]));
    /// ```
    pub fn truncate(&mut self, unknowns: usize) {
        self.unknowns.truncate(unknowns);
        for rows in &mut self.joints {
            rows.columns.retain(|(column, _)| *column < unknowns);
        }
    }

    /// `target - columns * estimate`, `[joint][sample]`.
    ///
    /// # Examples
    /// ```
    /// # mod spring { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/spring.rs")); }
    /// assert_eq!(spring::spring().residuals(&[8.0, 0.5]), [[0.5, 0.5]]); // 3 - (8 * 0.25 + 0.5)
    /// ```
    #[must_use]
    pub fn residuals(&self, estimate: &[f64]) -> Vec<Vec<f64>> {
        self.joints
            .iter()
            .map(|rows| {
                let mut residual = rows.target.clone();
                for (column, values) in &rows.columns {
                    subtract(&mut residual, estimate[*column], values);
                }
                residual
            })
            .collect()
    }

    /// `100 || residual || / || tau ||` per joint.
    ///
    /// # Examples
    /// ```
    /// # mod spring { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/spring.rs")); }
    /// let percent = spring::spring().relative_percent(&[8.0, 0.5]);
    /// // Residuals of 0.5 and 0.5, torques of 3 and 2.
    /// assert!((percent[0] - 100.0 * (0.5_f64 / 13.0).sqrt()).abs() < 1e-12);
    /// ```
    #[must_use]
    pub fn relative_percent(&self, estimate: &[f64]) -> Vec<f64> {
        let residuals = self.residuals(estimate);
        let pairs = residuals.iter().zip(&self.joints);
        pairs
            .map(|(residual, rows)| percent(norm(residual), norm(&rows.tau)))
            .collect()
    }
}

pub(super) fn norm(values: &[f64]) -> f64 {
    values.iter().map(|v| v * v).sum::<f64>().sqrt()
}

pub(super) fn percent(part: f64, whole: f64) -> f64 {
    if whole > 0.0 {
        100.0 * part / whole
    } else {
        0.0
    }
}

/// `target -= factor * values`
fn subtract(target: &mut [f64], factor: f64, values: &[f64]) {
    if factor != 0.0 {
        for (t, v) in target.iter_mut().zip(values) {
            *t -= factor * v;
        }
    }
}
