//! Ridge regression toward CAD: nominal values as measurements of their own.
//!
//! `minimize sum_j || tau_j - W_j beta ||^2 / (sigma_j^2 t_j) + sum_c (beta_c - beta_cad,c)^2 / (d s_c)^2`, where `t_j` samples count as one, `s_c` is
//! how large the parameter is of bodies of that mass and extent, and `d` the share of it by which CAD is off. Where the logs tell a
//! parameter better than that they decide, else CAD does; deviations are those of both together. Source: Hoerl, Kennard 1970,
//! Ridge regression; with these weights it is the maximum of the posterior density for normal errors.

use faer::Mat;
use faer::linalg::solvers::{Solve, SolveLstsq};

use super::combination::shared;
use super::least_squares::{Excited, Factors, Solution, condition};
use super::stack::Stack;
use super::{IdentifyError, Nominal};

/// That of the rows of a stack, see [`of_factors`].
pub(super) fn make(
    nominal: &[Option<Nominal>],
    prior: f64,
    solution: &mut Solution,
    stack: &Stack,
) -> Result<(), IdentifyError> {
    let worth = solution.worth(stack);
    let of_noise = vec![1.0; nominal.len()];
    of_factors(
        nominal,
        prior,
        solution,
        (&Factors::new(stack), &worth),
        &of_noise,
    )
}

/// Puts the estimate of logs and nominal values together in the place of that of the logs.
///
/// `nominal` has one entry an unknown, `None` where the spec gives no value; `prior` is `d`; `worth` is `sigma sqrt(t)` of each joint;
/// `of_noise` is by how many times the variance that the noise of the logs makes is larger than that, unknown by unknown.
pub(super) fn of_factors(
    nominal: &[Option<Nominal>],
    prior: f64,
    solution: &mut Solution,
    (factors, worth): (&Factors, &[f64]),
    of_noise: &[f64],
) -> Result<(), IdentifyError> {
    if !(prior > 0.0 && prior.is_finite()) {
        return Err(IdentifyError::Prior { prior });
    }
    if nominal.iter().all(Option::is_none) {
        return Err(IdentifyError::NoNominal);
    }
    let told = factors.stacked(worth);
    let n = nominal.len();
    let mut all = Mat::zeros(told.nrows() + n, n + 1);
    all.submatrix_mut(0, 0, told.nrows(), n + 1)
        .copy_from(&told);
    let mut information = vec![0.0; n];
    for (c, nominal) in nominal.iter().enumerate() {
        if let Some(Nominal { value, size }) = nominal {
            let row = told.nrows() + c;
            let deviation = prior * size;
            information[c] = deviation.powi(-2);
            all[(row, c)] = 1.0 / deviation;
            all[(row, n)] = value / deviation;
        }
    }
    let excited = Excited::new(&all, n);
    let is_in = |c: &usize| excited.columns.binary_search(c).is_err();
    solution.unexcited = (0..n).filter(is_in).collect();
    let shared = shared(&all, &excited, &solution.unexcited);
    let Excited {
        columns,
        norms,
        kept,
        ..
    } = excited;
    let right = Mat::from_fn(all.nrows(), 1, |row, _| all[(row, n)]);
    solution.condition = condition(&kept);
    let qr = kept.qr();
    let solved = qr.solve_lstsq(&right);
    let inverse = (kept.transpose() * &kept)
        .partial_piv_lu()
        .solve(Mat::<f64>::identity(columns.len(), columns.len()));
    solution.estimate = vec![0.0; n];
    solution.std = vec![0.0; n];
    for (k, &c) in columns.iter().enumerate() {
        solution.estimate[c] = solved[(k, 0)] / norms[c];
        // What the logs' noise has of it, and what nominal values have that are off.
        let of_prior = |(other, c): (usize, &usize)| {
            let information = information[*c] / norms[*c].powi(2);
            inverse[(k, other)].powi(2) * information
        };
        let of_prior: f64 = columns.iter().enumerate().map(of_prior).sum();
        let of_logs = (inverse[(k, k)] - of_prior).max(0.0);
        solution.std[c] = (of_noise[c] * of_logs + of_prior).sqrt() / norms[c];
    }
    // Nominal values part what the logs do not; where there are none either, sums are all that is told.
    solution.shared = shared;
    solution.sigma = factors.sigma(&solution.estimate, columns.len());
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::columns::{Entry, Unknown};
    use crate::identify::{Identify, JointRows, Segment, Shared};

    /// `tau = 2 x + 3 y + noise` with alternating noise of 0.5, where `y` follows `x` as close as wanted.
    fn stack(apart: f64) -> Stack {
        const COUNT: i32 = 1000;
        let series = |f: &dyn Fn(f64, f64) -> f64| -> Vec<f64> {
            let at = |k: i32| f((0.1 * f64::from(k)).sin(), (0.237 * f64::from(k)).cos());
            (0..COUNT).map(at).collect()
        };
        let columns = vec![
            (0, series(&|x, _| x)),
            (1, series(&|x, other| x + apart * other)),
        ];
        let target = (0..columns[0].1.len())
            .map(|k| 2.0 * columns[0].1[k] + 3.0 * columns[1].1[k] + noise(k))
            .collect::<Vec<f64>>();
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
            segments: vec![Segment {
                start: 0,
                time: Vec::new(),
            }],
            ..Stack::default()
        }
    }

    /// White enough, of deviation 0.5.
    fn noise(k: usize) -> f64 {
        let bits = (k as u64 + 1)
            .wrapping_mul(0x9E37_79B9_7F4A_7C15)
            .rotate_left(23);
        if bits.count_ones().is_multiple_of(2) {
            0.5
        } else {
            -0.5
        }
    }

    fn ridge(
        stack: &Stack,
        nominal: [Option<f64>; 2],
        prior: f64,
    ) -> Result<Solution, IdentifyError> {
        let mut solution = Identify::default().solve_stack(stack)?;
        let nominal = nominal.map(|value| value.map(|value| Nominal { value, size: 2.0 }));
        make(&nominal, prior, &mut solution, stack)?;
        Ok(solution)
    }

    /// Of one unknown: `(told / s^2 + cad / p^2) / (1 / s^2 + 1 / p^2)`.
    #[test]
    fn values_are_means_by_information() {
        let mut one = stack(0.0);
        one.silence(&[1]);
        let told = Identify::default().solve_stack(&one).expect("samples");
        // Deviation of least squares by its own formula, which knows the correlation time.
        let (value, std) = (told.estimate[0], told.std[0]);
        let prior = std / 2.0;
        let found = ridge(&one, [Some(7.0), None], prior).expect("nominal");
        assert!(
            (found.estimate[0] - 0.5 * (value + 7.0)).abs() < 1e-6,
            "{found:?}"
        );
        assert!((found.std[0] - std / 2.0_f64.sqrt()).abs() < 1e-6 * std);
        assert_eq!(found.unexcited, [1]);
    }

    #[test]
    fn what_the_logs_do_not_part_is_parted_by_cad() {
        // The sum is 5; CAD says 2.5 and 2.6.
        let found = ridge(&stack(0.0), [Some(2.5), Some(2.6)], 0.1).expect("nominal");
        let sum = found.estimate[0] + found.estimate[1];
        assert!((sum - 5.0).abs() < 0.1, "{found:?}");
        let difference = found.estimate[1] - found.estimate[0];
        assert!((difference - 0.1).abs() < 1e-6, "{found:?}");
        assert!(found.unexcited.is_empty());
        // Each as unsure as CAD has the difference.
        assert!(
            (found.std[0] - 0.2 / 2.0_f64.sqrt()).abs() < 0.01,
            "{found:?}"
        );
        // With logs that part them CAD has no say.
        let found = ridge(&stack(1.0), [Some(2.5), Some(2.6)], 1.0).expect("nominal");
        assert!((found.estimate[0] - 2.0).abs() < 0.1, "{found:?}");
    }

    /// `y` does what `x` does, and CAD knows of neither.
    #[test]
    fn what_cad_does_not_know_either_is_told_in_sums() {
        let mut stack = stack(0.0);
        let wave = (0..stack.samples()).map(|k| (0.411 * k as f64).cos());
        let entry = Entry {
            joint: 0,
            column: 0,
            values: wave.collect(),
        };
        let unknown = Unknown {
            name: "z".to_owned(),
            nonnegative: false,
        };
        stack.append(&[unknown], &[entry]);
        let mut solution = Identify::default().solve_stack(&stack).expect("samples");
        let size = Nominal {
            value: 0.1,
            size: 2.0,
        };
        let nominal = [None, None, Some(size)];
        make(&nominal, 0.3, &mut solution, &stack).expect("nominal");
        let [Shared { lead, others }] = &solution.shared[..] else {
            panic!("{solution:?}");
        };
        assert_eq!(solution.unexcited, [others[0].0], "{solution:?}");
        assert!(others.len() == 1 && lead + others[0].0 == 1);
        assert!((others[0].1 - 1.0).abs() < 1e-6, "{solution:?}");
        assert!((solution.estimate[*lead] - 5.0).abs() < 0.1);
        assert!(solution.estimate[2].abs() < 0.1, "{solution:?}");
    }

    #[test]
    fn without_nominal_values_there_is_none() {
        let said = ridge(&stack(1.0), [None, None], 0.3).expect_err("nothing to go to");
        assert_eq!(said, IdentifyError::NoNominal);
        let said = ridge(&stack(1.0), [Some(1.0), None], 0.0).expect_err("no deviation");
        assert_eq!(said, IdentifyError::Prior { prior: 0.0 });
    }
}
