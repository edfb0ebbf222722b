//! Rows of a model's columns, of effects' columns and of what is to be explained, cut into folds.

use faer::Mat;
use faer::linalg::solvers::Solve;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::Choice;
use super::products::{Products, Reduced};
use super::screen::screen;

/// Folds of cross-validation.
pub const FOLDS: usize = 10;

/// A column is new if this share of its norm is outside the model's columns, as for the tracer.
pub(super) const LEAST_NEW: f64 = 1e-3;

/// Added to the diagonal of a fit of chosen columns, which may be next to each other.
const RIDGE: f64 = 1e-8;

/// A column of an effect, at values of its shapes.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// Which effect.
    pub effect: usize,
    /// Which values of its shapes.
    pub trial: usize,
    /// One value a row.
    pub values: Vec<f64>,
}

/// A column that was kept.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Label {
    pub(super) effect: usize,
    pub(super) trial: usize,
    /// Place among all that were given.
    pub(super) number: usize,
}

/// Coefficients of all columns at every step, of a penalty or a threshold.
pub(super) type Path = fn(&Products, &[f64]) -> Vec<Vec<f64>>;

/// Rows, cut into folds.
#[derive(Debug)]
pub struct Rows {
    /// An orthonormal basis of the model's columns, what it leaves of the effects' columns, and of the target.
    table: Mat<f64>,
    model: usize,
    labels: Vec<Label>,
    /// Of each fold its rows.
    folds: Vec<Vec<usize>>,
    /// Products of the table's columns per row, over all rows and over those of each fold.
    all: Mat<f64>,
    of_folds: Vec<Mat<f64>>,
}

impl Rows {
    /// Weighted rows, cut by the fold of each. Columns that the model says are left out, and the least of too many.
    #[must_use]
    pub fn new(
        model: &[Vec<f64>],
        columns: &[Column],
        target: &[f64],
        fold_of_row: &[usize],
    ) -> Self {
        let mut basis: Vec<Vec<f64>> = Vec::new();
        for column in model {
            basis.extend(new_of(column, &basis));
        }
        let mut left = target.to_vec();
        take_out(&mut left, &basis);
        let mut kept: Vec<(Label, Vec<f64>)> = Vec::new();
        for (number, column) in columns.iter().enumerate() {
            let Column { effect, trial, .. } = *column;
            let label = Label {
                effect,
                trial,
                number,
            };
            kept.extend(new_of(&column.values, &basis).map(|values| (label, values)));
        }
        screen(&mut kept, &left);
        let mut labels = Vec::new();
        let model = basis.len();
        let mut all = basis;
        for (label, values) in kept {
            labels.push(label);
            all.push(values);
        }
        all.push(left);
        let table = Mat::from_fn(target.len(), all.len(), |row, column| all[column][row]);
        let mut folds = vec![Vec::new(); FOLDS];
        for (row, fold) in fold_of_row.iter().enumerate() {
            folds[*fold].push(row);
        }
        let of_folds: Vec<Mat<f64>> = folds.iter().map(|rows| products(&table, rows)).collect();
        let mut sum = Mat::zeros(all.len(), all.len());
        for of_fold in &of_folds {
            sum += of_fold;
        }
        Self {
            table,
            model,
            labels,
            folds,
            all: sum,
            of_folds,
        }
    }

    /// How many rows.
    #[must_use]
    pub fn count(&self) -> usize {
        self.table.nrows()
    }

    /// How many columns the model has of its own.
    pub(super) fn model(&self) -> usize {
        self.model
    }

    /// The columns.
    pub(super) fn labels(&self) -> &[Label] {
        &self.labels
    }

    /// Effect and columns of every trial.
    pub(super) fn trials(&self) -> Vec<(usize, Vec<usize>)> {
        let columns: Vec<usize> = (0..self.labels.len()).collect();
        let trial = |column: usize| (self.labels[column].effect, self.labels[column].trial);
        let trials = columns.chunk_by(|a, b| trial(*a) == trial(*b));
        trials.map(|own| (trial(own[0]).0, own.to_vec())).collect()
    }

    /// Products over all rows.
    pub(super) fn products(&self) -> Products {
        Reduced::new(&per_row(&self.all, self.count()), self.model).products
    }

    /// Coefficients on all rows at the sparsest step of a path whose error on held-out rows is within a standard error of the least
    /// (Breiman et al. 1984); `path` gives coefficients for every step, and steps are from the sparsest on.
    pub(super) fn cross_validated(&self, path: Path, steps: &[f64]) -> Vec<f64> {
        let folds = self.reduced().into_iter().enumerate();
        let errors = folds.map(|(fold, reduced)| -> Vec<f64> {
            let path = path(&reduced.products, steps);
            let error = |coefficients: &Vec<f64>| self.error(fold, &reduced, coefficients);
            path.iter().map(error).collect()
        });
        let errors: Vec<Vec<f64>> = errors.collect();
        let step = one_standard_error(&errors);
        let mut path = path(&self.products(), &steps[..=step]);
        path.pop().unwrap_or_default()
    }

    /// Products over the rows outside each fold, without the model.
    pub(super) fn reduced(&self) -> Vec<Reduced> {
        let of_fold = |fold| Reduced::new(&self.train(fold), self.model);
        (0..FOLDS).map(of_fold).collect()
    }

    /// Effects by the power of what their coefficients make.
    pub(super) fn choices(&self, coefficients: &[f64]) -> Vec<Choice> {
        let products = self.products();
        let mut effects: Vec<usize> = self.labels.iter().map(|label| label.effect).collect();
        effects.dedup();
        let mut found: Vec<(f64, Choice)> = Vec::new();
        for effect in effects {
            let is_there = |column: &usize| {
                self.labels[*column].effect == effect && coefficients[*column].abs() > 0.0
            };
            let columns: Vec<usize> = (0..coefficients.len()).filter(is_there).collect();
            if !columns.is_empty() {
                let power = products.power_of(&columns, coefficients);
                let columns = columns.iter().map(|c| self.labels[*c].number).collect();
                found.push((power, Choice { effect, columns }));
            }
        }
        found.sort_by(|a, b| b.0.total_cmp(&a.0));
        found.into_iter().map(|(_, choice)| choice).collect()
    }

    /// What the model with some columns, by their places among all that were given, leaves of every row, which was not among those that
    /// it was fitted on.
    #[must_use]
    pub fn held_out(&self, columns: &[usize]) -> Vec<f64> {
        let target = self.table.ncols() - 1;
        let own = (0..self.labels.len()).filter(|c| columns.contains(&self.labels[*c].number));
        let used: Vec<usize> = (0..self.model).chain(own.map(|c| self.model + c)).collect();
        let mut left: Vec<f64> = (0..self.count())
            .map(|row| self.table[(row, target)])
            .collect();
        if used.is_empty() {
            return left;
        }
        for (fold, rows) in self.folds.iter().enumerate() {
            let train = self.train(fold);
            let own = Mat::from_fn(used.len(), used.len(), |a, b| {
                train[(used[a], used[b])] + if a == b { RIDGE } else { 0.0 }
            });
            let right = Mat::from_fn(used.len(), 1, |a, _| train[(used[a], target)]);
            let found = own.partial_piv_lu().solve(&right);
            for &row in rows {
                let said = used.iter().enumerate();
                left[row] -= said
                    .map(|(k, column)| found[(k, 0)] * self.table[(row, *column)])
                    .sum::<f64>();
            }
        }
        left
    }

    /// Products over the rows outside a fold, per row.
    fn train(&self, fold: usize) -> Mat<f64> {
        let rows = self.count() - self.folds[fold].len();
        per_row(&(&self.all - &self.of_folds[fold]), rows)
    }

    /// Mean squared error on a fold's rows.
    pub(super) fn error(&self, fold: usize, reduced: &Reduced, coefficients: &[f64]) -> f64 {
        let columns = coefficients.len();
        let there: Vec<usize> = (0..columns)
            .filter(|c| coefficients[*c].abs() > 0.0)
            .collect();
        let of_model = |a: usize| {
            let said = there
                .iter()
                .map(|c| reduced.taken[(a, *c)] * coefficients[*c]);
            reduced.taken[(a, columns)] - said.sum::<f64>()
        };
        let model = (0..self.model).map(|a| (a, of_model(a)));
        let own = there.iter().map(|c| (self.model + c, coefficients[*c]));
        let all: Vec<(usize, f64)> = model
            .chain(own)
            .chain([(self.model + columns, -1.0)])
            .collect();
        let products = &self.of_folds[fold];
        let terms = all.iter().flat_map(|(a, left)| {
            all.iter()
                .map(move |(b, right)| left * products[(*a, *b)] * right)
        });
        terms.sum::<f64>().max(0.0) / self.folds[fold].len().max(1) as f64
    }
}

/// The first step whose mean error is within a standard error of the least; `errors` are `[fold][step]`.
fn one_standard_error(errors: &[Vec<f64>]) -> usize {
    let folds = errors.len() as f64;
    let steps = errors.first().map_or(0, Vec::len);
    let mean = |step: usize| errors.iter().map(|of| of[step]).sum::<f64>() / folds;
    let Some(best) = (0..steps).min_by(|a, b| mean(*a).total_cmp(&mean(*b))) else {
        return 0;
    };
    let spread = errors.iter().map(|of| (of[best] - mean(best)).powi(2));
    let error = (spread.sum::<f64>() / (folds - 1.0) / folds).sqrt();
    (0..best)
        .find(|step| mean(*step) <= mean(best) + error)
        .unwrap_or(best)
}

/// Folds of so many rows, drawn by lot as if they were independent.
#[must_use]
pub fn by_lot(rows: usize) -> Vec<usize> {
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let mut drawn: Vec<(u64, usize)> = (0..rows).map(|row| (random.random(), row)).collect();
    drawn.sort_unstable();
    let mut folds = vec![0; rows];
    for (place, (_, row)) in drawn.into_iter().enumerate() {
        folds[row] = place % FOLDS;
    }
    folds
}

/// Folds of rows at these times, s: in every cycle as many equal blocks as folds, one after the other and without gaps.
#[must_use]
pub fn by_blocks(times: &[f64], cycle: f64) -> Vec<usize> {
    let fold = |time: &f64| {
        let place = (time / cycle).rem_euclid(1.0) * FOLDS as f64;
        (1..FOLDS).filter(|k| *k as f64 <= place).count()
    };
    times.iter().map(fold).collect()
}

fn products(table: &Mat<f64>, rows: &[usize]) -> Mat<f64> {
    let part = Mat::from_fn(rows.len(), table.ncols(), |k, c| table[(rows[k], c)]);
    part.transpose() * &part
}

fn per_row(products: &Mat<f64>, rows: usize) -> Mat<f64> {
    faer::Scale(1.0 / rows.max(1) as f64) * products
}

/// What a basis leaves of a column, with a mean square of one; `None` where that is next to nothing.
fn new_of(column: &[f64], basis: &[Vec<f64>]) -> Option<Vec<f64>> {
    let before = mean_product(column, column).sqrt();
    let mut left = column.to_vec();
    take_out(&mut left, basis);
    let after = mean_product(&left, &left).sqrt();
    for value in &mut left {
        *value /= after;
    }
    (after.is_finite() && after > LEAST_NEW * before).then_some(left)
}

/// Takes a basis out of a column, twice, as the first time leaves rounding.
fn take_out(column: &mut [f64], basis: &[Vec<f64>]) {
    for of_basis in basis.iter().chain(basis) {
        let part = mean_product(column, of_basis);
        column
            .iter_mut()
            .zip(of_basis)
            .for_each(|(value, own)| *value -= part * own);
    }
}

pub(super) fn mean_product(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>() / a.len().max(1) as f64
}

#[cfg(test)]
mod tests {
    use super::super::tests::{noise, rows};
    use super::*;

    #[test]
    fn the_sparsest_step_within_a_standard_error() {
        // Means 3, 1.05, 1, 1.2; the standard error of the least is 0.1.
        let errors = [vec![3.0, 1.0, 0.9, 1.0], vec![3.0, 1.1, 1.1, 1.4]];
        assert_eq!(one_standard_error(&errors), 1);
        assert_eq!(one_standard_error(&[vec![2.0], vec![2.0]]), 0);
    }

    #[test]
    fn blocks_follow_each_other_and_come_again_with_the_cycle() {
        let times: Vec<f64> = (0..400).map(|row| 0.1 * f64::from(row) + 0.05).collect();
        let folds = by_blocks(&times, 20.0);
        for (row, fold) in folds.iter().enumerate() {
            // Blocks of 2 s have 20 rows.
            assert_eq!(*fold, row / 20 % FOLDS, "row {row}");
        }
        assert_eq!(by_blocks(&[-0.5, 20.0], 20.0), [FOLDS - 1, 0]);
    }

    #[test]
    fn a_column_of_the_model_is_none_of_an_effect() {
        let model = noise(1, 50);
        let twice = model.iter().map(|value| 2.0 * value).collect();
        let column = |values: Vec<f64>| Column {
            effect: 0,
            trial: 0,
            values,
        };
        let columns = [column(twice), column(noise(2, 50))];
        let rows = Rows::new(
            std::slice::from_ref(&model),
            &columns,
            &noise(3, 50),
            &by_lot(50),
        );
        let numbers: Vec<usize> = rows.labels().iter().map(|label| label.number).collect();
        assert_eq!(numbers, [1]);
        let gram = rows.products().gram;
        assert!((gram[(0, 0)] - 1.0).abs() < 1e-6);
    }

    #[test]
    fn held_out_errors_are_those_of_the_folds() {
        let rows = rows(0.0);
        let power = |left: &[f64]| left.iter().map(|x| x * x).sum::<f64>() / left.len() as f64;
        let none = power(&rows.held_out(&[]));
        let both = power(&rows.held_out(&[1, 3]));
        assert!(both < 1e-10 * none, "{both} of {none}");
        // The same as the error of no coefficients.
        let errors: f64 = (0..FOLDS)
            .map(|fold| {
                let reduced = Reduced::new(&rows.train(fold), rows.model);
                let zeros = vec![0.0; reduced.products.columns()];
                rows.error(fold, &reduced, &zeros) * rows.folds[fold].len() as f64
            })
            .sum();
        assert!((errors / rows.count() as f64 / none - 1.0).abs() < 1e-6);
    }
}
