//! What logs tell, in a size that does not grow with them: triangular factors that are updated and merged.
//!
//! Rows `[W_j tau_j]` of each joint are reduced to a factor `R_j` with `R_j'R_j = [W_j tau_j]'[W_j tau_j]`, block after block of a log; two factors
//! below each other are reduced to that of both (TSQR). Least squares and weights need no more. A factor keeps 16 to 32 blocks apart: their
//! own equations, `s_b = sum_j W_bj'(tau_bj - W_bj beta) / sigma_j^2`, say how far an estimate is off, as far as noise is not correlated
//! beyond a block. Rows around turns of joints with dry friction have factors of their own beside the others, so that it is known what
//! they move an estimate by.
//!
//! Sources: Golub, Van Loan, Matrix Computations, on updating; Demmel, Grigori, Hoemmen, Langou 2012, Communication-optimal parallel and
//! sequential QR; MacKinnon, Nielsen, Webb 2023 for deviations from blocks.

use super::estimate::{Estimate, Form};
use super::fitted::Fitted;
use super::least_squares::Factors;
use super::stack::{Stack, percent};
use super::{Identify, IdentifyError};
use crate::columns::Arm;
use crate::log::Log;
use crate::signal::Bands;

mod block;
mod deviations;
mod equations;
mod solution;
mod worth;

use block::reduced;
pub use block::{FactorBlock, FactorRows};
use solution::Solved;

/// Blocks that are kept apart, at most.
const MOST_BLOCKS: usize = 32;

/// What some logs tell of an arm's unknowns.
///
/// # Examples
/// Logs that come one after the other, and are not kept:
/// ```
/// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
/// # use pendulum::{measure, pendulum};
/// use robot_model::identify::{Factor, Identify};
/// let (arm, log) = (pendulum(), measure(0.0));
/// let bands = Identify::default().bands_of(&arm, &log)?;
/// let mut factor = Factor::new(&arm, bands)?;
/// factor.push(&arm, &log)?;
/// let estimate = factor.estimate(&arm, &Identify::default())?;
/// assert!((estimate.values()[0] - 2.0).abs() < 0.02);
/// # Ok::<(), robot_model::identify::IdentifyError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Factor {
    /// Names of the unknowns, one a column.
    pub unknowns: Vec<String>,
    /// Names of the joints.
    pub joints: Vec<String>,
    /// What the columns are made of, as sums along a motion that is always the same: they tell arms with unknowns of the same names apart.
    pub equations: Vec<[f64; 2]>,
    /// Filters of the rows.
    pub bands: Bands,
    /// Blocks of the logs, in their order.
    pub blocks: Vec<FactorBlock>,
}

impl Factor {
    /// Fewer blocks say little of how sure a parameter is; deviations from fewer are no smaller than those of white noise.
    pub const ENOUGH_BLOCKS: usize = 8;

    /// One of no log, with these filters.
    ///
    /// # Errors
    /// [`IdentifyError::NotReduced`] where columns depend on more than the motion: open shapes, the load.
    ///
    /// # Examples
    /// ```
    /// # mod factor { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/factor.rs")); }
    /// # use factor::{bands, pendulum::pendulum};
    /// let empty = robot_model::identify::Factor::new(&pendulum(), bands())?;
    /// assert_eq!((empty.unknowns[0].as_str(), empty.samples()), ("link.izz", 0));
    /// # Ok::<(), robot_model::identify::IdentifyError>(())
    /// ```
    pub fn new(arm: &dyn Arm, bands: Bands) -> Result<Self, IdentifyError> {
        let why = if let Some(shape) = arm.shapes().first() {
            Some(format!("the shape `{}` has no value", shape.name))
        } else if arm.uses_rigid_torque() {
            Some("an effect of the spec depends on the load".to_owned())
        } else {
            None
        };
        if let Some(why) = why {
            return Err(IdentifyError::NotReduced { why });
        }
        let unknowns = arm.unknowns().iter();
        Ok(Self {
            unknowns: unknowns.map(|unknown| unknown.name.clone()).collect(),
            joints: arm.joints().to_vec(),
            equations: equations::of(arm),
            bands,
            blocks: Vec::new(),
        })
    }

    /// Adds a log, or a piece of one, as blocks of a second or more.
    ///
    /// # Errors
    /// Those of [`FactorBlock::of_log`].
    ///
    /// # Examples
    /// ```
    /// # mod factor { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/factor.rs")); }
    /// # use factor::{factor, log, pendulum::pendulum};
    /// let mut twice = factor();
    /// twice.push(&pendulum(), &log())?;
    /// assert_eq!(twice.samples(), 2 * factor().samples());
    /// # Ok::<(), robot_model::identify::IdentifyError>(())
    /// ```
    pub fn push(&mut self, arm: &dyn Arm, log: &Log) -> Result<(), IdentifyError> {
        self.extend(FactorBlock::of_log(arm, log, &self.bands)?);
        Ok(())
    }

    /// Adds blocks of [`FactorBlock::of_log`] with the same arm and filters.
    ///
    /// # Examples
    /// ```
    /// # mod factor { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/factor.rs")); }
    /// # use factor::{bands, factor, log, pendulum::pendulum};
    /// use robot_model::identify::{Factor, FactorBlock};
    /// let mut extended = Factor::new(&pendulum(), bands())?;
    /// extended.extend(FactorBlock::of_log(&pendulum(), &log(), &bands())?);
    /// assert_eq!(extended, factor());
    /// # Ok::<(), robot_model::identify::IdentifyError>(())
    /// ```
    pub fn extend(&mut self, blocks: impl IntoIterator<Item = FactorBlock>) {
        for block in blocks {
            self.blocks.push(block);
            self.shorten();
        }
    }

    /// Adds rows as a block of their own.
    ///
    /// # Examples
    /// ```
    /// # mod factor { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/factor.rs")); }
    /// # use factor::{bands, log, pendulum::pendulum};
    /// use robot_model::{identify::{Factor, Stack}, signal::prepare};
    /// let rows = Stack::new(&pendulum(), &[prepare(&log(), &bands()).expect("a long log")], &[]);
    /// let mut factor = Factor::new(&pendulum(), bands())?;
    /// factor.push_rows(&rows);
    /// assert_eq!((factor.blocks.len(), factor.samples()), (1, rows.samples()));
    /// # Ok::<(), robot_model::identify::IdentifyError>(())
    /// ```
    pub fn push_rows(&mut self, stack: &Stack) {
        self.extend([FactorBlock::of_rows(stack)]);
    }

    /// Adds what other logs tell of the same arm.
    ///
    /// # Errors
    /// [`IdentifyError::OtherFactor`] where it is of other unknowns, joints, equations or filters.
    ///
    /// # Examples
    /// ```
    /// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
    /// # use pendulum::{measure, pendulum};
    /// # use robot_model::identify::{Factor, Identify};
    /// let arm = pendulum();
    /// let bands = Identify::default().bands_of(&arm, &measure(0.0))?;
    /// let [mut monday, mut tuesday] = [Factor::new(&arm, bands)?, Factor::new(&arm, bands)?];
    /// monday.push(&arm, &measure(0.0))?;
    /// tuesday.push(&arm, &measure(0.1))?;
    /// assert_eq!(monday.common_parts(&tuesday), 0); // so no log counts twice
    /// let samples = monday.samples() + tuesday.samples();
    /// monday.merge(tuesday)?;
    /// assert_eq!(monday.samples(), samples);
    /// # Ok::<(), robot_model::identify::IdentifyError>(())
    /// ```
    pub fn merge(&mut self, other: Self) -> Result<(), IdentifyError> {
        self.check(&other)?;
        self.blocks.extend(other.blocks);
        self.shorten();
        Ok(())
    }

    /// That another factor is of the same arm and filters.
    fn check(&self, other: &Self) -> Result<(), IdentifyError> {
        let what = if other.joints != self.joints {
            Some("joints".to_owned())
        } else if other.unknowns != self.unknowns {
            Some("unknowns".to_owned())
        } else if !equations::are_alike(&other.equations, &self.equations) {
            Some(equations::OTHER.to_owned())
        } else if other.bands != self.bands {
            let (own, others) = (self.bands, other.bands);
            Some(format!("filters ({others}, where {own} are wanted)"))
        } else {
            None
        };
        match what {
            Some(what) => Err(IdentifyError::OtherFactor { what }),
            None => Ok(()),
        }
    }

    /// Parts of logs that another factor has, too: what they say would count twice. Of many parts some stand for all of them.
    ///
    /// # Examples
    /// ```
    /// # mod factor { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/factor.rs")); }
    /// let factor = factor::factor();
    /// assert_eq!(factor.common_parts(&factor), factor.blocks.len()); // all of it
    /// ```
    #[must_use]
    pub fn common_parts(&self, other: &Self) -> usize {
        let prints = |factor: &Self| -> Vec<f64> {
            let blocks = factor.blocks.iter();
            let mut prints: Vec<f64> = blocks.flat_map(|block| block.prints.clone()).collect();
            prints.sort_unstable_by(f64::total_cmp);
            prints
        };
        block::common(&prints(self), &prints(other))
    }

    /// Samples per joint.
    ///
    /// # Examples
    /// ```
    /// # mod factor { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/factor.rs")); }
    /// let filter = robot_model::signal::SharedFilter::new(&factor::bands(), 500.0).expect("a low band");
    /// assert_eq!(factor::factor().samples(), filter.kept(10_000).count()); // of 20 s
    /// ```
    #[must_use]
    pub fn samples(&self) -> usize {
        self.blocks.iter().map(|block| block.samples).sum()
    }

    /// Rows of each joint that say something.
    ///
    /// # Examples
    /// ```
    /// # mod factor { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/factor.rs")); }
    /// let factor = factor::factor();
    /// assert_eq!(factor.counts(), [factor.samples()]); // one joint, all of whose rows say something
    /// ```
    #[must_use]
    pub fn counts(&self) -> Vec<usize> {
        let joint = |joint: usize| self.blocks.iter().map(|block| block.count(joint)).sum();
        (0..self.joints.len()).map(joint).collect()
    }

    /// Merges neighbors while there are too many blocks: the shortest pair first, so that blocks stay about alike.
    fn shorten(&mut self) {
        while self.blocks.len() > MOST_BLOCKS {
            let pairs = self.blocks.windows(2).enumerate();
            let shortest = pairs.min_by_key(|(_, pair)| pair[0].samples + pair[1].samples);
            let Some((k, _)) = shortest else { return };
            let other = self.blocks.remove(k + 1);
            self.blocks[k].add(other);
        }
    }

    /// The factor of all blocks, joint by joint.
    fn whole(&self) -> Factors {
        let joints = (0..self.joints.len()).map(|joint| {
            let blocks = self.blocks.iter();
            let rows: Vec<Vec<f64>> = blocks
                .flat_map(|block| block.rows(joint))
                .cloned()
                .collect();
            reduced(&rows)
        });
        Factors::from_joints(self.unknowns.len(), self.counts(), joints.collect())
    }

    /// The same without rows at turns.
    fn without_turns(&self) -> Self {
        let blocks = self.blocks.iter().map(FactorBlock::without_turns);
        Self {
            unknowns: self.unknowns.clone(),
            joints: self.joints.clone(),
            equations: self.equations.clone(),
            bands: self.bands,
            blocks: blocks.collect(),
        }
    }

    /// Rows of each joint at its turns.
    fn turns(&self) -> Vec<usize> {
        let blocks = || self.blocks.iter();
        let joint = |joint: usize| blocks().map(|block| block.at_turns.counts[joint]).sum();
        (0..self.joints.len()).map(joint).collect()
    }

    /// What all these logs together say, by [`Method::Ls`](super::Method::Ls), `Wls`, `Ridge` or `Physical`; of `identify` the
    /// method, its weights, the prior and [`Identify::leave_out_turns`] are read. Without the latter, by how much rows at turns move the
    /// estimate is in its deviations.
    ///
    /// # Errors
    /// [`IdentifyError::OtherFactor`] for another arm, [`IdentifyError::NotReduced`] for what needs the rows themselves,
    /// [`IdentifyError::NoLog`], [`IdentifyError::TooFewSamples`], [`IdentifyError::NothingExcited`]; those of the method.
    ///
    /// # Examples
    /// ```
    /// # mod factor { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/factor.rs")); }
    /// use robot_model::identify::{Identify, Method, Weights};
    /// let (arm, factor) = (factor::pendulum::pendulum(), factor::factor());
    /// let by_torque = Identify { weights: Weights::TorqueNorm, ..Identify::default() };
    /// assert!((factor.estimate(&arm, &by_torque)?.values()[1] - 9.0).abs() < 0.1);
    /// let robust = Identify { method: Method::Robust, ..Identify::default() };
    /// let refused = factor.estimate(&arm, &robust).unwrap_err();
    /// assert!(refused.to_string().contains("`robust` weighs single samples"));
    /// # Ok::<(), robot_model::identify::IdentifyError>(())
    /// ```
    pub fn estimate(&self, arm: &dyn Arm, identify: &Identify) -> Result<Estimate, IdentifyError> {
        let (method, leave_out_turns) = (identify.method, identify.leave_out_turns);
        Self::new(arm, self.bands)?.check(self)?;
        let at_turns = self.turns();
        let has_turns = at_turns.iter().any(|count| *count > 0);
        let away = has_turns.then(|| self.without_turns());
        let used = away.as_ref().filter(|_| leave_out_turns).unwrap_or(self);
        if self.blocks.is_empty() {
            return Err(IdentifyError::NoLog);
        }
        let widened_by = away.as_ref().filter(|_| !leave_out_turns);
        let Solved {
            solution,
            lone,
            possible,
        } = used.solved(arm, identify, widened_by)?;
        let fitted = Fitted {
            relative_percent: used.relative_percent(&solution.estimate),
            samples: self.samples(),
            turns: at_turns,
            clipped: Vec::new(),
            held: Vec::new(),
            effective_samples: None,
            names: self.unknowns.clone(),
        };
        let form = Form::Acceleration;
        let estimate = Estimate::new(arm, method, form, self.bands, &solution, Vec::new(), fitted);
        Ok(Estimate {
            blocks: Some(used.blocks.len()),
            of_one_block: lone.iter().map(|&k| self.unknowns[k].clone()).collect(),
            is_without_turns: leave_out_turns,
            possible,
            ..estimate
        })
    }

    /// Sum of squared residuals of a joint.
    fn squares(&self, joint: usize, estimate: &[f64]) -> f64 {
        let rows = self.blocks.iter().flat_map(|block| block.rows(joint));
        rows.map(|row| residual(row, estimate).powi(2)).sum()
    }

    /// Root of the mean squared residual per joint, of filtered torque.
    ///
    /// # Examples
    /// ```
    /// # mod factor { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/factor.rs")); }
    /// // The noise of the log is of 0.03 N m, before the filter.
    /// assert!(factor::factor().rmse(&[2.0, 9.0, 1.0])[0] < 0.03);
    /// assert!(factor::factor().rmse(&[2.0, 0.0, 1.0])[0] > 1.0);
    /// ```
    #[must_use]
    pub fn rmse(&self, estimate: &[f64]) -> Vec<f64> {
        let counts = self.counts().into_iter().enumerate();
        let of = |(joint, count): (usize, usize)| {
            (self.squares(joint, estimate) / count.max(1) as f64).sqrt()
        };
        counts.map(of).collect()
    }

    fn relative_percent(&self, estimate: &[f64]) -> Vec<f64> {
        let joints = 0..self.joints.len();
        let of = |joint: usize| {
            let blocks = self.blocks.iter();
            let torque: f64 = blocks.map(|block| block.torque_squares(joint)).sum();
            percent(self.squares(joint, estimate).sqrt(), torque.sqrt())
        };
        joints.map(of).collect()
    }
}

/// `target - columns * estimate` of a reduced row.
fn residual(row: &[f64], estimate: &[f64]) -> f64 {
    let fitted: f64 = row.iter().zip(estimate).map(|(x, beta)| x * beta).sum();
    row[estimate.len()] - fitted
}

#[cfg(test)]
mod tests;
