//! What all blocks together say.

use super::Factor;
use super::block::FactorBlock;
use super::rows::reduced;
use super::solution::Solved;
use crate::columns::Arm;
use crate::identify::estimate::Estimate;
use crate::identify::fitted::Fitted;
use crate::identify::least_squares::Factors;
use crate::identify::stack::percent;
use crate::identify::{AtTurns, Identify, IdentifyError};

/// The blocks that are fitted, and how.
struct Chosen<'a> {
    used: &'a Factor,
    solved: Solved,
    is_without_turns: bool,
}

impl Factor {
    /// The factor of all blocks, joint by joint.
    pub(super) fn whole(&self) -> Factors {
        let joints = (0..self.joints.len()).map(|joint| {
            let blocks = self.blocks.iter();
            let rows = blocks.flat_map(|block| block.whole.rows[joint].iter().cloned());
            reduced(&rows.collect::<Vec<_>>())
        });
        Factors::from_joints(self.unknowns.len(), self.counts(), joints.collect())
    }

    /// The same without rows at turns.
    pub(super) fn without_turns(&self) -> Self {
        let blocks = self.blocks.iter().map(FactorBlock::without_turns);
        Self {
            unknowns: self.unknowns.clone(),
            joints: self.joints.clone(),
            equations: self.equations.clone(),
            form: self.form,
            bands: self.bands,
            blocks: blocks.collect(),
        }
    }

    /// Rows of each joint at its turns.
    pub(super) fn turns(&self) -> Vec<usize> {
        let blocks = self.blocks.iter();
        let joint = |joint: usize| blocks.clone().map(|block| block.at_turns(joint)).sum();
        (0..self.joints.len()).map(joint).collect()
    }

    /// What all these logs together say, by [`Method::Ls`](crate::identify::Method::Ls), `Wls`, `Ridge` or `Physical`; of `identify` the
    /// method, its weights, the prior and [`Identify::at_turns`] are read. In the filtered form rows at turns move the estimate by as much as
    /// a filter does that starts anew behind each turn.
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
        let method = identify.method;
        let own = Self::new(arm, self.bands)?;
        Self {
            form: self.form,
            ..own
        }
        .check(self)?;
        let has_turns = self.blocks.iter().any(|block| block.away.is_some());
        let away = has_turns.then(|| self.without_turns());
        if self.blocks.is_empty() {
            return Err(IdentifyError::NoLog);
        }
        let Chosen {
            used,
            solved,
            is_without_turns,
        } = self.chosen(arm, identify, away.as_ref())?;
        let Solved {
            solution,
            lone,
            possible,
            ..
        } = solved;
        let fitted = Fitted {
            relative_percent: used.relative_percent(&solution.estimate),
            samples: self.samples(),
            turns: self.turns(),
            clipped: Vec::new(),
            held: Vec::new(),
            effective_samples: None,
            names: self.unknowns.clone(),
        };
        let (form, bands) = (self.form, self.bands);
        let estimate = Estimate::new(arm, method, form, bands, &solution, Vec::new(), fitted);
        Ok(Estimate {
            blocks: Some(used.blocks.len()),
            of_one_block: lone.iter().map(|&k| self.unknowns[k].clone()).collect(),
            is_without_turns,
            possible,
            ..estimate
        })
    }

    /// The blocks that are fitted, of all and of those `away` from turns.
    fn chosen<'a>(
        &'a self,
        arm: &dyn Arm,
        identify: &Identify,
        away: Option<&'a Self>,
    ) -> Result<Chosen<'a>, IdentifyError> {
        let without = |used| -> Result<Chosen<'a>, IdentifyError> {
            Ok(Chosen {
                used,
                solved: used.solved(arm, identify, None)?,
                is_without_turns: true,
            })
        };
        if identify.leaves_out_turns() {
            return without(away.unwrap_or(self));
        }
        let solved = self.solved(arm, identify, away)?;
        let surer = away.filter(|_| solved.is_surer_without_turns);
        match surer.filter(|_| identify.at_turns == AtTurns::Judged) {
            Some(away) => without(away),
            None => Ok(Chosen {
                used: self,
                solved,
                is_without_turns: false,
            }),
        }
    }

    /// Sum of squared residuals of a joint.
    fn squares(&self, joint: usize, estimate: &[f64]) -> f64 {
        let rows = self.blocks.iter();
        let rows = rows.flat_map(|block| &block.whole.rows[joint]);
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

    pub(super) fn relative_percent(&self, estimate: &[f64]) -> Vec<f64> {
        let joints = 0..self.joints.len();
        let of = |joint: usize| {
            let blocks = self.blocks.iter();
            let torque: f64 = blocks.map(|block| block.whole.torque_squares[joint]).sum();
            percent(self.squares(joint, estimate).sqrt(), torque.sqrt())
        };
        joints.map(of).collect()
    }
}

/// `target - columns * estimate` of a reduced row.
pub(super) fn residual(row: &[f64], estimate: &[f64]) -> f64 {
    let fitted: f64 = row.iter().zip(estimate).map(|(x, beta)| x * beta).sum();
    row[estimate.len()] - fitted
}
