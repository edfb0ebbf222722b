//! Huber's M-estimate: samples whose residual is far beyond that of the others count less, and no single one decides.
//!
//! With residuals `r` over their joint's deviation `s`, least squares with weights `min(1, k s / |r|)` are repeated until they
//! settle; `s` is found from the median, which outliers do not move, or from the widest tenth where a joint rests. Source: Huber 1964, Robust estimation of a location parameter;
//! Holland, Welsch 1977, Robust regression using iteratively reweighted least-squares.

use super::least_squares::Factors;
use super::stack::Stack;
use crate::signal::MEDIAN_OF_NORMAL;

/// `k`: 95 % as efficient as least squares where noise is normal.
const CORNER: f64 = 1.345;

/// What nine of ten of them are below.
const NINE_OF_TEN_OF_NORMAL: f64 = 1.6449;

/// Most rounds of weights, and the change of a weight at which they have settled.
const ROUNDS: usize = 30;
const SETTLED: f64 = 1e-3;

/// Residuals beyond so many deviations are outliers: of normal noise one in two million.
const OUTLIER: f64 = 5.0;

/// Factors of the rows with Huber's weights, once these have settled.
pub(super) fn factors(stack: &Stack) -> Factors {
    let mut weights = of_all(stack);
    for _ in 0..ROUNDS {
        let roots = |joint: usize, k: usize| weights[joint][k].sqrt();
        let solution = Factors::of_rows(stack, &roots).weighted(&vec![1.0; stack.dof()]);
        let next = self::weights(stack, &solution.estimate);
        let pairs = weights.iter().flatten().zip(next.iter().flatten());
        let change = pairs.map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
        weights = next;
        if change < SETTLED {
            break;
        }
    }
    Factors::of_rows(stack, &|joint, k| weights[joint][k].sqrt())
}

/// A weight of 1 for every row.
pub(super) fn of_all(stack: &Stack) -> Vec<Vec<f64>> {
    let joints = stack.joints.iter();
    joints.map(|rows| vec![1.0; rows.target.len()]).collect()
}

/// Huber's weights of the rows at an estimate.
pub(super) fn weights(stack: &Stack, estimate: &[f64]) -> Vec<Vec<f64>> {
    let residuals = stack.residuals(estimate);
    residuals.iter().map(|residual| huber(residual)).collect()
}

/// `min(1, k s / |r|)`
fn huber(residual: &[f64]) -> Vec<f64> {
    let corner = CORNER * deviation(residual);
    let weight = |r: &f64| {
        if r.abs() <= corner {
            1.0
        } else {
            corner / r.abs()
        }
    };
    residual.iter().map(weight).collect()
}

/// Samples per joint that are outliers of an estimate.
pub(super) fn outliers(stack: &Stack, estimate: &[f64]) -> Vec<usize> {
    let residuals = stack.residuals(estimate);
    let count = |residual: &Vec<f64>| {
        let far = OUTLIER * deviation(residual);
        residual.iter().filter(|r| r.abs() > far).count()
    };
    residuals.iter().map(count).collect()
}

/// Of normal noise, from the median of its absolute value. A joint that rests for half of a log has next to no noise there: it
/// is at least half of what nine samples of ten say.
fn deviation(residual: &[f64]) -> f64 {
    // Rows that were left out have none.
    let sizes = residual.iter().map(|r| r.abs()).filter(|r| *r > 0.0);
    let mut sizes: Vec<f64> = sizes.collect();
    if sizes.is_empty() {
        return 0.0;
    }
    sizes.sort_unstable_by(f64::total_cmp);
    let median = sizes[sizes.len() / 2] / MEDIAN_OF_NORMAL;
    let wide = sizes[9 * (sizes.len() - 1) / 10] / NINE_OF_TEN_OF_NORMAL;
    median.max(0.5 * wide)
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Distribution, StandardNormal};

    use super::*;
    use crate::columns::Unknown;
    use crate::identify::{Identify, JointRows, Method, Segment};

    /// `tau = 2 x + noise`, with so many of a hundred samples ten deviations away, on either side.
    fn stack(seed: u64, outliers: usize) -> Stack {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let x: Vec<f64> = (0..400)
            .map(|k| (0.37 * f64::from(k)).sin() + 0.5)
            .collect();
        let noise = |k: usize, random: &mut ChaCha8Rng| {
            let normal: f64 = StandardNormal.sample(random);
            if k % 100 < outliers {
                let side: f64 = StandardNormal.sample(random);
                normal + 10.0 * side.signum()
            } else {
                normal
            }
        };
        let target: Vec<f64> = (0..x.len())
            .map(|k| 2.0 * x[k] + noise(k, &mut random))
            .collect();
        Stack {
            unknowns: vec![Unknown {
                name: "x".to_owned(),
                nonnegative: false,
            }],
            joints: vec![JointRows {
                tau: target.clone(),
                target,
                columns: vec![(0, x)],
            }],
            segments: vec![Segment {
                start: 0,
                time: Vec::new(),
            }],
            ..Stack::default()
        }
    }

    fn fit(stack: &Stack, method: Method) -> (f64, f64) {
        let identify = Identify {
            method,
            ..Identify::default()
        };
        let solution = identify.solve_stack(stack).expect("samples enough");
        let std = identify.deviations(stack, &solution);
        (solution.estimate[0], std[0])
    }

    /// Errors over many draws, and what the deviations say of them.
    fn spread(outliers: usize, method: Method) -> (f64, f64) {
        const DRAWS: u32 = 300;
        let (mut errors, mut told) = (0.0, 0.0);
        for seed in 0..DRAWS {
            let (value, std) = fit(&stack(u64::from(seed), outliers), method);
            errors += (value - 2.0).powi(2) / f64::from(DRAWS);
            told += std * std / f64::from(DRAWS);
        }
        (errors.sqrt(), told.sqrt())
    }

    #[test]
    fn normal_noise_costs_little_and_is_told() {
        let (plain, _) = spread(0, Method::Wls);
        let (robust, told) = spread(0, Method::Robust);
        assert!(robust < 1.1 * plain, "{robust} {plain}");
        assert!((told / robust - 1.0).abs() < 0.1, "{told} {robust}");
    }

    #[test]
    fn outliers_move_least_squares_and_not_hubers_estimate() {
        let (plain, _) = spread(5, Method::Wls);
        let (robust, told) = spread(5, Method::Robust);
        assert!(robust < 0.6 * plain, "{robust} {plain}");
        assert!((told / robust - 1.0).abs() < 0.15, "{told} {robust}");
        let stack = stack(1, 5);
        let (value, _) = fit(&stack, Method::Robust);
        let found = super::outliers(&stack, &[value]);
        assert_eq!(found, [20]);
    }

    /// The first 250 of 400 samples at rest, without any noise.
    #[test]
    fn a_joint_that_rests_is_weighed_by_how_it_moves() {
        let mut resting = stack(3, 0);
        let rows = &mut resting.joints[0];
        rows.columns[0].1[..250].fill(0.0);
        rows.target[..250].fill(0.0);
        let (plain, _) = fit(&resting, Method::Wls);
        let (value, std) = fit(&resting, Method::Robust);
        assert!(
            (value - plain).abs() < std && std < 0.2,
            "{value} {std} {plain}"
        );
    }

    #[test]
    fn a_joint_that_is_fitted_exactly_has_weights_too() {
        let mut exact = stack(1, 0);
        let double = |x: &f64| 2.0 * x;
        exact.joints[0].target = exact.joints[0].columns[0].1.iter().map(double).collect();
        let (value, std) = fit(&exact, Method::Robust);
        assert!(
            (value - 2.0).abs() < 1e-12 && std.is_finite(),
            "{value} {std}"
        );
    }
}
