//! Forward selection by cross-validation over whole blocks: the effect that lowers the error on held-out blocks most, as long as it lowers
//! it by more than one standard error over the folds: what is there in two folds of ten passes, what is in one does not.

use faer::linalg::solvers::Solve;
use faer::{Mat, Side};

use super::products::Reduced;
use super::rows::{FOLDS, Rows};
use super::{Choice, MOST_EFFECTS};

/// Standard errors of the mean fall over folds that an effect has to be worth.
const STANDARD_ERRORS: f64 = 1.0;

/// Added to the diagonal of a fit of a few columns, whose mean square is one.
const RIDGE: f64 = 1e-6;

/// Effects in the order of their selection.
#[must_use]
pub fn blocked(rows: &Rows) -> Vec<Choice> {
    let labels = rows.labels();
    let trials = rows.trials();
    let folds = rows.reduced();
    let mut found: Vec<Choice> = Vec::new();
    let mut columns: Vec<usize> = Vec::new();
    let mut before = errors(rows, &folds, &columns);
    while found.len() < MOST_EFFECTS {
        let is_new =
            |(effect, _): &&(usize, Vec<usize>)| found.iter().all(|one| one.effect != *effect);
        let tried = trials.iter().filter(is_new).map(|(effect, own)| {
            let with = [columns.as_slice(), own].concat();
            let errors = errors(rows, &folds, &with);
            (errors.iter().sum::<f64>(), errors, *effect, own)
        });
        let Some((_, after, effect, own)) = tried.min_by(|a, b| a.0.total_cmp(&b.0)) else {
            break;
        };
        if !is_beyond_chance(&before, &after) {
            break;
        }
        columns.extend(own);
        before = after;
        let numbers = own.iter().map(|column| labels[*column].number);
        found.push(Choice {
            effect,
            columns: numbers.collect(),
        });
    }
    found
}

/// Mean squared error on each fold with columns that the other folds fit.
fn errors(rows: &Rows, folds: &[Reduced], columns: &[usize]) -> Vec<f64> {
    let of_fold = |(fold, reduced): (usize, &Reduced)| {
        let products = &reduced.products;
        let mut all = vec![0.0; products.columns()];
        let size = columns.len();
        let gram = Mat::from_fn(size, size, |a, b| {
            products.gram[(columns[a], columns[b])] + if a == b { RIDGE } else { 0.0 }
        });
        let right = Mat::from_fn(size, 1, |a, _| products.with_target[columns[a]]);
        if let Ok(factor) = gram.llt(Side::Lower) {
            let solved = factor.solve(&right);
            for (place, column) in columns.iter().enumerate() {
                all[*column] = solved[(place, 0)];
            }
        }
        rows.error(fold, reduced, &all)
    };
    folds.iter().enumerate().map(of_fold).collect()
}

/// Whether the mean fall over folds is so many of its standard errors.
fn is_beyond_chance(before: &[f64], after: &[f64]) -> bool {
    let falls: Vec<f64> = before.iter().zip(after).map(|(a, b)| a - b).collect();
    let count = FOLDS as f64;
    let mean = falls.iter().sum::<f64>() / count;
    let spread = falls.iter().map(|fall| (fall - mean).powi(2)).sum::<f64>();
    mean > STANDARD_ERRORS * (spread / (count - 1.0) / count).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fall_in_one_fold_is_chance() {
        let mut after = vec![1.001; FOLDS];
        after[3] = 0.2;
        assert!(!is_beyond_chance(&[1.0; FOLDS], &after));
        after[4] = 0.2;
        assert!(is_beyond_chance(&[1.0; FOLDS], &after));
        assert!(is_beyond_chance(&[1.0; FOLDS], &[0.9; FOLDS]));
        assert!(!is_beyond_chance(&[1.0; FOLDS], &[1.1; FOLDS]));
    }
}
