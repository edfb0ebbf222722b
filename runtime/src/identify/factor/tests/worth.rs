//! How many samples count as one, and what that makes of deviations.

use super::*;
use crate::columns::Nominal;
use crate::identify::ridge;

/// Noise that some nineteen samples share: `(1 + 0.9) / (1 - 0.9)`.
#[test]
fn what_a_sample_is_worth_is_told_by_blocks_as_by_rows() {
    let whole = stack(7, 0, 12_000);
    let identify = Identify::default();
    let of_rows = identify.solve_stack(&whole).expect("samples").worth(&whole);
    let worth = |count: usize| {
        let mut factor = empty();
        for part in parts(&whole, count) {
            factor.push_rows(&part);
        }
        let solution = factor.whole().weighted(&[1.0, 1.0]);
        (factor.worth(&solution), solution.sigma)
    };
    let (of_blocks, sigma) = worth(30);
    for ((blocks, rows), sigma) in of_blocks.iter().zip(&of_rows).zip(&sigma) {
        assert!((blocks / rows - 1.0).abs() < 0.25, "{blocks} {rows}");
        let time = (blocks / sigma).powi(2);
        assert!((time / 19.0 - 1.0).abs() < 0.4, "{time}");
    }
    // One block is fitted as well as it can be.
    let (of_one, sigma) = worth(1);
    let pairs = of_one.iter().zip(&sigma);
    assert!(
        pairs.into_iter().all(|(one, sigma)| one < &(3.0 * sigma)),
        "{of_one:?}"
    );
}

/// With nominal values that say next to nothing.
#[test]
fn deviations_beside_nominal_values_are_the_spread_of_the_estimates() {
    const DRAWS: u32 = 200;
    let nominal = TRUTH.map(|value| Some(Nominal { value, size: 1e4 }));
    let (mut errors, mut told) = ([0.0; 3], [0.0; 3]);
    for seed in 0..DRAWS {
        let mut factor = empty();
        for part in parts(&stack(u64::from(seed), 0, 6400), 32) {
            factor.push_rows(&part);
        }
        let factors = factor.whole();
        let mut solution = factors.weighted(&[1.0, 1.0]);
        let worth = factor.worth(&solution);
        let of_noise = factor.beyond_worth(&solution, &factors, &worth);
        ridge::of_factors(&nominal, 1.0, &mut solution, (&factors, &worth), &of_noise)
            .expect("nominal values");
        for c in 0..3 {
            errors[c] += (solution.estimate[c] - TRUTH[c]).powi(2) / f64::from(DRAWS);
            told[c] += solution.std[c].powi(2) / f64::from(DRAWS);
        }
    }
    for c in 0..3 {
        let ratio = (told[c] / errors[c]).sqrt();
        assert!((0.9..1.35).contains(&ratio), "{c}: {ratio}");
    }
}
