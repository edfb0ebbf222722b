//! Rows of a part of a log, reduced; those around turns of joints with dry friction apart from the others, so that estimates with and
//! without them can be had of many logs, too.

use faer::Mat;

use super::super::least_squares::Factors;
use super::super::stack::Stack;
use super::super::{IdentifyError, check_logs, clipped, prepare_all, turns};
use crate::columns::Arm;
use crate::log::Log;
use crate::signal::Bands;
use crate::signal::resample::whole_steps;

/// Blocks that a log or a piece of one is cut into, at most.
const PARTS: usize = 16;

/// Sums of torque that differ by no more than this share are the same, read and written again.
const SAME: f64 = 1e-12;

/// Parts that a block is known by, at most.
const PRINTS: usize = 64;

/// A part of a log.
#[derive(Debug, Clone, PartialEq)]
pub struct FactorBlock {
    /// Samples per joint.
    pub samples: usize,
    /// Rows away from turns, of a joint without dry friction all.
    pub away: FactorRows,
    /// Rows around turns.
    pub at_turns: FactorRows,
    /// Of each part that this block is made of the sum of all joints' squared torque, by which it is known again, ascending; of many parts
    /// the least ones, so that what two blocks have in common is among those of both.
    pub prints: Vec<f64>,
}

/// Rows, reduced joint by joint.
#[derive(Debug, Clone, PartialEq)]
pub struct FactorRows {
    /// Rows of each joint that say something: a joint that stands says nothing.
    pub counts: Vec<usize>,
    /// `[joint][row][column]`: columns are the unknowns, then the torque less that of known parameters.
    pub rows: Vec<Vec<Vec<f64>>>,
    /// Sum of the squared torque, one a joint.
    pub torque_squares: Vec<f64>,
    /// The largest torque either way, one a joint.
    pub most_torque: Vec<f64>,
}

impl FactorRows {
    /// Those of so many joints where there are none.
    ///
    /// # Examples
    /// ```
    /// use robot_model::identify::FactorRows;
    /// assert_eq!(FactorRows::none(6).counts, [0; 6]);
    /// ```
    #[must_use]
    pub fn none(joints: usize) -> Self {
        Self {
            counts: vec![0; joints],
            rows: vec![Vec::new(); joints],
            torque_squares: vec![0.0; joints],
            most_torque: vec![0.0; joints],
        }
    }

    /// The rows of a stack for which that is so.
    fn of(stack: &Stack, is_so: &dyn Fn(usize, usize) -> bool) -> Self {
        let factors = Factors::of_rows(stack, &|joint, row| f64::from(is_so(joint, row)));
        let joints = stack.joints.iter().enumerate();
        let torques = joints.map(|(joint, rows)| {
            let rows = rows.tau.iter().enumerate();
            let rows = rows.filter(move |(row, _)| is_so(joint, *row));
            rows.map(|(_, tau)| *tau)
        });
        let squares = torques.clone().map(|taus| taus.map(|tau| tau * tau).sum());
        let most = torques.map(|taus| taus.fold(0.0, |most: f64, tau| most.max(tau.abs())));
        // Where no row counts there is nothing to keep.
        let rows = factors.joints().iter().zip(factors.counts());
        let rows = rows.map(|(rows, count)| match count {
            0 => Vec::new(),
            _ => rows_of(rows),
        });
        Self {
            counts: factors.counts().to_vec(),
            rows: rows.collect(),
            torque_squares: squares.collect(),
            most_torque: most.collect(),
        }
    }

    fn add(&mut self, other: Self) {
        for (count, more) in self.counts.iter_mut().zip(other.counts) {
            *count += more;
        }
        for (sum, more) in self.torque_squares.iter_mut().zip(other.torque_squares) {
            *sum += more;
        }
        for (most, more) in self.most_torque.iter_mut().zip(other.most_torque) {
            *most = most.max(more);
        }
        for (rows, more) in self.rows.iter_mut().zip(other.rows) {
            rows.extend(more);
            *rows = rows_of(&reduced(rows));
        }
    }
}

impl FactorBlock {
    /// A log, or a piece of one, as blocks of a second or more. Pieces can be reduced in threads, and [added](super::Factor::extend) in
    /// their order.
    ///
    /// # Errors
    /// Those of [`Identify::fit`](super::super::Identify::fit) for a log that does not fit the arm or the filters.
    ///
    /// # Examples
    /// ```
    /// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
    /// # use pendulum::{measure, pendulum};
    /// # use robot_model::identify::{Factor, FactorBlock, Identify};
    /// let (arm, log) = (pendulum(), measure(0.0));
    /// let bands = Identify::default().bands_of(&arm, &log)?;
    /// let blocks = std::thread::scope(|s| s.spawn(|| FactorBlock::of_log(&arm, &log, &bands)).join());
    /// let mut factor = Factor::new(&arm, bands)?;
    /// factor.extend(blocks.expect("no panic")?);
    /// let mut same = Factor::new(&arm, bands)?;
    /// same.push(&arm, &log)?;
    /// assert_eq!(factor, same);
    /// # Ok::<(), robot_model::identify::IdentifyError>(())
    /// ```
    pub fn of_log(arm: &dyn Arm, log: &Log, bands: &Bands) -> Result<Vec<Self>, IdentifyError> {
        check_logs(arm, std::slice::from_ref(log))?;
        let prepared = prepare_all(std::slice::from_ref(log), bands)?;
        let mut stack = Stack::new(arm, &prepared, &[]);
        clipped::leave_out(&mut stack, arm, &prepared);
        turns::find(&mut stack, arm, &prepared);
        let samples = stack.samples();
        let second = (samples as f64 / log.seconds().max(1.0)).max(1.0);
        let count = whole_steps(samples as f64 / second).clamp(1, PARTS);
        let part = |part: usize| part * samples / count..(part + 1) * samples / count;
        let parts = (0..count).map(|k| Self::of_rows(&stack.part(part(k))));
        Ok(parts.collect())
    }

    /// Rows as one block.
    ///
    /// # Examples
    /// ```
    /// use robot_model::identify::{FactorBlock, JointRows, Stack};
    /// // One unknown, seen as 3 and 4: as much as a single row of 5 says.
    /// let rows = JointRows { tau: vec![6.0, 8.0], target: vec![6.0, 8.0], columns: vec![(0, vec![3.0, 4.0])] };
    /// # let unknown = robot_model::columns::Unknown { name: "k".to_owned(), nonnegative: false };
    /// let stack = Stack { unknowns: vec![unknown], joints: vec![rows], ..Stack::default() };
    /// let block = FactorBlock::of_rows(&stack);
    /// assert_eq!((block.samples, block.away.torque_squares[0]), (2, 100.0));
    /// let row = &block.away.rows[0][0];
    /// assert!((row[0].abs() - 5.0).abs() < 1e-12 && (row[1] / row[0] - 2.0).abs() < 1e-12);
    /// ```
    #[must_use]
    pub fn of_rows(stack: &Stack) -> Self {
        let at_turns = turns::are_at(stack);
        let is_at = |joint: usize, row: usize| at_turns[joint][row];
        let torque = stack.joints.iter().flat_map(|rows| &rows.tau);
        // Without any torque nothing tells it from others.
        let print = Some(torque.map(|tau| tau * tau).sum()).filter(|sum| *sum > 0.0);
        Self {
            prints: print.into_iter().collect(),
            samples: stack.samples(),
            away: FactorRows::of(stack, &|joint, row| !is_at(joint, row)),
            at_turns: if stack.turns.iter().all(Vec::is_empty) {
                FactorRows::none(stack.dof())
            } else {
                FactorRows::of(stack, &is_at)
            },
        }
    }

    /// All rows of a joint.
    pub(super) fn rows(&self, joint: usize) -> impl Iterator<Item = &Vec<f64>> {
        self.away.rows[joint]
            .iter()
            .chain(&self.at_turns.rows[joint])
    }

    /// All rows of a joint that say something.
    pub(super) fn count(&self, joint: usize) -> usize {
        self.away.counts[joint] + self.at_turns.counts[joint]
    }

    /// Sum of the squared torque of a joint.
    pub(super) fn torque_squares(&self, joint: usize) -> f64 {
        self.away.torque_squares[joint] + self.at_turns.torque_squares[joint]
    }

    /// The same without rows at turns.
    pub(super) fn without_turns(&self) -> Self {
        Self {
            samples: self.samples,
            prints: self.prints.clone(),
            away: self.away.clone(),
            at_turns: FactorRows::none(self.away.counts.len()),
        }
    }

    /// What follows becomes a part of this one.
    pub(super) fn add(&mut self, other: Self) {
        self.samples += other.samples;
        self.away.add(other.away);
        self.at_turns.add(other.at_turns);
        self.prints.extend(other.prints);
        self.prints.sort_unstable_by(f64::total_cmp);
        self.prints.truncate(PRINTS);
    }
}

/// How many of the first numbers, which ascend, are among the others, too.
pub(super) fn common(first: &[f64], others: &[f64]) -> usize {
    let mut others = others.iter().peekable();
    let is_there = |one: &&f64| {
        while others
            .next_if(|other| **other < *one - SAME * *one)
            .is_some()
        {}
        others
            .peek()
            .is_some_and(|other| **other <= *one + SAME * *one)
    };
    first.iter().filter(is_there).count()
}

fn rows_of(matrix: &Mat<f64>) -> Vec<Vec<f64>> {
    let rows = 0..matrix.nrows();
    rows.map(|row| matrix.row(row).iter().copied().collect())
        .collect()
}

/// The triangular factor of rows.
pub(super) fn reduced(rows: &[Vec<f64>]) -> Mat<f64> {
    let width = rows.first().map_or(0, Vec::len);
    let all = Mat::from_fn(rows.len(), width, |row, column| rows[row][column]);
    if all.nrows() <= width {
        return all;
    }
    all.qr().thin_R().to_owned()
}
