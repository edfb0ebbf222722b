//! Total least squares on columns whose errors are known.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use super::*;
use crate::columns::Unknown;
use crate::identify::{Identify, JointRows, Method, Segment};

const TRUTH: [f64; 2] = [2.0, -0.7];

/// Two columns with noise of a third of their size, and torque with as much.
fn stack(seed: u64) -> Stack {
    const SHARE: f64 = 0.3;
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut normal = move || -> f64 { StandardNormal.sample(&mut random) };
    let clean: [Vec<f64>; 2] = [1.0, 4.0].map(|size| (0..600).map(|_| size * normal()).collect());
    let torque: Vec<f64> = (0..600)
        .map(|k| TRUTH[0] * clean[0][k] + TRUTH[1] * clean[1][k])
        .collect();
    let mut worn = |values: &[f64]| -> Vec<f64> {
        let square: f64 = values.iter().map(|x| x * x).sum();
        let size = SHARE * (square / values.len() as f64).sqrt();
        values.iter().map(|x| x + size * normal()).collect()
    };
    let target = worn(&torque);
    let columns = [0, 1].map(|c| (c, worn(&clean[c])));
    let unknown = |name: &str| Unknown {
        name: name.to_owned(),
        nonnegative: false,
    };
    Stack {
        unknowns: vec![unknown("x"), unknown("y")],
        joints: vec![JointRows {
            tau: target.clone(),
            target,
            columns: columns.to_vec(),
        }],
        segments: vec![Segment {
            start: 0,
            time: Vec::new(),
        }],
        ..Stack::default()
    }
}

fn fit(stack: &Stack, method: Method) -> Solution {
    let identify = Identify {
        method,
        ..Identify::default()
    };
    let mut solution = identify.solve_stack(stack).expect("samples enough");
    if method == Method::Total {
        make(&mut solution, stack, Weights::Residual).expect("a direction");
    }
    solution
}

#[test]
fn columns_with_errors_bias_least_squares_and_not_the_total_one() {
    // The spread of so many is known within 2 %.
    const DRAWS: u32 = 1000;
    let mut mean = [[0.0; 2]; 2];
    let (mut errors, mut told) = ([0.0; 2], [0.0; 2]);
    for seed in 0..DRAWS {
        let stack = stack(u64::from(seed));
        for (mean, method) in mean.iter_mut().zip([Method::Wls, Method::Total]) {
            let solution = fit(&stack, method);
            for c in 0..2 {
                mean[c] += solution.estimate[c] / f64::from(DRAWS);
                if method == Method::Total {
                    errors[c] += (solution.estimate[c] - TRUTH[c]).powi(2) / f64::from(DRAWS);
                    told[c] += solution.std[c].powi(2) / f64::from(DRAWS);
                }
            }
        }
    }
    for c in 0..2 {
        // A column with noise of variance 0.09 of its own: 1 / 1.09.
        assert!(
            (mean[0][c] / TRUTH[c] - 1.0 / 1.09).abs() < 0.01,
            "{mean:?}"
        );
        assert!((mean[1][c] / TRUTH[c] - 1.0).abs() < 0.01, "{mean:?}");
        let ratio = (told[c] / errors[c]).sqrt();
        assert!((ratio - 1.0).abs() < 0.12, "{ratio}");
    }
}

/// An offset of the torque that hides nothing of the others, though it is larger than they are.
#[test]
fn constant_columns_have_no_errors() {
    const DRAWS: u32 = 1000;
    let mut mean = [0.0; 3];
    let (mut errors, mut told) = ([0.0; 3], [0.0; 3]);
    let truth = [TRUTH[0], TRUTH[1], 3.0];
    for seed in 0..DRAWS {
        let mut stack = stack(u64::from(seed));
        stack.unknowns.push(Unknown {
            name: "offset".to_owned(),
            nonnegative: false,
        });
        let rows = &mut stack.joints[0];
        rows.columns.push((2, vec![1.0; 600]));
        rows.target
            .iter_mut()
            .for_each(|torque| *torque += truth[2]);
        let solution = fit(&stack, Method::Total);
        for c in 0..3 {
            mean[c] += solution.estimate[c] / f64::from(DRAWS);
            errors[c] += (solution.estimate[c] - truth[c]).powi(2) / f64::from(DRAWS);
            told[c] += solution.std[c].powi(2) / f64::from(DRAWS);
        }
    }
    for c in 0..3 {
        let ratio = (told[c] / errors[c]).sqrt();
        assert!((ratio - 1.0).abs() < 0.12, "{c}: {ratio}");
        assert!((mean[c] / truth[c] - 1.0).abs() < 0.05, "{mean:?}");
    }
}

#[test]
fn without_errors_it_is_least_squares() {
    let mut exact = stack(5);
    let columns = exact.joints[0].columns.clone();
    exact.joints[0].target = (0..600)
        .map(|k| 3.0 * columns[0].1[k] + columns[1].1[k])
        .collect();
    let found = fit(&exact, Method::Total).estimate;
    assert!(
        (found[0] - 3.0).abs() < 1e-9 && (found[1] - 1.0).abs() < 1e-9,
        "{found:?}"
    );
}

#[test]
fn torque_that_is_nothing_has_no_total_estimate() {
    let mut silent = stack(5);
    let mut solution = fit(&silent, Method::Wls);
    silent.joints[0].target.fill(0.0);
    let found = make(&mut solution, &silent, Weights::Residual);
    assert_eq!(found, Err(IdentifyError::NoTotal));
}

#[test]
fn columns_that_errors_hide_have_no_total_estimate() {
    let mut alike = stack(5);
    let first = alike.joints[0].columns[0].1.clone();
    let other = &mut alike.joints[0].columns[1].1;
    for (other, first) in other.iter_mut().zip(&first) {
        *other = first + 0.01 * *other;
    }
    // Noise of another stack beside what both columns are.
    let noise = stack(6).joints[0].target.clone();
    let pairs = first.iter().zip(&noise);
    alike.joints[0].target = pairs.map(|(first, noise)| first + 0.3 * noise).collect();
    let mut solution = fit(&alike, Method::Wls);
    let found = make(&mut solution, &alike, Weights::Residual);
    assert_eq!(found, Err(IdentifyError::TotalApart));
}
