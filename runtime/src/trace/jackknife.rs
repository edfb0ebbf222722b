//! How much a gain owes to single blocks of time.
//!
//! Sums of the scores `s_g` of what is left of a residual say nothing of a column that lives in one block: its gain makes that score zero, and
//! the gain seems certain. So each score is what leaving its block out does to the gain, in units of scores (cluster jackknife, MacKinnon,
//! Nielsen & Webb 2023): with the columns' products `S` in all blocks and `S_g` in one, the gain moves by `(S - S_g)^-1 s_g`.

use nalgebra::{DMatrix, DVector};

use super::small::{add, dot};

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

/// `S (S - S_g)^-1 s_g`; `None` where nothing is left of a direction without the block.
pub(super) fn score(whole: &[Vec<f64>], block: &[Vec<f64>], score: &[f64]) -> Option<Vec<f64>> {
    let n = score.len();
    let others = DMatrix::from_fn(n, n, |a, b| whole[a][b] - block[a][b]);
    let moved = others.cholesky()?.solve(&DVector::from_column_slice(score));
    Some(whole.iter().map(|row| dot(row, moved.as_slice())).collect())
}

/// `(B - 1) / B` times the sum of the products of `B` scores.
pub(super) fn variance(scores: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let count = scores.first().map_or(0, Vec::len);
    let factor = 1.0 - (scores.len().max(1) as f64).recip();
    let mut sum = vec![vec![0.0; count]; count];
    for score in scores {
        for (row, a) in sum.iter_mut().zip(score) {
            add(row, factor * a, score);
        }
    }
    sum
}

#[cfg(test)]
mod tests {
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
            matrix
                .row_iter()
                .map(|row| row.iter().copied().collect())
                .collect()
        };
        let (all, right) = products(&[0, 1, 2, 3, 4, 5]);
        let gain = all.clone().cholesky().expect("two columns").solve(&right);
        for block in blocks {
            let (inside, outside): (Vec<usize>, Vec<usize>) =
                (0..6).partition(|k| block.contains(k));
            let (own, own_right) = products(&inside);
            let (others, others_right) = products(&outside);
            let without = others.cholesky().expect("two columns").solve(&others_right);
            let rest = &own_right - &own * &gain;
            let told =
                score(&listed(&all), &listed(&own), rest.as_slice()).expect("told by others");
            let expected = &all * (&gain - without);
            for (told, expected) in told.iter().zip(expected.iter()) {
                assert!((told - expected).abs() < 1e-12, "{told} {expected}");
            }
        }
    }

    #[test]
    fn what_lives_in_one_block_is_not_told() {
        let column = [0.0, 0.0, 3.0];
        let of = |values: &[f64]| vec![vec![dot(values, values)]];
        assert_eq!(score(&of(&column), &of(&column[2..]), &[0.0]), None);
        assert_eq!(
            score(&of(&column), &of(&column[..1]), &[0.0]),
            Some(vec![0.0])
        );
    }
}
