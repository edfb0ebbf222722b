//! How many samples of a log count as one, from its blocks.

use faer::Mat;

use super::{Factor, FactorRows};
use crate::identify::least_squares::{Factors, Solution};

impl Factor {
    /// What rows of each joint are divided by so that what they say is as sure as independent samples would make it: `sigma_j sqrt(t_j)`.
    ///
    /// A block's residual has a part in the space of its columns, which is all that moves parameters. Its squared length is `sigma_j^2` a
    /// column where noise is white, and `t_j` times that where so many neighbors share it; the fit to all blocks takes its unknowns off that.
    /// Where blocks have no more columns than there are unknowns in all, nothing is known of it, and noise counts as white.
    pub(super) fn worth(&self, solution: &Solution) -> Vec<f64> {
        let counts = self.counts();
        let all = counts.iter().sum::<usize>().max(1) as f64;
        let rank = (self.unknowns.len() - solution.unexcited.len()) as f64;
        let joints = solution.sigma.iter().zip(&counts).enumerate();
        let of = |(joint, (sigma, count)): (usize, (&f64, &usize))| {
            let (mut squares, mut columns) = (0.0, 0.0);
            for block in &self.blocks {
                let (square, count) = block.whole.within_columns(joint, &solution.estimate);
                squares += square;
                columns += count as f64;
            }
            let freedom = columns - rank * *count as f64 / all;
            let time = if freedom < 1.0 {
                1.0
            } else {
                squares / (freedom * sigma * sigma)
            };
            sigma * time.max(1.0).sqrt()
        };
        joints.map(of).collect()
    }

    /// By how many times the variance that estimates without each block tell is larger than that of samples that are worth so much, unknown
    /// by unknown: what is slow shares its noise with more neighbors than what is fast.
    pub(super) fn beyond_worth(
        &self,
        solution: &Solution,
        factors: &Factors,
        worth: &[f64],
    ) -> Vec<f64> {
        let pairs = worth.iter().zip(&solution.sigma);
        let times: Vec<f64> = pairs
            .map(|(worth, sigma)| (worth / sigma).powi(2))
            .collect();
        let of_worth = factors.solve(worth, &times).std;
        let mut of_blocks = solution.clone();
        self.deviations(&mut of_blocks);
        let pairs = of_blocks.std.iter().zip(&of_worth);
        let ratio = |(blocks, worth): (&f64, &f64)| {
            if *worth > 0.0 {
                (blocks / worth).powi(2).max(1.0)
            } else {
                1.0
            }
        };
        pairs.map(ratio).collect()
    }
}

impl FactorRows {
    /// Squared length of a joint's residual in the space of its columns, and how many these are.
    fn within_columns(&self, joint: usize, estimate: &[f64]) -> (f64, usize) {
        let rows = &self.rows[joint];
        let is_active = |c: &usize| rows.iter().any(|row| row[*c] != 0.0);
        let active: Vec<usize> = (0..estimate.len()).filter(is_active).collect();
        let (width, target) = (active.len(), estimate.len());
        let whole = Mat::from_fn(rows.len(), width + 1, |row, k| {
            rows[row][active.get(k).copied().unwrap_or(target)]
        });
        if whole.nrows() == 0 {
            return (0.0, 0);
        }
        let r = whole.qr().thin_R().to_owned();
        // What is below the columns no parameter can tell.
        let within = width.min(r.nrows());
        let residual = |row: usize| {
            let columns = active.iter().enumerate();
            let fitted: f64 = columns.map(|(k, &c)| r[(row, k)] * estimate[c]).sum();
            r[(row, width)] - fitted
        };
        ((0..within).map(|row| residual(row).powi(2)).sum(), within)
    }
}
