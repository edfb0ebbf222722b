//! Numbers that know their rounding: what is left of a difference that should be nothing is told from a small number.
//!
//! Running error analysis (Higham 2002, ch. 3.3): beside each value stands a bound of its absolute error. So whether a number
//! is zero does not depend on the units in which it stands, as it would if it were compared with a fixed one.

use std::ops::{Add, Mul, Sub};

/// Half a unit in the last place of 1: the relative error of one operation.
pub const UNIT: f64 = f64::EPSILON / 2.0;

/// A number written in a spec, after the few operations that bring it to SI units or make it an entry of a rotation.
pub const OF_A_CONSTANT: f64 = 8.0 * UNIT;

/// A value and a bound of its absolute error.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Rounded {
    /// The value.
    pub value: f64,
    /// Its absolute error is not larger.
    pub error: f64,
}

impl Rounded {
    /// Nothing, without error.
    pub const ZERO: Self = Self {
        value: 0.0,
        error: 0.0,
    };

    /// A number that is known to some relative error.
    pub fn relative(value: f64, error: f64) -> Self {
        Self {
            value,
            error: error * value.abs(),
        }
    }

    /// A number of a spec.
    pub fn constant(value: f64) -> Self {
        Self::relative(value, OF_A_CONSTANT)
    }

    /// The result of one more operation on operands that leave `error`.
    pub fn after(value: f64, error: f64) -> Self {
        Self {
            value,
            error: error + UNIT * value.abs(),
        }
    }

    /// Whether there is nothing but rounding.
    pub fn is_noise(self) -> bool {
        self.value.is_finite() && self.value.abs() <= 2.0 * self.error
    }

    /// Zero where there is nothing but rounding.
    pub fn cleaned(self) -> Self {
        if self.is_noise() { Self::ZERO } else { self }
    }

    /// `self ^ exponent`, of an exponent without error.
    pub fn power(self, exponent: f64) -> Self {
        let value = self.value.powf(exponent);
        if value == 0.0 {
            return Self::ZERO;
        }
        let relative = exponent.abs() * self.error / self.value.abs() + UNIT;
        Self::after(value, value.abs() * relative)
    }

    /// `self / other`, with one rounding of the value: a number by itself is exactly 1.
    pub fn over(self, other: Self) -> Self {
        let value = self.value / other.value;
        Self::after(
            value,
            (self.error + value.abs() * other.error) / other.value.abs(),
        )
    }
}

impl Add for Rounded {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self::after(self.value + other.value, self.error + other.error)
    }
}

impl Sub for Rounded {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self::after(self.value - other.value, self.error + other.error)
    }
}

impl Mul for Rounded {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let error = self.value.abs() * other.error
            + other.value.abs() * self.error
            + self.error * other.error;
        Self::after(self.value * other.value, error)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 0.1 + 0.2 - 0.3 is 5.6e-17 in doubles, and a number of that size that was written down is no rounding.
    #[test]
    fn a_difference_that_should_be_nothing_is_told_from_a_small_number() {
        for unit in [1.0, 1e-200, 1e200] {
            let constant = |x: f64| Rounded::constant(x * unit);
            let left = constant(0.1) + constant(0.2) - constant(0.3);
            assert!(left.is_noise(), "{left:?}");
            assert!(!constant(5.6e-17).is_noise());
            assert!(!(left + constant(1e-13)).is_noise());
        }
    }
}
