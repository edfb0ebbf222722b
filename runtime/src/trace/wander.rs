//! The wander of a torque's zero: what it says for a column that is no law's doing.
//!
//! A zero that walks has no length beyond which its samples are independent, so that blocks of it, however long, agree with each other, and
//! a constant, a weight or a gain is found in it that the next log does not have. How much of a score a walk makes follows from its steps:
//! with `W' = s n`, where `n` is white, `int z W dt` has the variance `s^2 int S^2 dt` with `S(t) = int_t z`. Steps are seen in how means of
//! seconds part with the time between them, `E (m_(i+k) - m_i)^2 = s^2 (k - 1/3) + 2 v`, up to a quarter of the log: noise over less than a
//! second does not part further, what follows the motion no further than it moves, and a wander that is bound no further than that.

use crate::identify::{Segment, Stack};
use crate::signal::resample::whole_steps;

use super::gram::Gram;
use super::small::add;

/// Means are of so long a time, s.
const MEAN_S: f64 = 1.0;

/// Numbers of means between two that are compared are each twice the one before, up to this in any case that the log has, further ones as long
/// as so many of them are in it.
const APART: usize = 8;
const PARTS: usize = 4;

/// As many pairs of means tell how far they part.
const LEAST_PAIRS: usize = 4;

/// `s^2`, the power of a residual's walk over a log, (N m)^2/s: halfway from the least to the mean of what times up to eight seconds say, or
/// the least that longer ones do. A short log has few pairs of each time: the least of three is often none at all beside a zero that
/// walks, and their mean takes what follows the motion for a walk.
pub(super) fn walk(segment: &Segment, residual: &[f64]) -> f64 {
    let means = means(segment, residual);
    let parted = |apart: usize| -> Option<f64> {
        let pairs = means.iter().zip(means.iter().skip(apart));
        let squares = pairs.filter_map(|(one, other)| Some(((*other)? - (*one)?).powi(2)));
        let squares: Vec<f64> = squares.collect();
        (squares.len() >= LEAST_PAIRS).then(|| squares.iter().sum::<f64>() / squares.len() as f64)
    };
    let most = APART.max(means.len() / PARTS);
    let twice = std::iter::successors(Some(1), |near| Some(2 * near));
    let step = |near: usize| Some((parted(2 * near)? - parted(near)?) / near as f64 / MEAN_S);
    let (near, far): (Vec<usize>, Vec<usize>) = twice
        .take_while(|near| 2 * near <= most)
        .partition(|near| 2 * near <= APART);
    let near: Vec<f64> = near.into_iter().filter_map(step).collect();
    let mean = near.iter().sum::<f64>() / near.len().max(1) as f64;
    let least = near.iter().copied().fold(mean, f64::min);
    let halfway = 0.5 * (mean.max(0.0) + least.max(0.0));
    far.into_iter()
        .filter_map(step)
        .fold(halfway, f64::min)
        .max(0.0)
}

/// Means of a log's seconds; none where most rows say nothing, which are zero.
fn means(segment: &Segment, residual: &[f64]) -> Vec<Option<f64>> {
    let Some(first) = segment.time.first() else {
        return Vec::new();
    };
    let place = |time: f64| whole_steps((time - first) / MEAN_S);
    let mut sums = vec![(0.0, 0, 0); segment.time.last().map_or(0, |last| place(*last))];
    for (time, value) in segment.time.iter().zip(&residual[segment.start..]) {
        if let Some((sum, count, all)) = sums.get_mut(place(*time)) {
            *sum += value;
            *count += usize::from(*value != 0.0);
            *all += 1;
        }
    }
    let mean = |(sum, count, all): (f64, usize, usize)| {
        (count > 0 && 2 * count >= all).then(|| sum / count as f64)
    };
    sums.into_iter().map(mean).collect()
}

/// What a walk of this power adds to products of two columns' scores over a log: `s^2 int S_a S_b dt`.
pub(super) fn products(segment: &Segment, walk: f64, columns: &[&[f64]]) -> Vec<Vec<f64>> {
    let count = columns.len();
    let mut products = vec![vec![0.0; count]; count];
    let rows = segment.time.len();
    if walk <= 0.0 || rows < 2 {
        return products;
    }
    let mut tails = vec![0.0; count];
    for row in (1..rows).rev() {
        // A hole belongs to the row behind it.
        let step = segment.time[row] - segment.time[row - 1];
        for (tail, column) in tails.iter_mut().zip(columns) {
            *tail += column[segment.start + row];
        }
        for (line, a) in products.iter_mut().zip(&tails) {
            for (product, b) in line.iter_mut().zip(&tails) {
                *product += walk * step * a * b;
            }
        }
    }
    products
}

/// Adds what walks of the torques' zeros make to the deviations of some unknowns. With joints' rows `W_j`, weights `sigma_j^-2` and
/// `A = sum W_j' W_j / sigma_j^2` a zero `w_j` moves an estimate by `sum_j w_j' c_j`, `c_j = W_j A^-1 e / sigma_j^2`.
pub(super) fn widen(
    deviations: &mut [Option<f64>],
    unknowns: impl Iterator<Item = usize>,
    stack: &Stack,
    sigma: &[f64],
    residuals: &[Vec<f64>],
) {
    let normal = Gram::new(stack, &[]).normal(sigma);
    for unknown in unknowns {
        let Some(deviation) = &mut deviations[unknown] else {
            continue;
        };
        let mut wanted = vec![0.0; stack.unknowns.len()];
        wanted[unknown] = 1.0;
        let inverse = normal.apply(&wanted);
        let mut variance = deviation.powi(2);
        for ((rows, sigma), residual) in stack.joints.iter().zip(sigma).zip(residuals) {
            let mut influence = vec![0.0; residual.len()];
            for (column, values) in &rows.columns {
                add(&mut influence, inverse[*column] * sigma.powi(-2), values);
            }
            for segment in &stack.segments {
                let walk = walk(segment, residual);
                variance += products(segment, walk, &[&influence])[0][0];
            }
        }
        *deviation = variance.sqrt();
    }
}

#[cfg(test)]
mod tests {
    use super::super::series::{HZ, segment, white};
    use super::*;
    use crate::columns::Unknown;
    use crate::identify::JointRows;

    fn walked(rows: u32, seed: u32, power: f64) -> Vec<f64> {
        let mut value = 0.0;
        let steps = white(rows, seed);
        let step = |step: f64| {
            value += (power / HZ).sqrt() * step;
            value
        };
        steps.into_iter().map(step).collect()
    }

    #[test]
    fn a_walk_is_told_from_noise_and_from_what_follows_a_motion() {
        let segment = segment(1600);
        let found = (0..40).map(|seed| walk(&segment, &walked(1600, seed, 0.09)));
        let mut found: Vec<f64> = found.collect();
        found.sort_by(f64::total_cmp);
        // Of a few seconds none is sure.
        assert!(found[20] > 0.02 && found[20] < 0.12, "{found:?}");
        for seed in 0..10 {
            // Of means that vary by 0.025.
            assert!(walk(&segment, &white(1600, seed)) < 0.01);
        }
        let wave = |k: u32| (0.9 * f64::from(k) / HZ).sin() + 0.4 * (2.3 * f64::from(k) / HZ).cos();
        let wave: Vec<f64> = (0..1600).map(wave).collect();
        // Of a power of 0.6. In a short log that is a walk in part.
        assert!(walk(&segment, &wave) < 0.2);
    }

    /// In logs of twenty seconds the walk that is there was taken for none in half of the cases.
    #[test]
    fn a_walk_is_seldom_none_in_a_short_log() {
        let segment = segment(800);
        let found = (0..40).map(|seed| walk(&segment, &walked(800, seed, 0.09)));
        let next_to_none = found.filter(|found| *found < 0.009).count();
        assert!(next_to_none <= 8, "{next_to_none} of 40");
    }

    /// A zero that wanders within bounds, and a motion of eighteen seconds, part for a while and then no more: a long log tells.
    #[test]
    fn what_is_bound_is_no_walk_of_a_long_log() {
        let rows = 24_000;
        let segment = segment(rows);
        let slow = |k: u32| (0.35 * f64::from(k) / HZ).sin();
        let slow: Vec<f64> = (0..rows).map(slow).collect();
        assert!(walk(&segment, &slow) < 1e-3);
        for seed in 0..10 {
            let mut value = 0.0;
            let bound = white(rows, seed).into_iter().map(|step| {
                value += step / HZ.sqrt() - value / (5.0 * HZ);
                value
            });
            // The power of its steps is 1.
            let bound: Vec<f64> = bound.collect();
            assert!(walk(&segment, &bound) < 0.1);
        }
    }

    /// The variance of a constant's score over walks of many seeds.
    #[test]
    fn a_score_varies_with_walks_as_it_is_said_to() {
        let segment = segment(800);
        let ones = vec![1.0; 800];
        let scores = (0..400).map(|seed| walked(800, seed, 0.25).iter().sum::<f64>());
        let variance = scores.map(|score| score * score).sum::<f64>() / 400.0;
        let said = products(&segment, 0.25, &[&ones])[0][0];
        assert!((variance / said - 1.0).abs() < 0.3, "{variance} {said}");
    }

    /// An offset and a wave, of twenty seconds with a zero that walks: its walk moves the offset, and hardly the wave.
    #[test]
    fn deviations_know_of_walks() {
        const ROWS: u32 = 800;
        let wave: Vec<f64> = (0..ROWS).map(|k| (0.31 * f64::from(k)).sin()).collect();
        let unknown = |name: &str| Unknown {
            name: name.to_owned(),
            nonnegative: false,
        };
        let mut found = [Vec::new(), Vec::new()];
        for seed in 0..60 {
            let zero = walked(ROWS, seed, 0.25);
            let mean = zero.iter().sum::<f64>() / f64::from(ROWS);
            let size =
                2.0 * zero.iter().zip(&wave).map(|(a, b)| a * b).sum::<f64>() / f64::from(ROWS);
            let stack = Stack {
                unknowns: vec![unknown("offset"), unknown("wave")],
                joints: vec![JointRows {
                    tau: zero.clone(),
                    target: zero,
                    columns: vec![(0, vec![1.0; ROWS as usize]), (1, wave.clone())],
                }],
                segments: vec![segment(ROWS)],
                ..Stack::default()
            };
            let residuals = stack.residuals(&[mean, size]);
            let mut deviations = [Some(0.0), Some(0.0)];
            widen(&mut deviations, 0..2, &stack, &[0.7], &residuals);
            let [offset, wave] = deviations.map(|of| of.expect("a number"));
            found[0].push(mean / offset);
            found[1].push(size / wave);
            assert!(wave < 0.1 * offset, "{wave} {offset}");
        }
        // By how many of its deviations an offset of none is found. How much a zero walks is itself not sure in twenty seconds: with the
        // power that it has 57 would be within.
        let inside = |found: &[f64]| found.iter().filter(|z| z.abs() < 1.96).count();
        assert!(inside(&found[0]) > 40, "{:?}", found[0]);
        assert!(inside(&found[1]) > 40, "{:?}", found[1]);
        // What has no deviation gets none.
        let mut none = [None];
        let nothing = Stack {
            unknowns: vec![unknown("offset")],
            ..Stack::default()
        };
        widen(&mut none, 0..1, &nothing, &[], &[]);
        assert_eq!(none, [None]);
    }
}
