//! What well-known ways to choose columns make of the columns that the tracer has: LASSO, sequential thresholding, forward
//! selection by F tests and by cross-validation.
//!
//! ```text
//! model, columns, target -rows-> Rows -lasso, thresholding, selection, blocked-> Choices
//! ```
//!
//! The first three count rows as independent, as they are used, the last has folds of whole blocks; the model's columns are always in.
//! Inside [`Rows`] columns are without what the model says of them and have a mean square of one, so that penalties and thresholds are alike
//! for all.

mod blocked;
mod lasso;
mod products;
mod rows;
mod screen;
mod selection;
mod thresholding;

pub use blocked::blocked;
pub use lasso::lasso;
pub use rows::{Column, FOLDS, Rows, by_blocks, by_lot};
pub use selection::selection;
pub use thresholding::thresholding;

/// No more effects than the tracer looks for.
const MOST_EFFECTS: usize = 6;

/// How a baseline's rows are cut into folds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Folds {
    /// By lot.
    ByLot,
    /// Blocks of time, or of the phase of a motion that repeats.
    Blocks,
}

/// What every baseline is: a choice of effects, those that explain most first.
#[derive(Debug, Clone, Copy)]
pub struct Baseline {
    /// Its name.
    pub name: &'static str,
    /// Its folds.
    pub folds: Folds,
    /// Its choice.
    pub choose: fn(&Rows) -> Vec<Choice>,
}

/// All of them.
pub const ALL: [Baseline; 4] = [
    Baseline {
        name: "LASSO",
        folds: Folds::ByLot,
        choose: lasso,
    },
    Baseline {
        name: "thresholding",
        folds: Folds::ByLot,
        choose: thresholding,
    },
    Baseline {
        name: "F-selection",
        folds: Folds::ByLot,
        choose: selection,
    },
    Baseline {
        name: "blocked CV",
        folds: Folds::Blocks,
        choose: blocked,
    },
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
    use super::{ALL, Column, Rows, by_lot};
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
        Rows::new(&[model], &columns, &target, &by_lot(ROWS))
    }

    #[test]
    fn each_finds_what_is_there_the_largest_first() {
        for baseline in ALL {
            let name = baseline.name;
            let found = (baseline.choose)(&rows(0.3));
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
        let rows = Rows::new(
            std::slice::from_ref(&model),
            &columns,
            &target,
            &by_lot(400),
        );
        for baseline in ALL {
            let found = (baseline.choose)(&rows);
            assert!(found.is_empty(), "{}: {found:?}", baseline.name);
        }
    }
}
