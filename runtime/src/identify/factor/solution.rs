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
}

impl Factor {
    /// The estimate of a method with its deviations; `away` are the same blocks without rows at turns, where there are some that count.
    pub(super) fn solved(
        &self,
        arm: &dyn Arm,
        identify: &Identify,
        away: Option<&Self>,
    ) -> Result<Solved, IdentifyError> {
        let factors = self.whole();
        check_counts(&self.counts(), self.unknowns.len())?;
        let mut solution = self.solution(&factors, identify)?;
        check_excited(&solution)?;
        let mut possible = None;
        if identify.method == Method::Ridge {
            let toward_cad = |used: &Self, solution: &mut Solution, factors: &Factors| {
                let worth = used.worth(solution);
                let of_noise = used.beyond_worth(solution, factors, &worth);
                let logs = (factors, worth.as_slice());
                ridge::of_factors(&arm.nominal(), identify.prior, solution, logs, &of_noise)
            };
            toward_cad(self, &mut solution, &factors)?;
            if let Some(away) = away {
                let factors = away.whole();
                let mut without = away.solution(&factors, identify)?;
                toward_cad(away, &mut without, &factors)?;
                let with = solution.clone();
                turns::widen_between(&with, &without, &mut solution.std);
            }
            return Ok(Solved {
                solution,
                lone: Vec::new(),
                possible,
            });
        }
        let worth = self.worth(&solution);
        let lone = self.deviations(&mut solution);
        if let Some(away) = away {
            turns::widen(&factors, &away.whole(), &solution.scale, &mut solution.std);
        }
        if identify.method == Method::Physical {
            let percent = self.relative_percent(&solution.estimate);
            possible = Some(possible::of_factors(
                arm,
                &mut solution,
                &factors,
                &worth,
                percent,
            )?);
        }
        Ok(Solved {
            solution,
            lone,
            possible,
        })
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
            let squares = blocks.map(|block| block.torque_squares(joint));
            squares.sum::<f64>().sqrt()
        };
        (0..self.joints.len()).map(joint).collect()
    }

    /// The largest torque of each joint.
    fn most_torques(&self) -> Vec<f64> {
        let joint = |joint: usize| {
            let blocks = self.blocks.iter();
            let parts = blocks.flat_map(|block| [&block.away, &block.at_turns]);
            parts
                .map(|rows| rows.most_torque[joint])
                .fold(0.0, f64::max)
        };
        (0..self.joints.len()).map(joint).collect()
    }
}
