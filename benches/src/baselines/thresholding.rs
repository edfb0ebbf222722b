//! Sequentially thresholded least squares (Brunton, Proctor & Kutz 2016): fit, drop what is small, fit again. The threshold by ten-fold
//! cross-validation with the rule of one standard error.

use faer::linalg::solvers::Solve;
use faer::{Mat, Side};

use super::Choice;
use super::products::Products;
use super::rows::Rows;

/// Thresholds, from the target's root mean square to this share of it.
const STEPS: u32 = 40;
const LEAST: f64 = 1e-3;

/// How often what is small is dropped.
const DROPS: usize = 20;

/// Ridge, of columns whose mean square is one: some of them are next to each other.
const RIDGE: f64 = 1e-4;

/// Effects with a coefficient that stays, by the power of their part.
#[must_use]
pub fn thresholding(rows: &Rows) -> Vec<Choice> {
    let size = rows.products().power.sqrt();
    let steps: Vec<f64> = (0..STEPS)
        .map(|k| size * LEAST.powf(f64::from(k) / f64::from(STEPS - 1)))
        .collect();
    rows.choices(&rows.cross_validated(path, &steps))
}

/// What stays at each threshold.
fn path(products: &Products, thresholds: &[f64]) -> Vec<Vec<f64>> {
    let every: Vec<usize> = (0..products.columns()).collect();
    let first = fitted(products, &every);
    let stays = |threshold: &f64| {
        let mut found = first.clone();
        let mut before = every.len();
        for _ in 0..DROPS {
            let is_large = |column: &usize| found[*column].abs() >= *threshold;
            let large: Vec<usize> = every.iter().copied().filter(is_large).collect();
            if large.len() == before {
                break;
            }
            before = large.len();
            found = fitted(products, &large);
        }
        let small = |value: &mut f64| {
            if value.abs() < *threshold {
                *value = 0.0;
            }
        };
        found.iter_mut().for_each(small);
        found
    };
    thresholds.iter().map(stays).collect()
}

/// Ridge regression on some columns, the others zero.
fn fitted(products: &Products, columns: &[usize]) -> Vec<f64> {
    let mut all = vec![0.0; products.columns()];
    if columns.is_empty() {
        return all;
    }
    let gram = Mat::from_fn(columns.len(), columns.len(), |a, b| {
        products.gram[(columns[a], columns[b])] + if a == b { RIDGE } else { 0.0 }
    });
    let right = Mat::from_fn(columns.len(), 1, |a, _| products.with_target[columns[a]]);
    let found = match gram.llt(Side::Lower) {
        Ok(factor) => factor.solve(&right),
        // Rounding may leave next to nothing of a column that others say, or less.
        Err(_) => gram.partial_piv_lu().solve(&right),
    };
    for (place, column) in columns.iter().enumerate() {
        all[*column] = found[(place, 0)];
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_small_is_dropped_and_the_rest_fitted_again() {
        // The target is the first column; the second is half of it, and takes in what is left at first.
        let products = Products {
            gram: Mat::from_fn(2, 2, |a, b| if a == b { 1.0 } else { 0.5 }),
            with_target: vec![1.1, 0.65],
            power: 1.3,
        };
        let path = path(&products, &[2.0, 0.5, 0.01]);
        assert_eq!(path[0], [0.0, 0.0]);
        assert!((path[1][0] - 1.1).abs() < 1e-3, "{path:?}");
        assert!(path[1][1].abs() <= 0.0);
        assert!((path[2][0] - 1.033).abs() < 1e-3 && (path[2][1] - 0.133).abs() < 1e-3);
    }
}
