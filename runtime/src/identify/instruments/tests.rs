//! Instruments beside least squares, on rows and motions.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use super::*;
use crate::columns::Unknown;
use crate::identify::{Identify, JointRows, Segment};

const TRUTH: f64 = 2.0;

/// Columns with noise of which the torque has a share, as behind a controller; and the columns without.
fn stacks(seed: u64, share: f64) -> [Stack; 2] {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut normal = move || -> f64 { StandardNormal.sample(&mut random) };
    let clean: Vec<f64> = (0..800)
        .map(|k| 1.5 * (0.05 * f64::from(k)).sin())
        .collect();
    let noise: Vec<f64> = clean.iter().map(|_| 0.5 * normal()).collect();
    let target: Vec<f64> = (0..clean.len())
        .map(|k| TRUTH * clean[k] + share * noise[k] + 0.3 * normal())
        .collect();
    let worn = clean.iter().zip(&noise).map(|(x, e)| x + share.abs() * e);
    let worn: Vec<f64> = worn.collect();
    [worn, clean].map(|column| Stack {
        unknowns: vec![Unknown {
            name: "x".to_owned(),
            nonnegative: false,
        }],
        joints: vec![JointRows {
            tau: target.clone(),
            target: target.clone(),
            columns: vec![(0, column)],
        }],
        segments: vec![Segment {
            start: 0,
            time: Vec::new(),
        }],
        ..Stack::default()
    })
}

fn fit(seed: u64, share: f64) -> (Solution, Hausman) {
    let [worn, clean] = stacks(seed, share);
    let mut solution = Identify::default().solve_stack(&worn).expect("samples");
    let hausman = make(&mut solution, &worn, &clean, Weights::Residual).expect("excited");
    (solution, hausman)
}

#[test]
fn noise_that_columns_share_with_torque_biases_least_squares_alone() {
    const DRAWS: u32 = 200;
    let (mut mean, mut ordinary, mut errors, mut told) = (0.0, 0.0, 0.0, 0.0);
    for seed in 0..DRAWS {
        let (solution, hausman) = fit(u64::from(seed), -1.0);
        let draws = f64::from(DRAWS);
        mean += solution.estimate[0] / draws;
        ordinary += hausman.least_squares[0] / draws;
        errors += (solution.estimate[0] - TRUTH).powi(2) / draws;
        told += solution.std[0].powi(2) / draws;
        assert!(hausman.probability < 0.05, "{hausman:?}");
    }
    assert!((mean - TRUTH).abs() < 0.01, "{mean}");
    assert!(ordinary < TRUTH - 0.3, "{ordinary}");
    assert!(
        ((told / errors).sqrt() - 1.0).abs() < 0.12,
        "{told} {errors}"
    );
}

/// Exact columns, instruments that follow them from afar.
#[test]
fn without_noise_in_columns_the_test_is_wrong_in_five_of_a_hundred() {
    let mut wrong = 0;
    for seed in 0..400 {
        let [mut exact, clean] = stacks(seed, 0.0);
        let mut random = ChaCha8Rng::seed_from_u64(1000 + seed);
        let mut instruments = clean.clone();
        for (k, x) in instruments.joints[0].columns[0].1.iter_mut().enumerate() {
            let other: f64 = StandardNormal.sample(&mut random);
            *x += (0.31 * k as f64).sin() + other;
        }
        exact.joints[0].columns.clone_from(&clean.joints[0].columns);
        let mut solution = Identify::default().solve_stack(&exact).expect("samples");
        let hausman = make(&mut solution, &exact, &instruments, Weights::Residual);
        wrong += u32::from(hausman.expect("excited").probability < 0.05);
    }
    assert!((8..36).contains(&wrong), "{wrong}");
}

/// A difference that is sure may be small beside what is known of the estimate.
#[test]
fn a_verdict_says_how_much_a_difference_matters() {
    let said = |probability: f64, off: f64| {
        let hausman = Hausman {
            least_squares: vec![2.0, 0.0],
            least_squares_percent: vec![1.0],
            differences: vec![-4.0, 0.0],
            compared: vec![true, true],
            probability,
        };
        let identified = |name: &str, value: f64, std: f64| Identified {
            name: name.to_owned(),
            value,
            std,
        };
        let parameters = [identified("x", 2.0 + off, 0.1), identified("y", 0.0, 0.0)];
        hausman.verdict(&parameters).expect("parameters")
    };
    let about = |said: &str, words: [&str; 2]| {
        assert!(words.iter().all(|word| said.contains(word)), "{said}");
    };
    about(&said(0.3, 0.1), ["agree", "x differs most"]);
    about(&said(0.001, 0.007), ["is harmless", "and 0.07 of its own"]);
    about(&said(0.001, 0.2), ["they disagree", "and 2.00 of its own"]);
}

#[test]
fn motions_are_the_same_whatever_their_digits() {
    let wave = |size: f64| -> Vec<f64> {
        let samples = 0..100;
        samples
            .map(|k| 1.0 + size * (0.1 * f64::from(k)).sin())
            .collect()
    };
    let rounded = |values: &[f64]| -> Vec<f64> {
        let text = values.iter().map(|q| format!("{q:.7}"));
        text.map(|q| q.parse().expect("a number")).collect()
    };
    let rest = vec![0.3; 100];
    let one = [wave(1.0), rest.clone()];
    assert!(is_same_motion(&one, &[rounded(&wave(1.0)), rest.clone()]));
    assert!(!is_same_motion(&one, &[wave(1.0001), rest.clone()]));
    let stands = [rest];
    assert!(!is_same_motion(&stands, &stands));
}

#[test]
fn columns_that_are_their_own_instruments_agree_with_themselves() {
    for seed in 0..50 {
        let (solution, hausman) = fit(seed, 0.0);
        assert!((solution.estimate[0] - hausman.least_squares[0]).abs() < 1e-12);
        assert!(hausman.probability > 0.999, "{hausman:?}");
    }
}

/// Two columns that move apart in the log, and as one where the noise is not: instruments tell their sum, and the comparison leaves both alone.
#[test]
fn instruments_that_do_not_part_columns_tell_their_sum() {
    let wave = |rate: f64| -> Vec<f64> { (0..800).map(|k| (rate * f64::from(k)).sin()).collect() };
    let mut random = ChaCha8Rng::seed_from_u64(5);
    let mut noise = |size: f64| -> Vec<f64> {
        let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
        (0..800).map(|_| size * normal()).collect()
    };
    let sum = |one: &[f64], share: f64, other: &[f64]| -> Vec<f64> {
        let pairs = one.iter().zip(other);
        pairs.map(|(x, y)| x + share * y).collect()
    };
    let (first, third) = (wave(0.05), wave(0.13));
    let double: Vec<f64> = first.iter().map(|x| 2.0 * x).collect();
    let worn = [first.clone(), sum(&double, 1.0, &noise(0.5)), third.clone()];
    let target = sum(&sum(&first, 1.5, &worn[1]), -0.7, &third);
    let target = sum(&target, 1.0, &noise(0.1));
    let [worn, clean] = [worn, [first, double, third]].map(|columns| {
        let unknown = |name: &str| Unknown {
            name: name.to_owned(),
            nonnegative: false,
        };
        Stack {
            unknowns: ["a", "b", "c"].map(unknown).to_vec(),
            joints: vec![JointRows {
                tau: target.clone(),
                target: target.clone(),
                columns: columns.into_iter().enumerate().collect(),
            }],
            ..stacks(0, 0.0)[0].clone()
        }
    });
    let mut solution = Identify::default().solve_stack(&worn).expect("samples");
    assert!(solution.unexcited.is_empty());
    let hausman = make(&mut solution, &worn, &clean, Weights::Residual).expect("excited");
    let [shared] = &solution.shared[..] else {
        panic!("{:?}", solution.shared);
    };
    let [(other, factor)] = shared.others[..] else {
        panic!("{shared:?}");
    };
    assert_eq!(solution.unexcited, [other]);
    // a + 2 b = 4, however it is written.
    let truth = [1.0, 1.5];
    let expected = truth[shared.lead] + factor * truth[other];
    let off = (solution.estimate[shared.lead] - expected) / solution.std[shared.lead];
    assert!(off.abs() < 3.0, "{off}");
    assert!(!solution.is_told(0) && !solution.is_told(1) && solution.is_told(2));
    assert_eq!(hausman.compared, [false, false, true]);
    assert_eq!(hausman.differences[..2], [0.0, 0.0]);
    assert!(
        hausman.probability > 0.01 && hausman.differences[2].is_finite(),
        "{hausman:?}"
    );
}
