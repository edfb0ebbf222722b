//! Arithmetic of products of parameters.

use std::collections::BTreeMap;

use super::Monomial;

impl Monomial {
    /// The product of nothing.
    #[must_use]
    pub const fn one() -> Self {
        Self {
            factors: Vec::new(),
        }
    }

    pub(crate) fn of(parameter: usize) -> Self {
        Self {
            factors: vec![(parameter, 1)],
        }
    }

    /// Whether it is the product of nothing.
    #[must_use]
    pub fn is_one(&self) -> bool {
        self.factors.is_empty()
    }

    /// Sum of the magnitudes of the exponents.
    #[must_use]
    pub fn degree(&self) -> u32 {
        self.factors.iter().map(|(_, k)| k.unsigned_abs()).sum()
    }

    pub(crate) fn times(&self, other: &Self) -> Self {
        let mut exponents: BTreeMap<usize, i32> = self.factors.iter().copied().collect();
        for &(parameter, exponent) in &other.factors {
            *exponents.entry(parameter).or_insert(0) += exponent;
        }
        Self {
            factors: exponents.into_iter().filter(|(_, k)| *k != 0).collect(),
        }
    }

    pub(crate) fn power(&self, exponent: i32) -> Self {
        Self {
            factors: self
                .factors
                .iter()
                .map(|&(parameter, k)| (parameter, k * exponent))
                .collect(),
        }
    }
}
