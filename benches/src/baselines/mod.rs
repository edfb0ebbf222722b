//! What well-known ways to choose columns make of the columns that the tracer has: LASSO, sequential thresholding, forward selection.
//!
//! ```text
//! model, columns, target -rows-> Rows -lasso, thresholding, selection-> Choices
//! ```
//!
//! All of them count rows as independent, as they are used; the model's columns are always in. Inside [`Rows`] columns are without what the
//! model says of them and have a mean square of one, so that penalties and thresholds are alike for all.

mod lasso;
mod products;
mod rows;
mod selection;
mod thresholding;

pub use lasso::lasso;
pub use rows::{Column, Rows};
pub use selection::selection;
pub use thresholding::thresholding;

/// What every baseline is: a choice of effects, those that explain most first.
pub type Baseline = fn(&Rows) -> Vec<Choice>;

/// All of them, by name.
pub const ALL: [(&str, Baseline); 3] = [
    ("LASSO", lasso),
    ("thresholding", thresholding),
    ("F-selection", selection),
];

/// An effect that was chosen.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Choice {
    /// The effect, as its [`Column`]s say.
    pub effect: usize,
    /// Its columns, by their places among all that [`Rows::new`] was given.
    pub columns: Vec<usize>,
}

#[cfg(test)]
mod tests {
    use super::{ALL, Column, Rows};
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    /// Independent numbers between -1 and 1.
    pub(super) fn noise(seed: u64, count: usize) -> Vec<f64> {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        (0..count).map(|_| random.random_range(-1.0..1.0)).collect()
    }

    /// Five effects with a column each beside a model of one column; the target has the model and two of them, the later one more.
    pub(super) fn rows(noisy: f64) -> Rows {
        const ROWS: usize = 400;
        let model = noise(1, ROWS);
        let columns: Vec<Column> = (0..5)
            .map(|effect| Column {
                effect,
                trial: 0,
                values: noise(10 + effect as u64, ROWS),
            })
            .collect();
        let rest = noise(99, ROWS);
        let at = |k: usize| {
            5.0 * model[k]
                + 0.5 * columns[1].values[k]
                + 2.0 * columns[3].values[k]
                + noisy * rest[k]
        };
        let target: Vec<f64> = (0..ROWS).map(at).collect();
        Rows::new(&[model], &columns, &target)
    }

    #[test]
    fn each_finds_what_is_there_the_largest_first() {
        for (name, baseline) in ALL {
            let found = baseline(&rows(0.3));
            let effects: Vec<usize> = found.iter().map(|choice| choice.effect).collect();
            assert_eq!(effects[..2], [3, 1], "{name}: {effects:?}");
            assert_eq!(found[0].columns, [3], "{name}");
        }
    }

    #[test]
    fn each_is_silent_where_the_model_says_all() {
        let model = noise(1, 400);
        let column = |effect: usize| Column {
            effect,
            trial: 0,
            values: noise(10 + effect as u64, 400),
        };
        let columns: Vec<Column> = (0..5).map(column).collect();
        let rest = noise(99, 400);
        let target: Vec<f64> = model.iter().zip(&rest).map(|(m, r)| m + 0.3 * r).collect();
        for (name, baseline) in ALL {
            let found = baseline(&Rows::new(std::slice::from_ref(&model), &columns, &target));
            assert!(found.is_empty(), "{name}: {found:?}");
        }
    }
}
