//! Base parameters that no arm whose links are bodies has, and what the nearest arm has in their place.

use robot_model_codegen::Compiled;

use super::possible::share_deviations;
use crate::output::significant;

/// Base parameters are the same where they differ by less: as a share, and in deviations.
const SAME: f64 = 1e-6;

/// Digits that are shown, more where two numbers differ in none of them, and at most.
const DIGITS: usize = 5;
const MOST_DIGITS: usize = 17;

/// How sure base parameters are.
pub(crate) struct Widths {
    /// Deviations, or what stands for them where none are known.
    pub values: Vec<f64>,
    /// Which are deviations.
    pub is_known: Vec<bool>,
}

impl Widths {
    /// Of base parameters with the deviations that a file has.
    pub(crate) fn new(compiled: &Compiled, beta: &[f64], known: &[Option<f64>]) -> Self {
        let known = |k: usize| known.get(k).copied().flatten();
        let shares = share_deviations(compiled, beta).into_iter().enumerate();
        Self {
            values: shares.map(|(k, share)| known(k).unwrap_or(share)).collect(),
            is_known: (0..beta.len()).map(|k| known(k).is_some()).collect(),
        }
    }
}

/// A base parameter of which the nearest arm has another value.
pub(crate) struct Moved {
    /// Which it is.
    pub column: usize,
    pub name: String,
    pub given: f64,
    pub nearest: f64,
    /// The difference in deviations, or in what stands for one.
    pub widths: f64,
    pub has_deviation: bool,
}

impl Moved {
    /// All that differ, those that are farthest off first.
    pub(crate) fn all(
        compiled: &Compiled,
        beta: &[f64],
        nearest: &[f64],
        widths: &Widths,
    ) -> Vec<Self> {
        let pairs = beta.iter().zip(nearest).zip(&widths.values).enumerate();
        let moved = pairs.filter_map(|(column, ((&given, &nearest), width))| {
            let apart = (given - nearest).abs();
            let is_other = apart > SAME * given.abs() && apart > SAME * width;
            is_other.then(|| Self {
                column,
                name: compiled.base.names[column].clone(),
                given,
                nearest,
                widths: apart / width,
                has_deviation: widths.is_known[column],
            })
        });
        let mut moved: Vec<Self> = moved.collect();
        moved.sort_by(|x, y| y.widths.total_cmp(&x.widths));
        moved
    }

    /// `` `elbow.mx` 0.31 in place of 0.32 (1.5 standard deviations) ``
    pub(crate) fn said(&self) -> String {
        let by = if self.has_deviation {
            format!(" ({} standard deviations)", significant(self.widths, 2))
        } else {
            String::new()
        };
        let [nearest, given] = apart([self.nearest, self.given]);
        format!("`{}` {nearest} in place of {given}{by}", self.name)
    }
}

/// Two numbers with as many digits as show that they differ.
fn apart(pair: [f64; 2]) -> [String; 2] {
    let texts = |digits: usize| pair.map(|number| significant(number, digits));
    let found = (DIGITS..MOST_DIGITS).map(texts).find(|[x, y]| x != y);
    found.unwrap_or_else(|| texts(MOST_DIGITS))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_that_differ_are_written_so() {
        let texts = |pair| apart(pair).join(" ");
        assert_eq!(texts([1.25, -2.0]), "1.2500 -2.0000");
        assert_eq!(texts([0.011_100_1, 0.011_1]), "0.0111001 0.0111000");
    }
}
