//! A value and its slope.

use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use num_traits::{One, Zero};

use super::Scalar;

/// `value + slope * e` with `e^2 = 0`: a function of it is its value and its derivative along the slope of its arguments, exact.
///
/// # Examples
/// ```
/// use robot_model::scalar::{Dual, Scalar};
/// let x = Dual { value: 2.0, slope: 1.0 };
/// let y = x * x * x + Dual::of(1.0) / x;
/// assert_eq!((y.value, y.slope), (8.5, 11.75)); // 3 x^2 - 1 / x^2
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Dual<S = f64> {
    /// The value.
    pub value: S,
    /// The derivative.
    pub slope: S,
}

impl<S: Scalar> Dual<S> {
    /// `f` of it, where the value is `f(value)` and the derivative of `f` is `rise`.
    fn chain(self, value: S, rise: S) -> Self {
        Self {
            value,
            slope: rise * self.slope,
        }
    }
}

impl<S: Scalar> Add for Dual<S> {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        Self {
            value: self.value + other.value,
            slope: self.slope + other.slope,
        }
    }
}

impl<S: Scalar> Sub for Dual<S> {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl<S: Scalar> Mul for Dual<S> {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        Self {
            value: self.value * other.value,
            slope: self.slope * other.value + self.value * other.slope,
        }
    }
}

impl<S: Scalar> Div for Dual<S> {
    type Output = Self;
    #[inline]
    fn div(self, other: Self) -> Self {
        let value = self.value / other.value;
        Self {
            value,
            slope: (self.slope - value * other.slope) / other.value,
        }
    }
}

impl<S: Scalar> Neg for Dual<S> {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self {
            value: -self.value,
            slope: -self.slope,
        }
    }
}

impl<S: Scalar> AddAssign for Dual<S> {
    #[inline]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<S: Scalar> SubAssign for Dual<S> {
    #[inline]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

impl<S: Scalar> MulAssign for Dual<S> {
    #[inline]
    fn mul_assign(&mut self, other: Self) {
        *self = *self * other;
    }
}

impl<S: Scalar> DivAssign for Dual<S> {
    #[inline]
    fn div_assign(&mut self, other: Self) {
        *self = *self / other;
    }
}

impl<S: Scalar> Zero for Dual<S> {
    #[inline]
    fn zero() -> Self {
        Self::of(0.0)
    }

    #[inline]
    fn is_zero(&self) -> bool {
        self.value.is_zero() && self.slope.is_zero()
    }
}

impl<S: Scalar> One for Dual<S> {
    #[inline]
    fn one() -> Self {
        Self::of(1.0)
    }
}

impl<S: Scalar> Scalar for Dual<S> {
    #[inline]
    fn of(value: f64) -> Self {
        Self {
            value: S::of(value),
            slope: S::zero(),
        }
    }

    #[inline]
    fn sin_cos<const N: usize>(angles: [Self; N]) -> [[Self; N]; 2] {
        let [sines, cosines] = S::sin_cos(angles.map(|angle| angle.value));
        [
            core::array::from_fn(|k| angles[k].chain(sines[k], cosines[k])),
            core::array::from_fn(|k| angles[k].chain(cosines[k], -sines[k])),
        ]
    }

    #[inline]
    fn exp(self) -> Self {
        let value = self.value.exp();
        self.chain(value, value)
    }

    #[inline]
    fn exp_m1(self) -> Self {
        self.chain(self.value.exp_m1(), self.value.exp())
    }

    #[inline]
    fn ln(self) -> Self {
        self.chain(self.value.ln(), S::one() / self.value)
    }

    #[inline]
    fn sqrt(self) -> Self {
        let value = self.value.sqrt();
        self.chain(value, S::of(0.5) / value)
    }

    #[inline]
    fn tanh(self) -> Self {
        let value = self.value.tanh();
        self.chain(value, S::one() - value * value)
    }

    /// The derivative by the exponent counts where the exponent has a slope.
    #[inline]
    fn pow(self, exponent: Self) -> Self {
        let value = self.value.pow(exponent.value);
        let by_base = exponent.value * self.value.pow(exponent.value - S::one());
        let by_exponent = if exponent.slope.is_zero() {
            S::zero()
        } else {
            value * self.value.ln() * exponent.slope
        };
        Self {
            value,
            slope: by_base * self.slope + by_exponent,
        }
    }

    #[inline]
    fn abs(self) -> Self {
        self.chain(self.value.abs(), self.value.sign())
    }

    /// A jump has no slope here.
    #[inline]
    fn sign(self) -> Self {
        self.chain(self.value.sign(), S::zero())
    }

    #[inline]
    fn choose(condition: Self, positive: Self, otherwise: Self) -> Self {
        Self {
            value: S::choose(condition.value, positive.value, otherwise.value),
            slope: S::choose(condition.value, positive.slope, otherwise.slope),
        }
    }

    /// A number is one with its slope.
    #[inline]
    fn finite_or(self, fallback: Self) -> Self {
        let zero = S::zero();
        Self {
            value: (self.value + self.slope * zero).finite_or(fallback.value),
            slope: (self.slope + self.value * zero).finite_or(fallback.slope),
        }
    }

    #[inline]
    fn least(self) -> f64 {
        self.value.least()
    }

    #[inline]
    fn most(self) -> f64 {
        self.value.most()
    }
}
