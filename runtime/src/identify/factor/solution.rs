//! Which equations a factor can solve.

use super::Factor;
use crate::identify::least_squares::{Factors, Solution};
use crate::identify::{IdentifyError, Method, Weights};

impl Factor {
    /// The solution of a method with its weights, of the triangles of all blocks.
    ///
    /// # Errors
    /// [`IdentifyError::NotReduced`] for what asks more than sums over rows.
    pub(super) fn solution(
        &self,
        factors: &Factors,
        method: Method,
        weights: Weights,
    ) -> Result<Solution, IdentifyError> {
        let ones = vec![1.0; self.joints.len()];
        let refused = |why: String| Err(IdentifyError::NotReduced { why });
        match (method, weights) {
            (Method::Ls, _) => Ok(factors.ordinary(&ones)),
            (Method::Wls, Weights::Residual) => Ok(factors.weighted(&ones)),
            (Method::Wls, Weights::TorqueNorm) => Ok(factors.solve(&self.torque_norms(), &ones)),
            (Method::Wls, Weights::MaxTorque) => refused(
                "`max-torque` weighs by single samples, of which it has the sums of squares (`torque-norm`)"
                    .to_owned(),
            ),
            (Method::Ridge | Method::Physical, _) => refused(format!(
                "`{}` divides rows by how many samples are worth one, for which their order counts",
                method.name()
            )),
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
}
