//! Ordinary and weighted least squares on a [`Stack`], by QR.
//!
//! Each joint's block is reduced once to its triangular factor; weights, ranks and solutions then work on matrices of the
//! size of the unknowns, however long the logs are.

mod excited;
mod solution;

use faer::Mat;
use faer::linalg::solvers::{Solve, SolveLstsq};

use super::combination::shared;
use super::stack::{JointRows, Stack};
use super::{IdentifyError, Weights, drowned};

pub(super) use excited::Excited;
pub use excited::RANK_TOLERANCE;
pub use solution::Solution;

/// Smallest deviation of a joint's residual relative to the largest.
const LEAST_SIGMA: f64 = 1e-6;

/// How often weights follow the residuals of the estimate that they gave.
const REWEIGHTINGS: usize = 5;

impl Weights {
    /// How often an estimate is made until its weights are those of its own residuals; once where weights do not follow these.
    pub(super) fn rounds(self) -> usize {
        match self {
            Self::Residual => REWEIGHTINGS,
            Self::TorqueNorm | Self::MaxTorque => 1,
        }
    }
}

/// The largest singular value over the smallest.
pub(super) fn condition(matrix: &Mat<f64>) -> f64 {
    let values = matrix.singular_values().unwrap_or_default();
    let ends = values.first().zip(values.last());
    ends.map_or(f64::INFINITY, |(most, least)| most / least)
}

/// Triangular factors `R_j` of the blocks `[W_j target_j]`, all columns in place.
///
/// # Examples
/// ```
/// use robot_model::identify::{Factors, JointRows, Stack};
/// // 3 = 0.25 k + fc, 2 = 0.25 k - fc
/// let tau = vec![3.0, 2.0];
/// let columns = vec![(0, vec![0.25, 0.25]), (1, vec![1.0, -1.0])];
/// let rows = JointRows { target: tau.clone(), tau, columns };
/// # let unknown = |name: &str| robot_model::columns::Unknown { name: name.to_owned(), nonnegative: true };
/// let stack = Stack { unknowns: vec![unknown("k"), unknown("fc")], joints: vec![rows], ..Stack::default() };
/// let solution = Factors::new(&stack).ordinary(&[1.0]);
/// assert!((solution.estimate[0] - 10.0).abs() < 1e-9 && (solution.estimate[1] - 0.5).abs() < 1e-9);
/// assert!(solution.is_told(0) && (solution.condition - 1.0).abs() < 1e-9);
/// ```
#[derive(Debug, Clone)]
pub struct Factors {
    unknowns: usize,
    /// Rows of each joint that say something.
    counts: Vec<usize>,
    joints: Vec<Mat<f64>>,
    /// Of each joint, what noise of positions makes of the columns; nothing where that was not asked.
    noise: Vec<Mat<f64>>,
}

/// Least squares on the rows of all joints.
struct Solved {
    /// The triangular factor of all rows with the target.
    r: Mat<f64>,
    excited: Excited,
    /// Directions of noise alone, which are not among those.
    drowned: usize,
    estimate: Vec<f64>,
}

impl Factors {
    /// Reduces every block.
    ///
    /// # Examples
    /// ```
    /// # mod spring { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/spring.rs")); }
    /// use robot_model::identify::Factors;
    /// let solution = Factors::new(&spring::spring()).ordinary(&[1.0]);
    /// assert!((solution.estimate[0] - 10.0).abs() < 1e-9); // N m/rad
    /// ```
    #[must_use]
    pub fn new(stack: &Stack) -> Self {
        Self::of_rows(stack, &|_, _| 1.0)
    }

    /// Reduces every block, each row times a factor of its joint and its number.
    pub(super) fn of_rows(stack: &Stack, factor: &dyn Fn(usize, usize) -> f64) -> Self {
        let unknowns = stack.unknowns.len();
        let count = |(joint, rows): (usize, &JointRows)| {
            let all = 0..rows.target.len();
            all.filter(|&row| factor(joint, row) != 0.0 && rows.is_there(row))
                .count()
        };
        let counts = stack.joints.iter().enumerate().map(count).collect();
        let joints = stack
            .joints
            .iter()
            .enumerate()
            .map(|(joint, rows)| {
                let active = rows.columns.len();
                let all = 0..rows.target.len();
                let counting: Vec<usize> = all.filter(|&k| factor(joint, k) != 0.0).collect();
                if counting.is_empty() {
                    return Mat::zeros(0, unknowns + 1);
                }
                let block = Mat::from_fn(counting.len(), active + 1, |row, c| {
                    let k = counting[row];
                    let value = if c < active {
                        rows.columns[c].1[k]
                    } else {
                        rows.target[k]
                    };
                    factor(joint, k) * value
                });
                let r = block.qr();
                let r = r.thin_R();
                let mut whole = Mat::zeros(r.nrows(), unknowns + 1);
                for row in 0..r.nrows() {
                    for c in 0..=active {
                        let to = if c < active {
                            rows.columns[c].0
                        } else {
                            unknowns
                        };
                        whole[(row, to)] = r[(row, c)];
                    }
                }
                whole
            })
            .collect();
        Self {
            unknowns,
            counts,
            joints,
            noise: stack.noise.iter().map(|noise| noise.0.clone()).collect(),
        }
    }

    /// From factors of each joint's rows, all columns in place; `counts` are the rows that say something.
    pub(super) fn from_joints(unknowns: usize, counts: Vec<usize>, joints: Vec<Mat<f64>>) -> Self {
        Self {
            unknowns,
            counts,
            joints,
            noise: Vec::new(),
        }
    }

    /// The factors, one a joint.
    pub(super) fn joints(&self) -> &[Mat<f64>] {
        &self.joints
    }

    /// Rows of each joint that say something.
    pub(super) fn counts(&self) -> &[usize] {
        &self.counts
    }

    /// Ordinary least squares: every joint has the same weight.
    ///
    /// # Examples
    /// ```
    /// # mod spring { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/spring.rs")); }
    /// use robot_model::identify::Factors;
    /// let solution = Factors::new(&spring::spring()).ordinary(&[1.0]);
    /// assert!((solution.estimate[1] - 0.5).abs() < 1e-9 && solution.scale == [1.0]);
    /// ```
    #[must_use]
    pub fn ordinary(&self, correlation: &[f64]) -> Solution {
        self.solve(&vec![1.0; self.joints.len()], correlation)
    }

    /// Weighted least squares: every joint's rows are divided by the standard deviation of its residual, which is found by
    /// iteration from ordinary least squares.
    ///
    /// # Examples
    /// ```
    /// # mod spring { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/spring.rs")); }
    /// use robot_model::identify::{Factors, JointRows, Stack};
    /// let rows = |noise: [f64; 4]| {
    ///     let tau = noise.map(|noise| 2.5 + noise).to_vec();
    ///     JointRows { target: tau.clone(), tau, columns: vec![(0, vec![0.25; 4])] }
    /// };
    /// // k = 10; the second joint is loud, by 0.5 N m in the mean.
    /// let joints = vec![rows([0.01, -0.01, 0.01, -0.01]), rows([1.0, -1.0, 1.0, 1.0])];
    /// let factors = Factors::new(&Stack { unknowns: vec![spring::unknown("k")], joints, ..Stack::default() });
    /// assert!((factors.ordinary(&[1.0; 2]).estimate[0] - 11.0).abs() < 1e-9);
    /// assert!((factors.weighted(&[1.0; 2]).estimate[0] - 10.0).abs() < 0.01);
    /// ```
    #[must_use]
    pub fn weighted(&self, correlation: &[f64]) -> Solution {
        self.solve(&self.noise(REWEIGHTINGS), correlation)
    }

    /// Standard deviations of each joint's residual by [`Self::weighted`].
    pub(super) fn weighted_sigma(&self) -> Vec<f64> {
        self.noise(REWEIGHTINGS + 1)
    }

    /// Standard deviations of each joint's residual after so many fits, of which each is weighted by those before.
    fn noise(&self, fits: usize) -> Vec<f64> {
        let ones = vec![1.0; self.joints.len()];
        (0..fits).fold(ones, |scale, _| {
            let solved = self.solved(&not_tiny(&scale));
            self.sigma(&solved.estimate, solved.excited.columns.len())
        })
    }

    /// Least squares with each joint's rows divided by `scale`; no scale counts as less than a tiny share of the largest.
    ///
    /// `correlation` is per joint the number of samples that count as one independent sample (1 for white residuals).
    pub(super) fn solve(&self, scale: &[f64], correlation: &[f64]) -> Solution {
        let scale = not_tiny(scale);
        let Solved {
            r,
            excited: found,
            drowned,
            estimate,
        } = self.solved(&scale);
        let unexcited: Vec<usize> = (0..self.unknowns)
            .filter(|c| found.columns.binary_search(c).is_err())
            .collect();
        let shared = shared(&r, &found, &unexcited);
        let Excited {
            columns: excited,
            norms,
            kept,
            ..
        } = found;
        let rank = excited.len();
        let sigma = self.sigma(&estimate, rank);
        let std = self.deviations(&estimate, &excited, &norms, &scale, &sigma, correlation);
        let condition = condition(&kept);
        Solution {
            estimate,
            std,
            unexcited,
            drowned,
            shared,
            condition,
            sigma,
            scale,
        }
    }

    fn solved(&self, scale: &[f64]) -> Solved {
        let n = self.unknowns;
        // Joints share columns: one factor of all is as high as it is wide, and pivoting costs what it should.
        let r = self.stacked(scale).qr().thin_R().to_owned();
        let noise = over_scales(&self.noise, scale, n);
        let excited = Excited::new(&r, n);
        let seen = excited.columns.len();
        let excited = drowned::told(excited, &noise);
        let drowned = seen - excited.columns.len();
        let right = Mat::from_fn(r.nrows(), 1, |row, _| r[(row, n)]);
        let solution = excited.kept.qr().solve_lstsq(&right);
        let mut estimate = vec![0.0; n];
        for (k, &c) in excited.columns.iter().enumerate() {
            estimate[c] = solution[(k, 0)] / excited.norms[c];
        }
        Solved {
            r,
            excited,
            drowned,
            estimate,
        }
    }

    /// The factor of all joints' rows, each divided by its scale.
    pub(super) fn stacked(&self, scale: &[f64]) -> Mat<f64> {
        over_scales(&self.joints, scale, self.unknowns + 1)
    }

    /// Standard deviation of each joint's residual; the unknowns count as shared evenly among the rows that say something.
    pub(super) fn sigma(&self, estimate: &[f64], rank: usize) -> Vec<f64> {
        let all = self.counts.iter().sum::<usize>().max(1);
        let of = |(block, count): (&Mat<f64>, &usize)| {
            let count = *count as f64;
            let freedom = (count - rank as f64 * count / all as f64).max(1.0);
            let sum: f64 = (0..block.nrows())
                .map(|row| {
                    let fitted: f64 = (0..self.unknowns)
                        .map(|c| block[(row, c)] * estimate[c])
                        .sum();
                    (block[(row, self.unknowns)] - fitted).powi(2)
                })
                .sum();
            (sum / freedom).sqrt()
        };
        let sigma: Vec<f64> = self.joints.iter().zip(&self.counts).map(of).collect();
        not_tiny(&sigma)
    }

    /// Square roots of the diagonal of `A^-1 B A^-1` with `A = sum W_j' W_j / scale_j^2` and
    /// `B = sum correlation_j sigma_j^2 W_j' W_j / scale_j^4`: joints have their own noise, and neighboring samples share it.
    fn deviations(
        &self,
        estimate: &[f64],
        excited: &[usize],
        norms: &[f64],
        scale: &[f64],
        sigma: &[f64],
        correlation: &[f64],
    ) -> Vec<f64> {
        let rank = excited.len();
        let mut information = Mat::<f64>::zeros(rank, rank);
        let mut noise = Mat::<f64>::zeros(rank, rank);
        for (j, block) in self.joints.iter().enumerate() {
            let part = Mat::from_fn(block.nrows(), rank, |row, c| {
                block[(row, excited[c])] / (norms[excited[c]] * scale[j])
            });
            let gram = part.transpose() * &part;
            let variance = correlation[j] * (sigma[j] / scale[j]).powi(2);
            noise += faer::Scale(variance) * &gram;
            information += gram;
        }
        let inverse = information
            .partial_piv_lu()
            .solve(Mat::<f64>::identity(rank, rank));
        let covariance = &inverse * noise * inverse.transpose();
        let mut std = vec![0.0; estimate.len()];
        for (k, &c) in excited.iter().enumerate() {
            std[c] = covariance[(k, k)].max(0.0).sqrt() / norms[c];
        }
        std
    }
}

/// Blocks of joints above each other, each divided by its scale.
fn over_scales(joints: &[Mat<f64>], scale: &[f64], columns: usize) -> Mat<f64> {
    let rows = joints.iter().map(Mat::nrows).sum();
    let mut all = Mat::zeros(rows, columns);
    let mut start = 0;
    for (block, scale) in joints.iter().zip(scale) {
        for c in 0..columns.min(block.ncols()) {
            for row in 0..block.nrows() {
                all[(start + row, c)] = block[(row, c)] / scale;
            }
        }
        start += block.nrows();
    }
    all
}

/// Whether there are more rows than unknowns; `counts` are those of each joint that say something.
pub(super) fn check_counts(counts: &[usize], unknowns: usize) -> Result<(), IdentifyError> {
    let rows: usize = counts.iter().sum();
    if rows > unknowns {
        return Ok(());
    }
    if rows == 0 {
        // The logs are long enough, and no joint says anything in them.
        return Err(IdentifyError::NothingExcited { unknowns });
    }
    Err(IdentifyError::TooFewSamples {
        rows,
        dof: counts.len(),
        unknowns,
    })
}

/// Whether the rows tell anything.
pub(super) fn check_excited(solution: &Solution) -> Result<(), IdentifyError> {
    let unknowns = solution.estimate.len();
    if solution.unexcited.len() < unknowns || unknowns == 0 {
        return Ok(());
    }
    Err(IdentifyError::NothingExcited { unknowns })
}

/// A channel that is fitted exactly, such as a dead one, has no infinite weight.
fn not_tiny(sigma: &[f64]) -> Vec<f64> {
    let floor = LEAST_SIGMA * sigma.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
    sigma.iter().map(|s| s.max(floor)).collect()
}

#[cfg(test)]
mod tests;
