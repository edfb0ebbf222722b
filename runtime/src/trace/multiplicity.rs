//! How many independent tests all candidates at all points of their grids are worth.
//!
//! The best of thousands of scores is large by chance alone. Columns of one law at neighboring shapes are nearly the same, though, and so
//! are those of laws that look alike, so that to count each as a test of its own (Bonferroni's bound) asks too much of short logs. How
//! often noise has a score somewhere is asked of the residual: scores are sums over blocks of time, which normal numbers that multiply
//! whole blocks draw anew for all candidates at once (multiplier bootstrap of maxima, Chernozhukov, Chetverikov & Kato 2013). Laws that are
//! alike part further out, and shapes are refined between points of the grid: the count is doubled for both.

use std::ops::Range;

use faer::Mat;
use nalgebra::{DMatrix, SymmetricEigen};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use statrs::distribution::{ChiSquared, ContinuousCDF};

use crate::columns::{Candidate, Entry};
use crate::motion::Motion;
use crate::threads;

use super::grid::Grid;
use super::score::Present;
use super::small::dot;
use super::trial::project;

/// Length of a block, s, and how many there are of all logs together: what differs within a block counts as one test.
const BLOCK_S: f64 = 0.5;
const BLOCKS: Range<usize> = 120..1000;

/// By how much more tests count than at the share below: of a family with one shape the count at a fiftieth of that is 1.3 times it.
const FURTHER_OUT: f64 = 2.0;

/// Draws, and the share of them in which noise passes.
const DRAWS: usize = 1000;
const SHARE: f64 = 0.05;

/// Rows that are multiplied at once.
const CHUNK: usize = 512;

/// Directions of a law's columns with less than this share of the largest variance are none.
const LEAST_VARIANCE: f64 = 1e-9;

/// The number of tests, between 1 and that of points: twice `M`, where in 5 % of draws some point has a score as improbable as 5 % / M.
pub(super) fn tests(present: &Present, grids: &[Grid], motions: &[Motion]) -> f64 {
    let blocks = present.equal_blocks(BLOCK_S, BLOCKS);
    let with_residual = present.block_products(&blocks);
    let points = threads::map(grids, |grid| {
        let mut points: Vec<Directions> = Vec::new();
        grid.each(present, motions, &mut |candidate, entries| {
            let found = scores(present, &blocks, &with_residual, candidate, entries);
            points.extend(found.map(|scores| whitened(&scores)));
        });
        points
    });
    let points: Vec<Directions> = points.into_iter().flatten().collect();
    worth(&points, blocks.len())
}

/// Block scores of one point's columns in orthogonal directions of unit variance, one row each.
type Directions = Vec<Vec<f64>>;

/// A point's scores, a row each column, less their means: what a missing effect leaves in all blocks is none of the noise. None where it
/// says nothing new.
fn scores(
    present: &Present,
    blocks: &[Range<usize>],
    with_residual: &[Vec<f64>],
    candidate: &dyn Candidate,
    entries: &[Entry],
) -> Option<Vec<Vec<f64>>> {
    let projected = project(candidate, entries, present)?;
    let mut scores = vec![vec![0.0; blocks.len()]; projected.gain.len()];
    for entry in entries {
        let weight = present.sigma[entry.joint].powi(-2);
        let residual = &present.residuals[entry.joint];
        for (score, block) in scores[entry.column].iter_mut().zip(blocks) {
            *score += weight * dot(&entry.values[block.clone()], &residual[block.clone()]);
        }
    }
    for (scores, correction) in scores.iter_mut().zip(&projected.corrections) {
        for (score, with_residual) in scores.iter_mut().zip(with_residual) {
            *score -= dot(correction, with_residual);
        }
        let mean = scores.iter().sum::<f64>() / scores.len().max(1) as f64;
        for score in scores {
            *score -= mean;
        }
    }
    Some(scores)
}

/// Rows that span those of `scores`, with sums of squares of 1 and products of 0.
fn whitened(scores: &[Vec<f64>]) -> Directions {
    let scale: Vec<f64> = scores.iter().map(|row| dot(row, row).sqrt()).collect();
    let count = scores.len();
    let products = DMatrix::from_fn(count, count, |a, b| {
        let scale = scale[a] * scale[b];
        if scale > 0.0 {
            dot(&scores[a], &scores[b]) / scale
        } else {
            0.0
        }
    });
    let eigen = SymmetricEigen::new(products);
    let largest = eigen.eigenvalues.max();
    let kept = (0..count).filter(|&k| eigen.eigenvalues[k] > LEAST_VARIANCE * largest);
    let row = |k: usize| {
        let mut row = vec![0.0; scores.first().map_or(0, Vec::len)];
        for (c, scores) in scores.iter().enumerate() {
            let share = eigen.eigenvectors[(c, k)] / (scale[c] * eigen.eigenvalues[k].sqrt());
            if scale[c] > 0.0 {
                let sums = row.iter_mut().zip(scores);
                sums.for_each(|(sum, score)| *sum += share * score);
            }
        }
        row
    };
    kept.map(row).collect()
}

/// The number of independent tests that have as improbable a best score.
fn worth(points: &[Directions], blocks: usize) -> f64 {
    let points: Vec<&Directions> = points.iter().filter(|point| !point.is_empty()).collect();
    let most = points.iter().map(|point| point.len()).max().unwrap_or(0);
    if most == 0 {
        return 1.0;
    }
    let mut random = ChaCha8Rng::seed_from_u64(0);
    let draws = Mat::from_fn(blocks, DRAWS, |_, _| {
        Distribution::<f64>::sample(&StandardNormal, &mut random)
    });
    // The largest score of a draw among laws with as many directions.
    let mut largest = vec![vec![0.0_f64; DRAWS]; most];
    let mut first = 0;
    while first < points.len() {
        let mut last = first;
        let mut rows: Vec<&Vec<f64>> = Vec::new();
        while last < points.len() && rows.len() < CHUNK {
            rows.extend(points[last]);
            last += 1;
        }
        let scores = Mat::from_fn(rows.len(), blocks, |row, block| rows[row][block]) * &draws;
        for draw in 0..DRAWS {
            let mut row = 0;
            for point in &points[first..last] {
                let squares = (row..row + point.len()).map(|row| scores[(row, draw)].powi(2));
                let most = &mut largest[point.len() - 1][draw];
                *most = most.max(squares.sum());
                row += point.len();
            }
        }
        first = last;
    }
    let chance = |draw: usize| {
        let laws = largest.iter().enumerate();
        let laws = laws.map(|(k, largest)| {
            let of_noise = ChiSquared::new((k + 1) as f64).expect("one direction or more");
            of_noise.sf(largest[draw])
        });
        laws.fold(1.0, f64::min)
    };
    let mut chances: Vec<f64> = (0..DRAWS).map(chance).collect();
    chances.sort_by(f64::total_cmp);
    let rank = crate::signal::resample::whole_steps(SHARE * DRAWS as f64);
    let of_share = chances[rank].max(f64::MIN_POSITIVE);
    (FURTHER_OUT * SHARE / of_share).clamp(1.0, points.len() as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn noise(count: usize) -> Vec<Vec<f64>> {
        let mut random = ChaCha8Rng::seed_from_u64(7);
        let mut row = || -> Vec<f64> {
            let values = (0..BLOCKS.start).map(|_| StandardNormal.sample(&mut random));
            values.collect()
        };
        (0..count).map(|_| row()).collect()
    }

    #[test]
    fn tests_that_have_nothing_in_common_count_one_by_one() {
        let points: Vec<Directions> = noise(80)
            .iter()
            .map(|row| whitened(std::slice::from_ref(row)))
            .collect();
        let worth = worth(&points, BLOCKS.start);
        assert!((75.0..=80.0).contains(&worth), "{worth}");
    }

    #[test]
    fn tests_that_are_the_same_count_once() {
        let row = &noise(1)[0];
        let points = vec![whitened(std::slice::from_ref(row)); 300];
        let worth = worth(&points, BLOCKS.start);
        assert!(worth < 2.8, "{worth}");
    }

    /// Two columns that are one, and a third: two directions.
    #[test]
    fn directions_are_those_that_differ() {
        let rows = noise(2);
        let twice: Vec<f64> = rows[0].iter().map(|v| 3.0 * v).collect();
        let found = whitened(&[rows[0].clone(), twice, rows[1].clone()]);
        assert_eq!(found.len(), 2);
        assert!((dot(&found[0], &found[0]) - 1.0).abs() < 1e-9);
        assert!(dot(&found[0], &found[1]).abs() < 1e-9);
    }
}
