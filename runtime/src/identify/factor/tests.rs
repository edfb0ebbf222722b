//! Factors say what rows say.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use super::*;
use crate::columns::Unknown;
use crate::identify::Identify;
use crate::identify::{JointRows, Segment, turns};

mod worth;

const TRUTH: [f64; 3] = [2.0, -0.5, 0.1];

/// Two joints, three unknowns of which the first joint sees two; noise that is correlated over some ten samples.
fn stack(seed: u64, first: usize, count: usize) -> Stack {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut normal = move || -> f64 { StandardNormal.sample(&mut random) };
    let series = |f: &dyn Fn(f64) -> f64| -> Vec<f64> {
        (first..first + count).map(|k| f(k as f64)).collect()
    };
    let columns = [
        vec![
            (0, series(&|k| (0.031 * k).sin())),
            (2, series(&|k| (0.017 * k).cos().signum())),
        ],
        vec![
            (0, series(&|k| (0.043 * k).cos())),
            (1, series(&|k| 3.0 * (0.011 * k).sin())),
            (2, series(&|k| (0.029 * k).sin())),
        ],
    ];
    let joints = columns.map(|columns| {
        let mut noise = 0.0;
        let target: Vec<f64> = (0..count)
            .map(|k| {
                noise = 0.9 * noise + 0.1 * normal();
                let clean: f64 = columns.iter().map(|(c, x)| TRUTH[*c] * x[k]).sum();
                clean + noise
            })
            .collect();
        JointRows {
            tau: target.clone(),
            target,
            columns,
        }
    });
    let unknown = |name: &str| Unknown {
        name: name.to_owned(),
        nonnegative: false,
    };
    Stack {
        unknowns: ["a", "b", "c"].map(unknown).to_vec(),
        joints: joints.to_vec(),
        segments: vec![Segment {
            start: 0,
            time: Vec::new(),
        }],
        ..Stack::default()
    }
}

fn empty() -> Factor {
    Factor {
        unknowns: ["a", "b", "c"].map(str::to_owned).to_vec(),
        joints: ["one", "two"].map(str::to_owned).to_vec(),
        equations: vec![[1.0, 2.0], [-3.0, 5.0]],
        form: Form::Acceleration,
        bands: Bands::DEFAULT,
        blocks: Vec::new(),
    }
}

/// Rows of a whole, block by block.
fn parts(whole: &Stack, count: usize) -> Vec<Stack> {
    let each = whole.samples() / count;
    let part = |k: usize| whole.part(k * each..(k + 1) * each);
    (0..count).map(part).collect()
}

#[test]
fn blocks_say_what_the_whole_says() {
    let whole = stack(7, 0, 12_000);
    let direct = Identify::default().solve_stack(&whole).expect("samples");
    for count in [1, 5, 32, 60, 100] {
        let mut factor = empty();
        for part in parts(&whole, count) {
            factor.push_rows(&part);
        }
        assert_eq!(factor.samples(), 12_000);
        assert_eq!(factor.blocks.len(), count.min(MOST_BLOCKS));
        let found = factor.whole().weighted(&[1.0, 1.0]);
        for (found, direct) in found.estimate.iter().zip(&direct.estimate) {
            assert!((found - direct).abs() < 1e-12, "{count}");
        }
        let errors = factor.rmse(&found.estimate);
        let residuals = whole.residuals(&direct.estimate);
        for (rmse, residual) in errors.iter().zip(residuals) {
            let square: f64 = residual.iter().map(|r| r * r).sum();
            assert!((rmse - (square / 12_000.0).sqrt()).abs() < 1e-10);
        }
        let percent = factor.relative_percent(&found.estimate);
        let expected = whole.relative_percent(&direct.estimate);
        assert!((percent[1] - expected[1]).abs() < 1e-9);
    }
}

#[test]
fn merged_factors_are_those_of_all_logs() {
    let logs = [stack(1, 0, 3000), stack(2, 5000, 2000)];
    let mut one = empty();
    one.push_rows(&logs[0]);
    let mut other = empty();
    other.push_rows(&logs[1]);
    let mut both = one.clone();
    both.push_rows(&logs[1]);
    one.merge(other).expect("the same arm");
    assert_eq!(one, both);
    let mut narrow = empty();
    narrow.bands.shared_hz = 5.0;
    let refused = one.merge(narrow).expect_err("other filters").to_string();
    let told = "different filters (5,30,90 Hz, where 10,30,90 Hz are wanted)";
    assert!(refused.contains(told), "{refused}");
}

#[test]
fn other_equations_are_refused_and_rounding_is_none() {
    let change = |change: [f64; 2]| {
        let mut other = empty();
        other.equations[1][0] += change[0];
        other.equations[1][1] += change[1];
        empty().merge(other)
    };
    assert_eq!(change([1e-12, -1e-12]), Ok(()));
    for other in [[1e-6, 0.0], [0.0, 1e-6], [6.0, 0.0]] {
        let refused = change(other).expect_err("another arm");
        assert!(
            refused.to_string().contains("different equations"),
            "{refused}"
        );
    }
    let mut short = empty();
    short.equations.pop();
    assert!(empty().merge(short).is_err());
}

#[test]
fn parts_of_the_same_log_are_known_again() {
    let factor = |seeds: &[u64]| {
        let mut factor = empty();
        for seed in seeds {
            factor.push_rows(&stack(*seed, 0, 500));
        }
        factor
    };
    let one = factor(&[1, 2]);
    assert_eq!(one.common_parts(&factor(&[3, 4])), 0);
    let mut again = factor(&[3, 2]);
    assert_eq!(one.common_parts(&again), 1);
    for print in &mut again.blocks[1].prints {
        *print *= 1.0 + 2.0 * f64::EPSILON;
    }
    assert_eq!(one.common_parts(&again), 1);
    // Among others, which were merged to keep blocks few.
    let all: Vec<u64> = (0..200).collect();
    assert_eq!(factor(&all).common_parts(&one), 2);
    // Of many some stand for all.
    let many = factor(&(0..5000).collect::<Vec<u64>>());
    assert!(many.blocks.iter().all(|block| block.prints.len() <= 64));
    assert!(many.common_parts(&factor(&(4000..6000).collect::<Vec<u64>>())) > 100);
}

#[test]
fn deviations_from_blocks_are_the_spread_of_the_estimates() {
    const DRAWS: u32 = 300;
    let (mut errors, mut told) = ([0.0; 3], [0.0; 3]);
    for seed in 0..DRAWS {
        let mut factor = empty();
        for part in parts(&stack(u64::from(seed), 0, 6400), 64) {
            factor.push_rows(&part);
        }
        let mut solution = factor.whole().weighted(&[1.0, 1.0]);
        factor.deviations(&mut solution);
        for c in 0..3 {
            errors[c] += (solution.estimate[c] - TRUTH[c]).powi(2) / f64::from(DRAWS);
            told[c] += solution.std[c].powi(2) / f64::from(DRAWS);
        }
    }
    for c in 0..3 {
        let ratio = (told[c] / errors[c]).sqrt();
        assert!((ratio - 1.0).abs() < 0.15, "{c}: {ratio}");
    }
}

/// An unknown that the second joint tells along one of twelve blocks only, beside noise that is correlated.
#[test]
fn what_one_block_tells_is_no_surer_than_its_noise() {
    const DRAWS: u32 = 200;
    let (mut held, mut told) = (0, 0);
    for seed in 0..DRAWS {
        let mut factor = empty();
        for (number, mut part) in parts(&stack(u64::from(seed), 0, 2400), 12)
            .into_iter()
            .enumerate()
        {
            let rows = &mut part.joints[1];
            if number != 7 {
                let (_, silent) = rows.columns.remove(1);
                for (target, x) in rows.target.iter_mut().zip(silent) {
                    *target -= TRUTH[1] * x;
                }
                rows.tau.clone_from(&rows.target);
            }
            factor.push_rows(&part);
        }
        let mut solution = factor.whole().weighted(&[1.0, 1.0]);
        assert_eq!(factor.deviations(&mut solution), [1]);
        let is_held = |c: usize| (solution.estimate[c] - TRUTH[c]).abs() < 1.96 * solution.std[c];
        held += u32::from(is_held(1));
        told += u32::from(is_held(0)) + u32::from(is_held(2));
    }
    let share = |count: u32, of: u32| f64::from(count) / f64::from(of);
    assert!(
        (0.85..=0.99).contains(&share(held, DRAWS)),
        "{}",
        share(held, DRAWS)
    );
    assert!(
        (0.9..=0.99).contains(&share(told, 2 * DRAWS)),
        "{}",
        share(told, 2 * DRAWS)
    );
}

/// Two squares of errors say little of a deviation, which Student's t knows.
#[test]
fn intervals_from_few_blocks_hold_the_truth() {
    const DRAWS: u32 = 200;
    for count in [1, 2, 3, 5, 8] {
        let (mut held, mut furthest) = (0, 0.0_f64);
        for seed in 0..DRAWS {
            let mut factor = empty();
            for part in parts(&stack(u64::from(seed), 0, 200 * count), count) {
                factor.push_rows(&part);
            }
            let mut solution = factor.whole().weighted(&[1.0, 1.0]);
            factor.deviations(&mut solution);
            for (c, truth) in TRUTH.iter().enumerate() {
                let off = (solution.estimate[c] - truth).abs() / solution.std[c];
                held += u32::from(off < 1.96);
                furthest = furthest.max(off);
            }
        }
        let share = f64::from(held) / f64::from(3 * DRAWS);
        if count == 1 {
            // What one block cannot know is that its noise is correlated.
            assert!(share < 0.8, "{share}");
        } else {
            assert!((0.9..=0.99).contains(&share), "{count} blocks: {share}");
            assert!(furthest < 15.0, "{count} blocks: {furthest}");
        }
    }
}

/// Rows around turns of the first joint, among which another friction holds.
fn sticky(seed: u64, count: usize) -> Stack {
    let mut whole = stack(seed, 0, count);
    whole.turns = vec![
        (0..count).filter(|row| row % 185 < 25).collect(),
        Vec::new(),
    ];
    for &row in &whole.turns[0] {
        whole.joints[0].target[row] += 0.2 * whole.joints[0].columns[1].1[row];
    }
    whole
}

#[test]
fn rows_at_turns_move_an_estimate_of_factors_as_that_of_the_rows() {
    let whole = sticky(3, 6000);
    let mut factor = empty();
    for part in parts(&whole, 60) {
        factor.push_rows(&part);
    }
    let at_turns = [whole.turns[0].len(), 0];
    assert_eq!(factor.turns(), at_turns);
    assert_eq!(factor.counts(), [6000, 6000]);
    let away = factor.without_turns();
    let solved = |factor: &Factor| factor.whole().weighted(&[1.0, 1.0]);
    let mut left_out = whole.clone();
    turns::leave_out(&mut left_out);
    for (factor, stack) in [(&factor, &whole), (&away, &left_out)] {
        let direct = Identify::default().solve_stack(stack).expect("samples");
        for (found, direct) in solved(factor).estimate.iter().zip(&direct.estimate) {
            assert!((found - direct).abs() < 1e-10, "{found} {direct}");
        }
        let expected = stack.relative_percent(&direct.estimate);
        let percent = factor.relative_percent(&direct.estimate);
        assert!((percent[0] - expected[0]).abs() < 1e-9);
    }
    let solution = solved(&factor);
    let mut by_factors = [1e-4; 3];
    turns::widen(
        &factor.whole(),
        &away.whole(),
        &solution.scale,
        &mut by_factors,
    );
    let ones = vec![vec![1.0; 6000]; 2];
    let [all, rest] = turns::with_and_without(&whole, &ones);
    let mut by_rows = [1e-4; 3];
    turns::widen(&all, &rest, &solution.scale, &mut by_rows);
    for (one, other) in by_factors.iter().zip(by_rows) {
        assert!((one / other - 1.0).abs() < 1e-9, "{one} {other}");
    }
    assert!(by_rows[2] > 0.01, "{by_rows:?}");
}

/// One unknown of three is moved: by so little that deviations of noise alone grow by less than half, by much, and by nothing.
#[test]
fn rows_at_turns_are_dear_where_they_move_the_estimate_alone() {
    let little = sticky(3, 6000);
    let moved = |by: f64| {
        let mut other = little.clone();
        for &row in &little.turns[0] {
            other.joints[0].target[row] += by * little.joints[0].columns[1].1[row];
        }
        other
    };
    let (much, sound) = (moved(1.8), moved(-0.2));
    let ones = vec![vec![1.0; 6000]; 2];
    let noise = Identify::default()
        .solve_stack(&sound)
        .expect("samples")
        .std;
    for (stack, is_surer_without) in [(little, false), (much, true), (sound, false)] {
        let solution = Identify::default().solve_stack(&stack).expect("samples");
        let [all, rest] = turns::with_and_without(&stack, &ones);
        let mut std = noise.clone();
        let is_surer = turns::widen(&all, &rest, &solution.scale, &mut std);
        assert_eq!(is_surer, is_surer_without, "{std:?} {noise:?}");
    }
}

#[test]
fn it_is_all_the_same_which_factors_are_merged_first() {
    let factor = |seed: u64| {
        let mut factor = empty();
        for part in parts(&sticky(seed, 3000), 10) {
            factor.push_rows(&part);
        }
        factor
    };
    let merged = |one: &Factor, other: &Factor| {
        let mut both = one.clone();
        both.merge(other.clone()).expect("the same arm");
        both
    };
    let [a, b, c] = [1, 2, 3].map(factor);
    let found = [
        merged(&merged(&a, &b), &c),
        merged(&a, &merged(&b, &c)),
        merged(&c, &merged(&a, &b)),
    ]
    .map(|factor| {
        let (all, away) = (factor.whole(), factor.without_turns().whole());
        let mut solution = all.weighted(&[1.0, 1.0]);
        factor.deviations(&mut solution);
        turns::widen(&all, &away, &solution.scale, &mut solution.std);
        solution
    });
    for other in &found[1..] {
        for c in 0..3 {
            assert!((found[0].estimate[c] - other.estimate[c]).abs() < 1e-12);
            let ratio = found[0].std[c] / other.std[c];
            assert!((ratio - 1.0).abs() < 1e-9, "{c}: {ratio}");
        }
    }
}
