//! Rows of a part of a log, reduced: all of them and, where joints with dry friction turn, those away from turns, so that estimates with
//! and without turns can be had of many logs, too.

use super::super::stack::Stack;
use super::super::{Identify, IdentifyError, check_logs, filtered, prepare_all, turns};
use super::rows::FactorRows;
use crate::columns::{Arm, MomentumArm};
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
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
pub struct FactorBlock {
    /// Samples per joint.
    pub samples: usize,
    /// All rows.
    pub whole: FactorRows,
    /// Rows without those around turns of joints with dry friction; none where these are all rows. In the filtered form those of a filter
    /// that starts anew behind each turn, which are others than the same rows of `whole` as far behind a turn as it remembers.
    pub away: Option<FactorRows>,
    /// Of each part that this block is made of the sum of all joints' squared torque, by which it is known again, ascending; of many parts
    /// the least ones, so that what two blocks have in common is among those of both.
    pub prints: Vec<f64>,
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
        let rows = Identify::default().rows(arm, &prepared, &[]);
        Ok(Self::cut(log, &rows, None))
    }

    /// The same in the filtered form, `L{tau} = Y_L beta` with `L(s) = w / (s + w)`; `corner` is `w` in rad/s, without it the end of the shared
    /// band. `L` starts where each piece's filters have settled, as in [`Identify::fit_filtered`] where those of a log have: both sides of the
    /// equation are zero there, so pieces approximate nothing.
    ///
    /// # Errors
    /// Those of [`Identify::fit_filtered`] for a log that does not fit the arm, the filters or the corner.
    ///
    /// # Examples
    /// ```
    /// # mod factor { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/factor.rs")); }
    /// # use factor::{bands, log, pendulum::pendulum};
    /// use robot_model::identify::{Factor, FactorBlock};
    /// let mut factor = Factor::filtered(&pendulum(), bands(), Some(60.0))?;
    /// factor.extend(FactorBlock::of_filtered_log(&pendulum(), &log(), &bands(), Some(60.0))?);
    /// assert!(factor.rmse(&[2.0, 9.0, 1.0])[0] < 0.03); // of filtered noise of 0.03 N m
    /// # Ok::<(), robot_model::identify::IdentifyError>(())
    /// ```
    pub fn of_filtered_log(
        arm: &dyn MomentumArm,
        log: &Log,
        bands: &Bands,
        corner: Option<f64>,
    ) -> Result<Vec<Self>, IdentifyError> {
        check_logs(arm, std::slice::from_ref(log))?;
        let (rows, anew) = filtered::rows(arm, log, bands, corner)?;
        Ok(Self::cut(log, &rows, anew.as_ref()))
    }

    /// A log's rows as blocks; `anew` are the same of a filter that starts anew behind each turn.
    fn cut(log: &Log, rows: &Stack, anew: Option<&Stack>) -> Vec<Self> {
        let samples = rows.samples();
        let second = (samples as f64 / log.seconds().max(1.0)).max(1.0);
        let count = whole_steps(samples as f64 / second).clamp(1, PARTS);
        let part = |part: usize| part * samples / count..(part + 1) * samples / count;
        let parts = (0..count).map(|k| {
            let of = |stack: &Stack| stack.part(part(k));
            Self::of(&of(rows), anew.map(of).as_ref())
        });
        parts.collect()
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
    /// assert_eq!((block.samples, block.whole.torque_squares[0]), (2, 100.0));
    /// let row = &block.whole.rows[0][0];
    /// assert!((row[0].abs() - 5.0).abs() < 1e-12 && (row[1] / row[0] - 2.0).abs() < 1e-12);
    /// ```
    #[must_use]
    pub fn of_rows(stack: &Stack) -> Self {
        Self::of(stack, None)
    }

    /// The same, and where `anew` is given and has others than `stack`, its rows as those away from turns.
    fn of(stack: &Stack, anew: Option<&Stack>) -> Self {
        let torque = stack.joints.iter().flat_map(|rows| &rows.tau);
        // Without any torque nothing tells it from others.
        let print = Some(torque.map(|tau| tau * tau).sum()).filter(|sum| *sum > 0.0);
        let at_turns = turns::are_at(stack);
        let is_away = |joint: usize, row: usize| !at_turns[joint][row];
        let has_turns = stack.turns.iter().any(|rows| !rows.is_empty());
        // Before the first turn both are the same.
        let (whole, away) = match anew.filter(|anew| *anew != stack) {
            Some(anew) => {
                let away = FactorRows::of(anew, &is_away);
                (FactorRows::of(stack, &|_, _| true), Some(away))
            }
            None if has_turns => {
                let away = FactorRows::of(stack, &is_away);
                let mut whole = away.clone();
                whole.add(FactorRows::of(stack, &|joint, row| !is_away(joint, row)));
                (whole, Some(away))
            }
            None => (FactorRows::of(stack, &|_, _| true), None),
        };
        Self {
            prints: print.into_iter().collect(),
            samples: stack.samples(),
            whole,
            away,
        }
    }

    /// Rows of a joint at its turns.
    pub(super) fn at_turns(&self, joint: usize) -> usize {
        let all = self.whole.counts[joint];
        let away = self.away.as_ref().map_or(all, |rows| rows.counts[joint]);
        all.saturating_sub(away)
    }

    /// The same without rows at turns.
    pub(super) fn without_turns(&self) -> Self {
        Self {
            samples: self.samples,
            prints: self.prints.clone(),
            whole: self.away.as_ref().unwrap_or(&self.whole).clone(),
            away: None,
        }
    }

    /// What follows becomes a part of this one.
    pub(super) fn add(&mut self, other: Self) {
        self.samples += other.samples;
        if self.away.is_some() || other.away.is_some() {
            let away = self.away.get_or_insert_with(|| self.whole.clone());
            away.add(other.away.unwrap_or_else(|| other.whole.clone()));
        }
        self.whole.add(other.whole);
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
