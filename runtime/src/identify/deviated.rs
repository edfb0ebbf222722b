//! Deviations of a solution of least squares, its shapes' too.

use super::least_squares::{Factors, Solution};
use super::stack::Stack;
use super::{
    Beyond, Bootstrap, Identify, IdentifyError, Method, bootstrap, hac, robust, shapes, slope,
    turns,
};
use crate::columns::Arm;
use crate::signal::Prepared;

/// Standard deviations to either side of a value that make its 95 % interval: the 97.5 % point of the normal distribution.
pub const Z_95: f64 = 1.96;

/// A solution with its deviations.
pub(super) struct Solved {
    pub solution: Solution,
    pub shapes: Vec<f64>,
    pub shape_std: Vec<Option<f64>>,
    /// What the shapes add to the deviations of linear unknowns, for methods that know of these alone; nothing where there are none.
    pub of_shapes: Vec<f64>,
    pub stack: Stack,
    /// Whether rows at turns move the solution further than what they tell is worth, see [`turns::widen`].
    pub is_surer_without_turns: bool,
}

/// Standard deviations, and whether they would be smaller without rows at turns.
#[derive(Default)]
struct Widened {
    std: Vec<f64>,
    is_surer_without_turns: bool,
}

impl Solution {
    /// Standard deviation of each joint's residual, times the root of how many of its correlated samples are worth one: rows over it say as
    /// much as they do of white noise.
    pub(super) fn worth(&self, stack: &Stack) -> Vec<f64> {
        let times = stack.correlation_times(&stack.residuals(&self.estimate));
        let pairs = times.iter().zip(&self.sigma);
        pairs.map(|(time, sigma)| sigma * time.sqrt()).collect()
    }
}

impl Identify {
    /// A solution with its deviations and those of shapes, which the former have a share of.
    pub(super) fn deviated(
        &self,
        arm: &dyn Arm,
        logs: &[Prepared],
        (mut solution, shapes, stack): (Solution, Vec<f64>, Stack),
    ) -> Solved {
        let linear = solution.estimate.len();
        let is_rough = self.beyond < Beyond::Deviations;
        // Values that are given are no estimates.
        if shapes.is_empty() || self.shapes.is_some() || is_rough {
            let mut is_surer_without_turns = false;
            if !is_rough {
                let widened = self.widened(&stack, &solution, hac::deviations);
                solution.std = widened.std;
                is_surer_without_turns = widened.is_surer_without_turns;
            }
            return Solved {
                solution,
                shape_std: vec![None; shapes.len()],
                shapes,
                of_shapes: Vec::new(),
                stack,
                is_surer_without_turns,
            };
        }
        let whole = shapes::with_slopes(
            arm,
            &|shapes| self.rows(arm, logs, shapes),
            &shapes,
            0..shapes.len(),
            stack,
            &solution.estimate,
            slope::across_jumps,
        );
        let told = self.beside_slopes(&whole, &solution);
        let mut stack = whole;
        stack.truncate(linear);
        let mut of_shapes = Vec::new();
        let lost = (0..linear).any(|k| told[k].is_none() && !solution.unexcited.contains(&k));
        let Widened {
            std: alone,
            is_surer_without_turns,
        } = self.widened(&stack, &solution, hac::deviations);
        let shape_std = if lost {
            // A shape does what a linear unknown does: beside it nothing is known of either.
            solution.std = alone;
            vec![None; shapes.len()]
        } else {
            let std = told[..linear].iter();
            solution.std = std.map(|std| std.unwrap_or(0.0)).collect();
            let pairs = solution.std.iter().zip(&alone);
            let beyond = |(with, alone): (&f64, &f64)| (with.powi(2) - alone.powi(2)).max(0.0);
            of_shapes = pairs.map(beyond).map(f64::sqrt).collect();
            told[linear..].to_vec()
        };
        Solved {
            solution,
            shapes,
            shape_std,
            of_shapes,
            stack,
            is_surer_without_turns,
        }
    }

    /// Standard deviations of a solution with further columns, slopes of its torque by shapes, beside its own; none of what the logs do not
    /// tell from others with all of them. Shapes stay where they were found.
    pub(crate) fn beside_slopes(&self, whole: &Stack, solution: &Solution) -> Vec<Option<f64>> {
        let joint = joint(whole, solution);
        told(&joint, solution, &|with| self.deviations(whole, with))
    }

    /// The same, and none of what stands for a sum with others either: its value is that with the others at zero.
    pub(crate) fn apart_beside_slopes(
        &self,
        whole: &Stack,
        solution: &Solution,
    ) -> Vec<Option<f64>> {
        let joint = joint(whole, solution);
        let mut std = told(&joint, solution, &|with| self.deviations(whole, with));
        for shared in &joint.shared {
            std[shared.lead] = None;
        }
        std
    }

    /// The same, of noise alone: what rows at turns move values by is no part of them.
    pub(crate) fn of_noise_beside_slopes(
        &self,
        whole: &Stack,
        solution: &Solution,
    ) -> Vec<Option<f64>> {
        let of_noise =
            |with: &Solution| hac::deviations(whole, with, &self.row_weights(whole, with));
        told(&joint(whole, solution), solution, &of_noise)
    }

    /// Standard deviations of a solution of least squares; see [`hac`]. What rows at turns move it by is a part of them.
    pub(super) fn deviations(&self, stack: &Stack, solution: &Solution) -> Vec<f64> {
        self.widened(stack, solution, hac::deviations).std
    }

    /// Those whose residual is no noise all along, as it follows what is looked for: of the products with columns alone.
    pub(super) fn deviations_of_products(&self, stack: &Stack, solution: &Solution) -> Vec<f64> {
        self.widened(stack, solution, hac::deviations_of_products)
            .std
    }

    fn widened(
        &self,
        stack: &Stack,
        solution: &Solution,
        deviations: fn(&Stack, &Solution, &[Vec<f64>]) -> Vec<f64>,
    ) -> Widened {
        let weights = self.row_weights(stack, solution);
        let mut std = deviations(stack, solution, &weights);
        let is_surer_without_turns = self.has_turns(stack) && {
            let [all, away] = turns::with_and_without(stack, &weights);
            turns::widen(&all, &away, &solution.scale, &mut std)
        };
        Widened {
            std,
            is_surer_without_turns,
        }
    }

    /// Another solution in the place of one of least squares; what rows at turns move it by is a part of its deviations.
    pub(super) fn widened_by(
        &self,
        solution: &mut Solution,
        stack: &Stack,
        make: &dyn Fn(&mut Solution, &Stack) -> Result<(), IdentifyError>,
    ) -> Result<(), IdentifyError> {
        make(solution, stack)?;
        if self.has_turns(stack) {
            let mut rest = stack.clone();
            turns::leave_out(&mut rest);
            // Where other rows do not tell, deviations stay as they are.
            let without = self.solve_stack(&rest).and_then(|mut without| {
                make(&mut without, &rest)?;
                Ok(without)
            });
            if let Ok(without) = without {
                let with = solution.clone();
                turns::widen_between(&with, &without, &mut solution.std);
            }
        }
        Ok(())
    }

    /// Whether rows at turns are in estimates.
    pub(super) fn has_turns(&self, stack: &Stack) -> bool {
        !self.leaves_out_turns() && stack.turns.iter().any(|rows| !rows.is_empty())
    }

    /// Intervals from blocks that are drawn, where they are wanted; what rows at turns move estimates by widens them as it does deviations.
    pub(super) fn draw(
        &self,
        stack: &Stack,
        solution: &Solution,
    ) -> Result<Option<Bootstrap>, IdentifyError> {
        if self.bootstrap == 0 {
            return Ok(None);
        }
        let weights = self.row_weights(stack, solution);
        let mut found = bootstrap::intervals(stack, solution, &weights, self.bootstrap)?;
        if self.has_turns(stack) {
            let noise = hac::deviations(stack, solution, &weights);
            let mut widened = noise.clone();
            let [all, away] = turns::with_and_without(stack, &weights);
            turns::widen(&all, &away, &solution.scale, &mut widened);
            found.widen(&solution.estimate, &noise, &widened);
        }
        Ok(Some(found))
    }

    fn row_weights(&self, stack: &Stack, solution: &Solution) -> Vec<Vec<f64>> {
        match self.method {
            Method::Robust => robust::weights(stack, &solution.estimate),
            _ => robust::of_all(stack),
        }
    }
}

/// What rows tell of unknowns with further columns, at a solution's weights.
fn joint(whole: &Stack, solution: &Solution) -> Solution {
    Factors::new(whole).solve(&solution.scale, &vec![1.0; whole.dof()])
}

/// Deviations of a solution with further columns that stay where they are; none of what the rows do not tell.
fn told(
    joint: &Solution,
    solution: &Solution,
    deviations: &dyn Fn(&Solution) -> Vec<f64>,
) -> Vec<Option<f64>> {
    let mut with_shapes = solution.clone();
    with_shapes.estimate.resize(joint.estimate.len(), 0.0);
    with_shapes.unexcited.clone_from(&joint.unexcited);
    let std = deviations(&with_shapes);
    let is_told = |k: &usize| !joint.unexcited.contains(k);
    (0..std.len())
        .map(|k| is_told(&k).then_some(std[k]))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::columns::Unknown;
    use crate::identify::JointRows;

    /// `a x + b y + c (x + y)`, `d z`: of three unknowns two sums are told, and none alone.
    #[test]
    fn what_stands_for_a_sum_is_not_told_alone() {
        const ROWS: i32 = 400;
        let waves = [0.11, 0.23, 0.37]
            .map(|rate| -> Vec<f64> { (0..ROWS).map(|k| (rate * f64::from(k)).sin()).collect() });
        let [x, y, z] = &waves;
        let sum: Vec<f64> = x.iter().zip(y).map(|(x, y)| x + y).collect();
        let noise = |k: usize| 0.01 * (k as f64 * 2.9).cos();
        let terms = sum.iter().zip(z).enumerate();
        let tau: Vec<f64> = terms
            .map(|(k, (sum, z))| 2.0 * sum + z + noise(k))
            .collect();
        let stack = Stack {
            unknowns: ["a", "b", "c", "d"]
                .map(|name| Unknown {
                    name: name.to_owned(),
                    nonnegative: false,
                })
                .to_vec(),
            joints: vec![JointRows {
                tau: tau.clone(),
                target: tau,
                columns: [x, y, &sum, z].into_iter().cloned().enumerate().collect(),
            }],
            ..Stack::default()
        };
        let solution = Factors::new(&stack).ordinary(&[1.0]);
        let identify = Identify::default();
        let beside = identify.beside_slopes(&stack, &solution);
        assert_eq!(beside.iter().filter(|std| std.is_none()).count(), 1);
        let apart = identify.apart_beside_slopes(&stack, &solution);
        let is_told: Vec<bool> = apart.iter().map(Option::is_some).collect();
        assert_eq!(is_told, [false, false, false, true]);
        assert_eq!(apart[3], beside[3]);
    }
}
