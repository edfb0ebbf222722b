//! Elimination with numbers that know their rounding: what is zero is decided per entry, in the entry's own unit.
//!
//! Coefficients of parameters stand in as many units as there are parameters: a moment of area in m^4 beside a number. To
//! compare them with a common size would take the small ones for rounding.

use crate::rounded::{OF_A_CONSTANT, Rounded};
use crate::selection::shortest;

/// Coefficients that differ by no more than this, relatively, are the same; energies are written with fewer digits.
pub const SAME: f64 = 1e-12;

/// A row of the reduced system, with the combination of offered rows that it is.
struct Reduced {
    row: Vec<Rounded>,
    combination: Vec<Rounded>,
    pivot: usize,
}

/// Independent rows, and others as combinations of them.
pub struct Elimination {
    reduced: Vec<Reduced>,
    columns: usize,
}

/// What is left of a row, and the combination of kept rows that was taken away.
struct Rest {
    row: Vec<Rounded>,
    combination: Vec<Rounded>,
}

impl Elimination {
    /// Of rows with so many entries.
    pub const fn new(columns: usize) -> Self {
        Self {
            reduced: Vec::new(),
            columns,
        }
    }

    /// Keeps the row unless it is a combination of those kept before; the pivot is the first of `preferred` that is left of
    /// it, else the entry that is best known.
    pub fn keep(&mut self, row: &[f64], preferred: impl Iterator<Item = usize>) -> Option<usize> {
        let mut rest = self.reduce(row);
        let left = |k: &usize| rest.row[*k].value != 0.0;
        let mut preferred = preferred;
        let best = || {
            let doubt = |k: &usize| rest.row[*k].error / rest.row[*k].value.abs();
            (0..self.columns)
                .filter(left)
                .min_by(|x, y| doubt(x).total_cmp(&doubt(y)))
        };
        let pivot = preferred.find(left).or_else(best)?;
        for entry in &mut rest.combination {
            *entry = Rounded::ZERO - *entry;
        }
        rest.combination.push(Rounded::relative(1.0, 0.0));
        self.reduced.push(Reduced {
            row: rest.row,
            combination: rest.combination,
            pivot,
        });
        Some(pivot)
    }

    /// Per kept row its share, where the row is a combination of them.
    pub fn shares(&self, row: &[f64]) -> Option<Vec<f64>> {
        let rest = self.reduce(row);
        rest.row.iter().all(|x| x.value == 0.0).then(|| {
            let shares = rest.combination.into_iter();
            // Halves and doubles are exact; a number of a spec is not known better than this.
            let exact = |share: f64| shortest(share, OF_A_CONSTANT * share.abs());
            shares.map(|share| exact(share.cleaned().value)).collect()
        })
    }

    fn reduce(&self, row: &[f64]) -> Rest {
        let mut row: Vec<Rounded> = row
            .iter()
            .map(|&x| Rounded::relative(x, 0.25 * SAME))
            .collect();
        let mut combination = vec![Rounded::ZERO; self.reduced.len()];
        for kept in &self.reduced {
            if row[kept.pivot].value == 0.0 {
                continue;
            }
            let share = row[kept.pivot].over(kept.row[kept.pivot]);
            for (k, (x, y)) in row.iter_mut().zip(&kept.row).enumerate() {
                if k == kept.pivot {
                    *x = Rounded::ZERO;
                } else if y.value != 0.0 {
                    *x = (*x - share * *y).cleaned();
                }
            }
            for (x, y) in combination.iter_mut().zip(&kept.combination) {
                *x = *x + share * *y;
            }
        }
        Rest { row, combination }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dependence_does_not_depend_on_units() {
        for units in [[1.0, 1.0, 1.0], [1e-12, 1.0, 1e11], [1.0, 1e-25, 1e9]] {
            let row = |x: [f64; 3]| [x[0] * units[0], x[1] * units[1], x[2] * units[2]];
            let mut kept = Elimination::new(3);
            assert_eq!(kept.keep(&row([1.0, 0.1, 0.0]), 0..3), Some(0));
            assert_eq!(kept.keep(&row([3.0, 0.3, 0.0]), 0..3), None);
            assert_eq!(kept.keep(&row([1.0, 0.2, 0.7]), 0..3), Some(1));
            assert_eq!(kept.keep(&row([0.0, 0.1, 0.7]), 0..3), None);
            let shares = kept.shares(&row([3.0, 0.5, 1.4])).expect("in their span");
            for (share, wanted) in shares.into_iter().zip([1.0, 2.0]) {
                assert!((share - wanted).abs() < 1e-14, "{share}");
            }
            assert_eq!(kept.shares(&row([0.0, 0.0, 1.0])), None);
        }
    }
}
