//! Which equations a factor can solve.

use super::Factor;
use crate::columns::Arm;
use crate::identify::least_squares::{Factors, Solution, check_counts, check_excited};
use crate::identify::{Identify, IdentifyError, Method, Possible, Weights};
use crate::identify::{possible, ridge, turns};

/// What a method makes of all blocks.
pub(super) struct Solved {
    pub solution: Solution,
    /// Unknowns that one block alone tells.
    pub lone: Vec<usize>,
    pub possible: Option<Possible>,
    /// Whether rows at turns move the solution further than what they tell is worth, see [`turns::widen`].
    pub is_surer_without_turns: bool,
}

impl Factor {
    /// The estimate of a method with its deviations; `away` are the same blocks without rows at turns, where there are some that count.
    pub(super) fn solved(
        &self,
        arm: &dyn Arm,
        identify: &Identify,
        away: Option<&Self>,
    ) -> Result<Solved, IdentifyError> {
        if identify.method == Method::Ridge {
            return self.near_nominal(arm, identify, away);
        }
        let (factors, mut solution) = self.told(identify)?;
        let worth = self.worth(&solution);
        let lone = self.deviations(&mut solution);
        let is_surer_without_turns = away.is_some_and(|away| {
            turns::widen(&factors, &away.whole(), &solution.scale, &mut solution.std)
        });
        let mut possible = None;
        if identify.method == Method::Physical {
            let percent = self.relative_percent(&solution.estimate);
            let found = possible::of_factors(arm, &mut solution, &factors, &worth, percent)?;
            possible = Some(found);
        }
        Ok(Solved {
            solution,
            lone,
            possible,
            is_surer_without_turns,
        })
    }

    /// The estimate toward nominal values, whose deviations are of logs and nominal values together.
    fn near_nominal(
        &self,
        arm: &dyn Arm,
        identify: &Identify,
        away: Option<&Self>,
    ) -> Result<Solved, IdentifyError> {
        let nominal = arm.nominal();
        let near = |used: &Self| -> Result<Solution, IdentifyError> {
            let (factors, mut solution) = used.told(identify)?;
            let worth = used.worth(&solution);
            let of_noise = used.beyond_worth(&solution, &factors, &worth);
            let logs = (&factors, worth.as_slice());
            ridge::of_factors(&nominal, identify.prior, &mut solution, logs, &of_noise)?;
            Ok(solution)
        };
        let mut solution = near(self)?;
        // Where other rows do not tell, deviations stay as they are.
        let is_surer_without_turns = away.map(near).is_some_and(|without| {
            let with = solution.clone();
            without.is_ok_and(|without| turns::widen_between(&with, &without, &mut solution.std))
        });
        Ok(Solved {
            solution,
            lone: Vec::new(),
            possible: None,
            is_surer_without_turns,
        })
    }

    /// The factor of all blocks and what least squares finds of it, which is enough and tells something.
    fn told(&self, identify: &Identify) -> Result<(Factors, Solution), IdentifyError> {
        let factors = self.whole();
        check_counts(&self.counts(), self.unknowns.len())?;
        let solution = self.solution(&factors, identify)?;
        check_excited(&solution)?;
        Ok((factors, solution))
    }

    /// The solution of least squares that a method has or starts from.
    ///
    /// # Errors
    /// [`IdentifyError::NotReduced`] for what asks more than sums over rows.
    fn solution(&self, factors: &Factors, identify: &Identify) -> Result<Solution, IdentifyError> {
        let ones = vec![1.0; self.joints.len()];
        let method = identify.method;
        let refused = |why: String| Err(IdentifyError::NotReduced { why });
        match (method, identify.weights) {
            (Method::Ls, _) => Ok(factors.ordinary(&ones)),
            (Method::Wls, Weights::Residual) | (Method::Ridge | Method::Physical, _) => {
                Ok(factors.weighted(&ones))
            }
            (Method::Wls, Weights::TorqueNorm) => Ok(factors.solve(&self.torque_norms(), &ones)),
            (Method::Wls, Weights::MaxTorque) => Ok(factors.solve(&self.most_torques(), &ones)),
            _ => refused(format!("`{}` weighs single samples", method.name())),
        }
    }

    /// Lengths of the joints' torques.
    fn torque_norms(&self) -> Vec<f64> {
        let joint = |joint: usize| {
            let blocks = self.blocks.iter();
            let squares = blocks.map(|block| block.whole.torque_squares[joint]);
            squares.sum::<f64>().sqrt()
        };
        (0..self.joints.len()).map(joint).collect()
    }

    /// The largest torque of each joint.
    fn most_torques(&self) -> Vec<f64> {
        let joint = |joint: usize| {
            let blocks = self.blocks.iter();
            blocks
                .map(|block| block.whole.most_torque[joint])
                .fold(0.0, f64::max)
        };
        (0..self.joints.len()).map(joint).collect()
    }
}
