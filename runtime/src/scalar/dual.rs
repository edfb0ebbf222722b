//! A value and its slope.

use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use num_traits::{One, Zero};

use super::{Scalar, sealed};

/// `value + slope * e` with `e^2 = 0`: a function of it is its value and its derivative along the slope of its arguments, exact.
///
/// # Examples
/// ```
/// use robot_model::scalar::Dual;
/// let x = Dual::variable(2.0);
/// let y = x * x * x + Dual::from(1.0) / x;
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
    /// The variable by which derivatives are taken, at this value.
    ///
    /// # Examples
    /// ```
    /// use robot_model::scalar::{Dual, Scalar};
    /// assert_eq!((Dual::variable(3.0) * 2.0).slope, 2.0);
    /// ```
    #[must_use]
    pub fn variable(value: S) -> Self {
        Self {
            value,
            slope: S::one(),
        }
    }

    /// What does not depend on the variable.
    ///
    /// # Examples
    /// ```
    /// use robot_model::scalar::Dual;
    /// let (x, c) = (Dual::variable(3.0), Dual::constant(5.0));
    /// // d (c x) / dx
    /// assert_eq!((c * x).slope, 5.0);
    /// ```
    #[must_use]
    pub fn constant(value: S) -> Self {
        Self {
            value,
            slope: S::zero(),
        }
    }

    /// `f` of it, where the value is `f(value)` and the derivative of `f` is `rise`.
    fn chain(self, value: S, rise: S) -> Self {
        Self {
            value,
            slope: times(rise, self.slope),
        }
    }
}

/// `rise * slope`; zero where nothing moves, however steep it would rise.
fn times<S: Scalar>(rise: S, slope: S) -> S {
    let product = rise * slope;
    // A slope that is nothing but zero may be that of another dual number, which has a slope itself: the product, where it is one.
    S::choose(slope.abs(), product, product.finite_or(slope))
}

impl<S: Scalar> Add<f64> for Dual<S> {
    type Output = Self;
    #[inline]
    fn add(self, other: f64) -> Self {
        Add::add(self, Self::of(other))
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

impl<S: Scalar> Sub<f64> for Dual<S> {
    type Output = Self;
    #[inline]
    fn sub(self, other: f64) -> Self {
        Sub::sub(self, Self::of(other))
    }
}

impl<S: Scalar> Sub for Dual<S> {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl<S: Scalar> Mul<f64> for Dual<S> {
    type Output = Self;
    #[inline]
    fn mul(self, other: f64) -> Self {
        Mul::mul(self, Self::of(other))
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

impl<S: Scalar> Div<f64> for Dual<S> {
    type Output = Self;
    #[inline]
    fn div(self, other: f64) -> Self {
        Div::div(self, Self::of(other))
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

/// Does not depend on the variable.
impl<S: Scalar> From<f64> for Dual<S> {
    #[inline]
    fn from(value: f64) -> Self {
        Self::of(value)
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

impl<S: Scalar> sealed::Sealed for Dual<S> {}

impl<S: Scalar> Scalar for Dual<S> {
    const ROUNDING: f64 = S::ROUNDING;

    #[inline]
    fn of(value: f64) -> Self {
        Self::constant(S::of(value))
    }

    #[inline]
    fn mul_add(self, factor: Self, term: Self) -> Self {
        let slope = self.value.mul_add(factor.slope, term.slope);
        Self {
            value: self.value.mul_add(factor.value, term.value),
            slope: self.slope.mul_add(factor.value, slope),
        }
    }

    #[inline]
    fn sines_cosines<const N: usize>(angles: [Self; N]) -> [[Self; N]; 2] {
        let [sines, cosines] = S::sines_cosines(angles.map(|angle| angle.value));
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

    #[inline]
    fn pow(self, exponent: Self) -> Self {
        let value = self.value.pow(exponent.value);
        let by_base = exponent.value * self.value.pow(exponent.value - S::one());
        let by_exponent = S::choose(value.abs(), value * self.value.ln(), value);
        Self {
            value,
            slope: times(by_base, self.slope) + times(by_exponent, exponent.slope),
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

    /// A value that is a number stays, also where its slope is none.
    #[inline]
    fn finite_or(self, fallback: Self) -> Self {
        Self {
            value: self.value.finite_or(fallback.value),
            slope: (self.slope + self.value.flaw()).finite_or(fallback.slope),
        }
    }

    #[inline]
    fn flaw(self) -> Self {
        Self::constant(self.value.flaw())
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
