//! Forward selection by partial F tests (Draper & Smith 1998) that count rows as independent: 5 % of chance over all trials of a step.

use statrs::distribution::{ContinuousCDF, FisherSnedecor};

use super::products::Products;
use super::rows::{LEAST_NEW, Rows};
use super::{Choice, MOST_EFFECTS};

/// Chance of a wrong effect in a step, over all trials.
const SIGNIFICANCE: f64 = 0.05;

/// Effects in the order of their selection.
#[must_use]
pub fn selection(rows: &Rows) -> Vec<Choice> {
    let labels = rows.labels();
    let trials = rows.trials();
    let mut products = rows.products();
    let count = rows.count() as f64;
    let mut freedom = count - rows.model() as f64;
    let mut found: Vec<Choice> = Vec::new();
    loop {
        let tests = trials.iter().filter_map(|(effect, columns)| {
            Some((test(&products, columns, freedom)?, *effect, columns))
        });
        let best = tests.max_by(|a, b| a.0.f.total_cmp(&b.0.f));
        let Some((test, effect, columns)) = best else {
            return found;
        };
        if trials.len() as f64 * test.p_value >= SIGNIFICANCE {
            return found;
        }
        let numbers = columns.iter().map(|column| labels[*column].number);
        match found.iter().position(|choice| choice.effect == effect) {
            Some(place) => found[place].columns.extend(numbers),
            None if found.len() == MOST_EFFECTS => return found,
            None => found.push(Choice {
                effect,
                columns: numbers.collect(),
            }),
        }
        for column in columns {
            products.without(*column);
        }
        freedom -= test.rank as f64;
    }
}

struct Test {
    f: f64,
    p_value: f64,
    rank: usize,
}

/// The test of some columns; `None` where they say nothing new.
fn test(products: &Products, columns: &[usize], freedom: f64) -> Option<Test> {
    let (drop, rank) = explained(products, columns);
    let (own, left) = (rank as f64, freedom - rank as f64);
    if rank == 0 || left <= 0.0 {
        return None;
    }
    let rest = (products.power - drop).max(f64::MIN_POSITIVE);
    let f = drop / own / (rest / left);
    let p_value = FisherSnedecor::new(own, left).map_or(1.0, |distribution| distribution.sf(f));
    Some(Test { f, p_value, rank })
}

/// By how much some columns lower the mean square, and how many of them are independent: Gauss's elimination.
fn explained(products: &Products, columns: &[usize]) -> (f64, usize) {
    let size = columns.len();
    let row = |a: &usize| -> Vec<f64> {
        let of = |b: &usize| products.gram[(*a, *b)];
        columns
            .iter()
            .map(of)
            .chain([products.with_target[*a]])
            .collect()
    };
    let mut rows: Vec<Vec<f64>> = columns.iter().map(row).collect();
    let (mut drop, mut rank) = (0.0, 0);
    for k in 0..size {
        let pivot = rows[k].clone();
        if pivot[k] <= LEAST_NEW.powi(2) {
            continue;
        }
        drop += pivot[size].powi(2) / pivot[k];
        rank += 1;
        for row in &mut rows[k + 1..] {
            let factor = row[k] / pivot[k];
            row.iter_mut()
                .zip(&pivot)
                .for_each(|(value, own)| *value -= factor * own);
        }
    }
    (drop, rank)
}

#[cfg(test)]
mod tests {
    use super::super::tests::noise;
    use super::super::{Column, by_lot};
    use super::*;
    use faer::Mat;

    #[test]
    fn columns_that_are_alike_count_once() {
        let products = Products {
            gram: Mat::from_fn(3, 3, |a, b| f64::from(u8::from(a == b || a + b == 1))),
            with_target: vec![2.0, 2.0, 1.0],
            power: 6.0,
        };
        let (drop, rank) = explained(&products, &[0, 1, 2]);
        assert_eq!(rank, 2);
        assert!((drop - 5.0).abs() < 1e-12);
    }

    #[test]
    fn the_test_is_of_the_mean_squares() {
        let products = Products {
            gram: Mat::from_fn(1, 1, |_, _| 1.0),
            with_target: vec![0.5],
            power: 1.0,
        };
        let test = test(&products, &[0], 31.0).expect("a column that says something");
        assert!((test.f - 10.0).abs() < 1e-9);
        // F(1, 30) is above 10 by a chance of 0.0036.
        assert!((test.p_value - 0.003_58).abs() < 2e-4, "{}", test.p_value);
    }

    #[test]
    fn chance_is_shared_by_all_trials() {
        // Of a hundred columns of noise some are below 5 % alone.
        let columns: Vec<Column> = (0..100)
            .map(|effect| Column {
                effect,
                trial: 0,
                values: noise(1000 + effect as u64, 200),
            })
            .collect();
        let rows = Rows::new(&[], &columns, &noise(1, 200), &by_lot(200));
        let products = rows.products();
        let alone = (0..100).filter_map(|column| test(&products, &[column], 200.0));
        assert!(alone.filter(|test| test.p_value < SIGNIFICANCE).count() > 0);
        assert!(selection(&rows).is_empty());
    }
}
