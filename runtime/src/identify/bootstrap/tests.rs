use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use super::*;
use crate::columns::Unknown;
use crate::identify::{Identify, JointRows, Method, Stack, robust};

/// `tau = 2 x + 3 y + noise`, with noise over so many rows alike.
fn stack(seed: u64, slow: f64) -> Stack {
    const COUNT: i32 = 4000;
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let series = |f: &dyn Fn(f64) -> f64| -> Vec<f64> {
        (0..COUNT).map(|k| f(0.1 * f64::from(k))).collect()
    };
    let columns = vec![
        (0, series(&|t| (0.31 * t).sin())),
        (1, series(&|t| t.cos())),
    ];
    let (mut state, keep) = (0.0, (-1.0 / slow).exp());
    let noise = columns[0].1.iter().map(|_| {
        let white: f64 = StandardNormal.sample(&mut random);
        state = keep * state + (1.0_f64 - keep * keep).sqrt() * white;
        state
    });
    let noise: Vec<f64> = noise.collect();
    let target: Vec<f64> = (0..noise.len())
        .map(|k| 2.0 * columns[0].1[k] + 3.0 * columns[1].1[k] + noise[k])
        .collect();
    let unknown = |name: &str| Unknown {
        name: name.to_owned(),
        nonnegative: false,
    };
    Stack {
        unknowns: vec![unknown("x"), unknown("y")],
        joints: vec![JointRows {
            tau: target.clone(),
            target,
            columns,
        }],
        ..Stack::default()
    }
}

fn bootstrap(stack: &Stack, draws: usize) -> (Solution, Result<Bootstrap, IdentifyError>) {
    let solution = Identify::default().solve_stack(stack).expect("enough");
    let weights = vec![vec![1.0; stack.samples()]];
    let found = intervals(stack, &solution, &weights, draws);
    (solution, found)
}

#[test]
fn intervals_hold_the_truth_about_as_often_as_they_say() {
    const LOGS: u32 = 150;
    // Of the last there are some ten blocks.
    for slow in [0.5, 8.0, 35.0] {
        let (mut inside, mut refused) = ([0; 2], 0);
        for seed in 0..LOGS {
            let (_, found) = bootstrap(&stack(seed.into(), slow), 200);
            // Noise that is slower than it is in the mean leaves too few blocks of some logs.
            let Ok(found) = found else {
                refused += 1;
                continue;
            };
            let intervals = found.intervals;
            for (k, truth) in [2.0, 3.0].into_iter().enumerate() {
                let [low, high] = intervals[k].expect("excited");
                inside[k] += u32::from(low < truth && truth < high);
            }
        }
        assert!(refused <= LOGS / 20, "{slow}: {refused}");
        for inside in inside {
            let share = f64::from(inside) / f64::from(LOGS - refused);
            assert!((0.90..=0.987).contains(&share), "{slow}: {share}");
        }
    }
}

#[test]
fn draws_are_the_same_each_time() {
    let stack = stack(3, 4.0);
    let (solution, first) = bootstrap(&stack, 100);
    let (_, second) = bootstrap(&stack, 100);
    assert_eq!(first, second);
    let first = first.expect("long enough");
    assert_eq!((first.draws, first.intervals.len()), (100, 2));
    for (interval, value) in first.intervals.iter().zip(&solution.estimate) {
        let [low, high] = interval.expect("excited");
        assert!(low < *value && *value < high);
    }
}

#[test]
fn errors_alike_over_the_whole_log_have_no_blocks() {
    let (_, found) = bootstrap(&stack(1, 3000.0), 100);
    let error = found.expect_err("one block");
    assert!(
        matches!(error, IdentifyError::FewBlocks { blocks: 6, .. }),
        "{error}"
    );
}

#[test]
fn few_draws_have_no_interval() {
    let (_, found) = bootstrap(&stack(3, 4.0), 99);
    let error = found.expect_err("99 draws");
    let least = IdentifyError::Draws {
        draws: 99,
        least: 100,
    };
    assert_eq!(error, least);
}

#[test]
fn what_few_blocks_tell_has_no_interval() {
    // A column that is there in one place of the log alone: some draws do not have it.
    let mut stack = stack(2, 4.0);
    let touched: Vec<f64> = (0..stack.samples())
        .map(|k| if (700..720).contains(&k) { 1.0 } else { 0.0 })
        .collect();
    stack.unknowns.push(Unknown {
        name: "stop".to_owned(),
        nonnegative: false,
    });
    stack.joints[0].columns.push((2, touched));
    let (_, found) = bootstrap(&stack, 200);
    let error = found.expect_err("a third of the draws miss it");
    assert!(
        matches!(error, IdentifyError::FewDraws { draws: 200, .. }),
        "{error}"
    );
}

/// Where residuals are cut off, an estimate answers to the others alone: intervals are as wide as estimates spread.
#[test]
fn intervals_of_robust_estimates_are_as_wide_as_these_spread() {
    const LOGS: u64 = 60;
    let identify = Identify {
        method: Method::Robust,
        ..Identify::default()
    };
    let (mut width, mut squares) = (0.0, 0.0);
    for seed in 0..LOGS {
        let stack = stack(seed, 0.5);
        let solution = identify.solve_stack(&stack).expect("enough");
        let weights = robust::weights(&stack, &solution.estimate);
        let found = intervals(&stack, &solution, &weights, 200).expect("long enough");
        let [low, high] = found.intervals[0].expect("excited");
        width += (high - low) / (2.0 * 1.96);
        squares += (solution.estimate[0] - 2.0).powi(2);
    }
    let told_over_spread = width / LOGS as f64 / (squares / LOGS as f64).sqrt();
    assert!(
        (0.85..1.2).contains(&told_over_spread),
        "{told_over_spread}"
    );
}
