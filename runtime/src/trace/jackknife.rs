//! Whether a gain is more than noise makes, by what leaving out single blocks of time does to it.
//!
//! Sums of the scores `s_g` of what is left of a residual say nothing of a column that lives in one block: its gain makes that score zero, and
//! the gain seems certain. So the variance is that of the jackknife over blocks (MacKinnon, Nielsen & Webb 2023): with the columns' products `S`
//! in all blocks and `S_g` in one, the gain moves by `(S - S_g)^-1 s_g` where the block is left out, and in units of scores by `S` times that.
//! Their jackknife fits all coefficients again; here those of the model stay, as a fit of every candidate without every block would cost many
//! times as much. Where the model has as many coefficients as the log has blocks, some forty of them, noise passes a level of 1e-3 ten times as
//! often for it; held-out errors are asked beside the score.
//!
//! Blocks in which a column hardly is say nothing of its variance. So a direction is worth `B_e = S^2 / sum S_g^2` blocks of the `B`, and with `p`
//! directions `(B - p) / (p (B - 1))` times the Wald statistic is compared with `F(p, (B - p) (B_e - 1) / (B - 1))`: Hotelling's test for
//! columns that are the same in every block, a t-test with `B_e - 1` degrees of freedom for one of a few.

use nalgebra::{DMatrix, DVector};
use statrs::distribution::{ContinuousCDF, FisherSnedecor};

use super::small::{add, dot, solve_symmetric};

/// A block.
pub(super) struct Part {
    /// Products of the columns with each other.
    pub(super) information: Vec<Vec<f64>>,
    /// Products of the columns with what they leave of the residual.
    pub(super) score: Vec<f64>,
}

/// A symmetric matrix of columns as one of directions: `D S D'`.
pub(super) fn along(directions: &[Vec<f64>], matrix: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let row = |direction: &Vec<f64>| -> Vec<f64> {
        let product: Vec<f64> = matrix.iter().map(|row| dot(row, direction)).collect();
        directions
            .iter()
            .map(|other| dot(other, &product))
            .collect()
    };
    directions.iter().map(row).collect()
}

/// `F` statistic and its probability in noise: of columns with the products `whole`, whose gain times these is `moved`, from blocks; `more` is
/// variance that no block shows. `None` where without one of the blocks nothing is left of a direction, or too few blocks have it.
pub(super) fn test(
    whole: &[Vec<f64>],
    blocks: &[Part],
    moved: &[f64],
    more: &[Vec<f64>],
) -> Option<(f64, f64)> {
    let (count, directions) = (blocks.len() as f64, moved.len() as f64);
    let mut variance = more.to_vec();
    for block in blocks {
        let score = left_out(whole, block)?;
        for (row, a) in variance.iter_mut().zip(&score) {
            add(row, a * (1.0 - count.recip()), &score);
        }
    }
    let wald = dot(moved, &solve_symmetric(&variance, moved));
    let freedom = (count - directions) * (worth(blocks) - 1.0) / (count - 1.0);
    let f = (wald * (count - directions) / (directions * (count - 1.0))).max(0.0);
    let distribution = FisherSnedecor::new(directions, freedom).ok()?;
    Some((f, distribution.sf(f)))
}

/// `S (S - S_g)^-1 s_g`; `None` where nothing is left of a direction without the block.
fn left_out(whole: &[Vec<f64>], block: &Part) -> Option<Vec<f64>> {
    let n = block.score.len();
    let others = DMatrix::from_fn(n, n, |a, b| whole[a][b] - block.information[a][b]);
    let moved = others
        .cholesky()?
        .solve(&DVector::from_column_slice(&block.score));
    Some(whole.iter().map(|row| dot(row, moved.as_slice())).collect())
}

/// How many blocks the directions are worth: the harmonic mean of `S^2 / sum S_g^2`.
fn worth(blocks: &[Part]) -> f64 {
    let count = blocks.first().map_or(0, |block| block.score.len());
    let of_direction = |d: usize| {
        let own = blocks.iter().map(|block| block.information[d][d]);
        let (sum, squares) = own.fold((0.0, 0.0), |(sum, squares), s| (sum + s, squares + s * s));
        squares / f64::max(sum * sum, f64::MIN_POSITIVE)
    };
    let mean = (0..count).map(of_direction).sum::<f64>() / count.max(1) as f64;
    mean.recip()
}

#[cfg(test)]
mod tests {
    use super::super::series::white;
    use super::*;

    /// Two columns in three blocks: leaving one out does what fitting the other two does.
    #[test]
    fn a_score_is_what_leaving_its_block_out_does() {
        let columns = [
            [1.0, 2.0, -1.0, 0.5, 1.5, 1.0],
            [0.3, -1.0, 1.0, 2.0, 0.2, -0.7],
        ];
        let torque = [1.2, 1.7, -0.4, 2.9, 1.6, 0.1];
        let blocks = [0..2, 2..4, 4..6];
        let products = |rows: &[usize]| -> (DMatrix<f64>, DVector<f64>) {
            let sum = |of: &dyn Fn(usize) -> f64| rows.iter().map(|&k| of(k)).sum::<f64>();
            (
                DMatrix::from_fn(2, 2, |a, b| sum(&|k| columns[a][k] * columns[b][k])),
                DVector::from_fn(2, |a, _| sum(&|k| columns[a][k] * torque[k])),
            )
        };
        let listed = |matrix: &DMatrix<f64>| -> Vec<Vec<f64>> {
            let rows = matrix.row_iter();
            rows.map(|row| row.iter().copied().collect()).collect()
        };
        let (all, right) = products(&[0, 1, 2, 3, 4, 5]);
        let gain = all.clone().cholesky().expect("two columns").solve(&right);
        for block in blocks {
            let (inside, outside): (Vec<usize>, Vec<usize>) =
                (0..6).partition(|k| block.contains(k));
            let (own, own_right) = products(&inside);
            let (others, others_right) = products(&outside);
            let without = others.cholesky().expect("two columns").solve(&others_right);
            let part = Part {
                information: listed(&own),
                score: (&own_right - &own * &gain).iter().copied().collect(),
            };
            let told = left_out(&listed(&all), &part).expect("told by others");
            let expected = &all * (&gain - without);
            for (told, expected) in told.iter().zip(expected.iter()) {
                assert!((told - expected).abs() < 1e-12, "{told} {expected}");
            }
        }
    }

    /// The test of a column of ones in the first blocks of eighty, ten rows each, against white noise.
    fn of_noise(blocks: usize, seed: u32) -> Option<(f64, f64)> {
        const ROWS: usize = 10;
        let noise = white(800, seed);
        let there = blocks * ROWS;
        let gain = noise[..there].iter().sum::<f64>() / there as f64;
        let part = |block: usize| {
            let rows = block * ROWS..(block + 1) * ROWS;
            let own = if block < blocks { ROWS as f64 } else { 0.0 };
            let left = |row: usize| {
                if block < blocks {
                    noise[row] - gain
                } else {
                    0.0
                }
            };
            Part {
                information: vec![vec![own]],
                score: vec![rows.map(left).sum()],
            }
        };
        let parts: Vec<Part> = (0..80).map(part).collect();
        let whole = there as f64;
        test(&[vec![whole]], &parts, &[whole * gain], &[vec![0.0]])
    }

    #[test]
    fn noise_is_as_improbable_as_it_is_said_to_be() {
        const TRIALS: u32 = 4000;
        for blocks in [3, 8, 80] {
            let chances = (0..TRIALS).map(|seed| of_noise(blocks, 1 + 7 * seed).expect("a test").1);
            let below = chances.filter(|p| *p < 0.01).count();
            // Forty are expected, and six more or less is a deviation.
            assert!(
                (20..=60).contains(&below),
                "{below} of {TRIALS}, {blocks} blocks"
            );
        }
    }

    #[test]
    fn what_lives_in_one_block_is_not_told() {
        assert_eq!(of_noise(1, 5), None);
    }
}
