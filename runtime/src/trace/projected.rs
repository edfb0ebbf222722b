//! A candidate's columns once every column of the model is projected out of them.

use crate::columns::Candidate;

use super::small::{add, dot, solve_symmetric};

/// A candidate's columns without what the model can already say.
pub(super) struct Projected {
    /// Coefficients of least squares on the residual.
    pub(super) gain: Vec<f64>,
    /// Fall of the weighted sum of squares.
    pub(super) drop: f64,
    /// For each column of the candidate, the model's estimate changes by `-correction * gain`.
    pub(super) corrections: Vec<Vec<f64>>,
    /// Products of the candidate's columns without what the model can already say.
    pub(super) information: Vec<Vec<f64>>,
}

impl Projected {
    /// `|| Z (one - other) || / || Z other ||` of the projected columns.
    pub(super) fn distance(&self, one: &[f64], other: &[f64]) -> f64 {
        let change: Vec<f64> = one.iter().zip(other).map(|(a, b)| a - b).collect();
        (self.power(&change) / self.power(other).max(f64::MIN_POSITIVE)).sqrt()
    }

    /// Share of one column's own power in that of the whole effect.
    pub(super) fn power_share(&self, gain: &[f64], column: usize) -> f64 {
        self.information[column][column] * gain[column].powi(2)
            / self.power(gain).max(f64::MIN_POSITIVE)
    }

    /// How the model's estimate changes with the candidate beside it.
    pub(super) fn change(&self) -> Vec<f64> {
        let unknowns = self.corrections.first().map_or(0, Vec::len);
        let mut change = vec![0.0; unknowns];
        for (correction, gain) in self.corrections.iter().zip(&self.gain) {
            add(&mut change, -gain, correction);
        }
        change
    }

    /// Fall of the weighted sum of squares that a candidate makes with parameters of the signs that they may have: that of the best of its
    /// parts. Of candidates with many parameters, which have no signs, the fall itself.
    pub(super) fn admissible_drop(&self, candidate: &dyn Candidate) -> f64 {
        /// A law has no more.
        const MOST: usize = 4;
        let unknowns = candidate.unknowns();
        let is_free = unknowns.iter().all(|unknown| !unknown.nonnegative);
        if is_free || self.gain.len() > MOST {
            return self.drop;
        }
        let with_residual: Vec<f64> = self
            .information
            .iter()
            .map(|row| dot(row, &self.gain))
            .collect();
        let parts = 1..1_usize << self.gain.len();
        let drops = parts.filter_map(|part| {
            let columns: Vec<usize> = (0..self.gain.len())
                .filter(|c| (part >> c) & 1 == 1)
                .collect();
            let information: Vec<Vec<f64>> = columns
                .iter()
                .map(|&a| columns.iter().map(|&b| self.information[a][b]).collect())
                .collect();
            let right: Vec<f64> = columns.iter().map(|&c| with_residual[c]).collect();
            let gain = solve_symmetric(&information, &right);
            let mut signed = columns.iter().zip(&gain);
            let is_admissible = signed.all(|(&c, gain)| *gain >= 0.0 || !unknowns[c].nonnegative);
            is_admissible.then(|| dot(&gain, &right))
        });
        drops.fold(0.0, f64::max)
    }

    fn power(&self, gain: &[f64]) -> f64 {
        self.information
            .iter()
            .zip(gain)
            .map(|(row, g)| g * dot(row, gain))
            .sum::<f64>()
            .max(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::columns::{Columns, Entry, Shape, Unknown};
    use crate::motion::Motion;

    struct Law([Unknown; 2]);

    impl Columns for Law {
        fn unknowns(&self) -> &[Unknown] {
            &self.0
        }

        fn shapes(&self) -> &[Shape] {
            &[]
        }

        fn uses_rigid_torque(&self) -> bool {
            false
        }

        fn entries(&self, _: &Motion, _: &[f64]) -> Vec<Entry> {
            Vec::new()
        }
    }

    impl Candidate for Law {
        fn kind(&self) -> &'static str {
            "law"
        }

        fn joints(&self) -> &[usize] {
            &[0]
        }
    }

    /// Columns `z` with products `[[2, 1], [1, 2]]`, of which least squares makes `[3, -1]`: with neither negative it is `[2.5, 0]`.
    #[test]
    fn a_law_explains_what_it_does_with_the_signs_that_it_may_have() {
        let law = |nonnegative: [bool; 2]| {
            Law(nonnegative.map(|nonnegative| Unknown {
                name: String::new(),
                nonnegative,
            }))
        };
        let projected = Projected {
            gain: vec![3.0, -1.0],
            drop: 14.0,
            corrections: Vec::new(),
            information: vec![vec![2.0, 1.0], vec![1.0, 2.0]],
        };
        let drop = |nonnegative| projected.admissible_drop(&law(nonnegative));
        for (signs, wanted) in [
            ([false, false], 14.0),
            ([true, false], 14.0),
            ([false, true], 12.5),
            ([true, true], 12.5),
        ] {
            assert!(
                (drop(signs) - wanted).abs() < 1e-9,
                "{signs:?}: {}",
                drop(signs)
            );
        }
    }
}
