//! Weights and correlation times whose values are known.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use crate::columns::Unknown;
use crate::identify::correlation_time;
use crate::identify::{Fitted, Identify, IdentifyError, JointRows, Method, Stack, Weights};

/// One unknown that each joint measures as it is: the estimate is the mean of the joints' means by their weights.
fn stack(joints: &[&[f64]]) -> Stack {
    let rows = |tau: &&[f64]| JointRows {
        tau: tau.to_vec(),
        target: tau.to_vec(),
        columns: vec![(0, vec![1.0; tau.len()])],
    };
    Stack {
        unknowns: vec![Unknown {
            name: "x".to_owned(),
            nonnegative: false,
        }],
        joints: joints.iter().map(rows).collect(),
        ..Stack::default()
    }
}

#[test]
fn each_kind_of_weights_has_its_own_mean() {
    // Means 2 and 3, variances 1 and 2.625, largest values 3 and 3 + 7 d.
    let d = 0.375_f64.sqrt();
    let first = [1.0, 3.0, 1.0, 3.0, 1.0, 3.0, 1.0, 3.0];
    let mut second = [3.0 - d; 8];
    second[5] = 3.0 + 7.0 * d;
    let stack = stack(&[&first, &second]);
    let mean = |one: f64, other: f64| (2.0 / one + 3.0 / other) / (1.0 / one + 1.0 / other);
    let found = |method: Method, weights: Weights| {
        let identify = Identify {
            method,
            weights,
            ..Identify::default()
        };
        identify
            .solve_stack(&stack)
            .expect("samples enough")
            .estimate[0]
    };
    let sum = |x: f64, variance: f64| 8.0 * (x * x + variance);
    let cases = [
        (Method::Ls, Weights::Residual, 2.5),
        (
            Method::Wls,
            Weights::TorqueNorm,
            mean(sum(2.0, 1.0), sum(3.0, 2.625)),
        ),
        (
            Method::Wls,
            Weights::MaxTorque,
            mean(9.0, (3.0 + 7.0 * d).powi(2)),
        ),
        // A quarter of the way, where residuals have the squares 1 + 1/16 and 2.625 + 9/16, is their own mean: 17 : 51 = 1 : 3.
        (Method::Wls, Weights::Residual, 2.25),
    ];
    for (method, weights, mean) in cases {
        let value = found(method, weights);
        assert!(
            (value - mean).abs() < 1e-4,
            "{weights:?}: {value}, not {mean}"
        );
    }
    let apart = |a: usize, b: usize| (cases[a].2 - cases[b].2).abs();
    assert!(apart(1, 2) > 0.05 && apart(1, 3) > 0.05 && apart(2, 3) > 0.05);
}

/// Of an autoregression `x_k = a x_(k-1) + e_k` it is `(1 + a) / (1 - a)`.
#[test]
fn correlation_time_of_an_autoregression() {
    for share in [0.0, 0.5, 0.8, 0.95] {
        let wanted = (1.0 + share) / (1.0 - share);
        let mut random = ChaCha8Rng::seed_from_u64(5);
        let mut state = 0.0;
        let series = (0..200_000).map(|_| {
            let white: f64 = StandardNormal.sample(&mut random);
            state = share * state + white;
            state + 7.0
        });
        let series: Vec<f64> = series.collect();
        let found = correlation_time(&series);
        assert!(
            (found / wanted - 1.0).abs() < 0.1,
            "{share}: {found}, not {wanted}"
        );
    }
}

/// Two joints with noise, the first of so many rows.
fn noisy(rows: [usize; 2]) -> Stack {
    let mut random = ChaCha8Rng::seed_from_u64(9);
    let mut normal = move || -> f64 { StandardNormal.sample(&mut random) };
    let both = [400, 400].map(|count| -> Vec<f64> { (0..count).map(|_| 2.0 + normal()).collect() });
    let [first, second] = both;
    stack(&[&first[..rows[0]], &second[..rows[1]]])
}

/// What is said of rows that were left out is what is said where they never were.
#[test]
fn rows_that_were_left_out_do_not_count() {
    let mut cleared = noisy([400, 400]);
    cleared.joints[1].clear(100..400);
    let short = noisy([400, 100]);
    assert_eq!(cleared.counts(), [400, 100]);
    let identify = Identify::default();
    let of = |stack: &Stack| {
        let solution = identify.solve_stack(stack).expect("samples enough");
        let std = identify.deviations(stack, &solution)[0];
        let fitted = Fitted::new(stack, &solution.estimate);
        let effective = fitted.effective_samples.expect("samples are at hand");
        [
            solution.sigma[0],
            solution.sigma[1],
            solution.std[0],
            std,
            effective[0],
            effective[1],
        ]
    };
    for (found, wanted) in of(&cleared).into_iter().zip(of(&short)) {
        assert!((found / wanted - 1.0).abs() < 1e-9, "{found}, not {wanted}");
    }
    assert!((of(&cleared)[1] - 1.0).abs() < 0.2, "{:?}", of(&cleared));
    cleared.joints[0].clear(0..400);
    cleared.joints[1].clear(1..100);
    let refused = identify.solve_stack(&cleared);
    let few = IdentifyError::TooFewSamples {
        rows: 1,
        dof: 2,
        unknowns: 1,
    };
    assert_eq!(refused, Err(few));
}
