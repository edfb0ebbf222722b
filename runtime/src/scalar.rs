//! Numbers that emitted code computes with: `f64`, `f32`, lanes of several states at once, dual numbers.
//!
//! Emitted functions are generic over [`Scalar`]: `inverse_dynamics(&q, &dq, &ddq, &beta)` is whatever its arguments are. Nothing
//! allocates, nothing panics.

mod dual;
mod float;
mod lanes;
mod sin_cos;

use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use num_traits::{One, Zero};

mod sealed {
    /// Keeps implementations of [`Scalar`](super::Scalar) to this crate.
    pub trait Sealed {}
}

pub use dual::Dual;
pub use lanes::{Lanes4, Lanes8};

/// A real number, or several side by side.
///
/// What emitted code needs and no more; the constants of an arm come in by [`Self::of`]. nalgebra's vectors and matrices take
/// every such number. The trait is implemented here only, as what emitted code needs grows.
///
/// # Examples
/// ```
/// use robot_model::scalar::{Dual, Lanes4, Scalar};
/// /// Height of a pendulum's tip, m.
/// fn height<S: Scalar>(angle: S) -> S {
///     let [[sin], [_]] = S::sines_cosines([angle]);
///     S::of(0.5) * sin
/// }
/// assert!((height(0.3_f64) - 0.5 * 0.3_f64.sin()).abs() < 1e-15);
/// // Four pendulums at once.
/// let heights = height(Lanes4::from([0.0, 0.1, 0.2, 0.3])).to_array();
/// assert_eq!(heights, [0.0, 0.1, 0.2, 0.3].map(height::<f64>));
/// // The height and its slope by the angle.
/// let at = height(Dual { value: 0.3, slope: 1.0 });
/// assert!((at.slope - 0.5 * 0.3_f64.cos()).abs() < 1e-15);
/// ```
pub trait Scalar:
    sealed::Sealed
    + nalgebra::Scalar
    + Copy
    + Zero
    + One
    + Neg<Output = Self>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + AddAssign
    + SubAssign
    + MulAssign
    + DivAssign
{
    /// Relative size of a rounding: half of the distance from 1 to the next number.
    const ROUNDING: f64;

    /// This number, in every lane; rounded to the scalar's precision.
    ///
    /// # Examples
    /// ```
    /// use robot_model::Scalar;
    /// use robot_model::scalar::{Dual, Lanes4};
    /// assert_eq!(Lanes4::of(9.81).to_array(), [9.81; 4]);
    /// // A constant has no slope.
    /// assert_eq!(Dual::<f64>::of(9.81).slope, 0.0);
    /// ```
    fn of(value: f64) -> Self;

    /// `self * factor + term`: one operation and one rounding where the target has an instruction for it, two where it has not.
    ///
    /// On x86 it has one with `-C target-cpu=native` (or `-C target-feature=+fma`), on 64-bit ARM always; without the feature
    /// `std` it is used in lanes only.
    ///
    /// # Examples
    /// ```
    /// use robot_model::Scalar;
    /// // l sin(q) + h of four pendulums
    /// use robot_model::scalar::Lanes4;
    /// let sines = Lanes4::from([0.0, 0.5, 1.0, -1.0]);
    /// assert_eq!(sines.mul_add(Lanes4::of(2.0), Lanes4::of(0.25)).to_array(), [0.25, 1.25, 2.25, -1.75]);
    /// ```
    #[must_use]
    #[inline]
    fn mul_add(self, factor: Self, term: Self) -> Self {
        self * factor + term
    }

    /// Sines and cosines of angles in rad, all at once: `let [[sin_a, sin_b], [cos_a, cos_b]] = S::sines_cosines([a, b])`.
    ///
    /// Within 2 units in the last place.
    ///
    /// # Examples
    /// ```
    /// use robot_model::Scalar;
    /// let [[sin_a, sin_b], [cos_a, cos_b]] = f64::sines_cosines([0.3, 0.5]);
    /// // sin(a + b)
    /// assert!((sin_a * cos_b + cos_a * sin_b - 0.8_f64.sin()).abs() < 1e-15);
    /// ```
    fn sines_cosines<const N: usize>(angles: [Self; N]) -> [[Self; N]; 2];

    /// Sine of an angle in rad.
    ///
    /// # Examples
    /// ```
    /// use robot_model::Scalar;
    /// use robot_model::scalar::Dual;
    /// // Its slope is the cosine.
    /// let sin = Scalar::sin(Dual::variable(0.0_f64));
    /// assert_eq!((sin.value, sin.slope), (0.0, 1.0));
    /// ```
    #[must_use]
    fn sin(self) -> Self {
        let [[sin], _] = Self::sines_cosines([self]);
        sin
    }

    /// Cosine of an angle in rad.
    ///
    /// # Examples
    /// ```
    /// use robot_model::Scalar;
    /// use robot_model::scalar::Dual;
    /// let cos = Scalar::cos(Dual::variable(std::f64::consts::FRAC_PI_2));
    /// assert!(cos.value.abs() < 1e-15 && (cos.slope + 1.0).abs() < 1e-15);
    /// ```
    #[must_use]
    fn cos(self) -> Self {
        let [_, [cos]] = Self::sines_cosines([self]);
        cos
    }

    /// `e^x`
    ///
    /// # Examples
    /// ```
    /// use robot_model::Scalar;
    /// use robot_model::scalar::Dual;
    /// let exp = Dual::variable(std::f64::consts::LN_2).exp();
    /// assert!((exp.value - 2.0).abs() < 1e-15 && (exp.slope - 2.0).abs() < 1e-15);
    /// ```
    #[must_use]
    fn exp(self) -> Self;

    /// `e^x - 1`, exact near 0.
    ///
    /// # Examples
    /// ```
    /// use robot_model::Scalar;
    /// // x + x^2 / 2
    /// assert_eq!(Scalar::exp_m1(1e-10_f64), 1e-10 + 0.5e-20);
    /// ```
    #[must_use]
    fn exp_m1(self) -> Self;

    /// Natural logarithm.
    ///
    /// # Examples
    /// ```
    /// use robot_model::Scalar;
    /// use robot_model::scalar::Dual;
    /// let ln = Dual::variable(4.0_f64).ln();
    /// assert!((ln.value - 2.0 * std::f64::consts::LN_2).abs() < 1e-15 && ln.slope == 0.25);
    /// ```
    #[must_use]
    fn ln(self) -> Self;

    /// Square root.
    ///
    /// # Examples
    /// ```
    /// use robot_model::Scalar;
    /// use robot_model::scalar::Dual;
    /// let root = Dual::variable(4.0_f64).sqrt();
    /// assert_eq!((root.value, root.slope), (2.0, 0.25));
    /// ```
    #[must_use]
    fn sqrt(self) -> Self;

    /// Hyperbolic tangent.
    ///
    /// # Examples
    /// ```
    /// use robot_model::Scalar;
    /// use robot_model::scalar::Dual;
    /// // A smooth sign: of slope 1 at rest, and 1 far from it.
    /// let tanh = Dual::variable(0.0_f64).tanh();
    /// assert_eq!((tanh.value, tanh.slope, Scalar::tanh(40.0_f64)), (0.0, 1.0, 1.0));
    /// ```
    #[must_use]
    fn tanh(self) -> Self;

    /// `x^exponent`
    ///
    /// # Examples
    /// ```
    /// use robot_model::Scalar;
    /// use robot_model::scalar::Dual;
    /// let power = Dual::variable(2.0_f64).pow(Dual::of(3.0));
    /// assert!((power.value - 8.0).abs() < 1e-14 && (power.slope - 3.0 * 4.0).abs() < 1e-14);
    /// ```
    #[must_use]
    fn pow(self, exponent: Self) -> Self;

    /// Absolute value.
    ///
    /// # Examples
    /// ```
    /// use robot_model::Scalar;
    /// use robot_model::scalar::Dual;
    /// let size = Dual::variable(-3.0_f64).abs();
    /// assert_eq!((size.value, size.slope), (3.0, -1.0));
    /// ```
    #[must_use]
    fn abs(self) -> Self;

    /// -1, 0 or 1; 0 at 0.
    ///
    /// # Examples
    /// ```
    /// use robot_model::Scalar;
    /// // Not 1 at rest, as `f64::signum` is.
    /// assert_eq!([-3.0, 0.0, 3.0].map(|dq: f64| Scalar::sign(dq)), [-1.0, 0.0, 1.0]);
    /// ```
    #[must_use]
    fn sign(self) -> Self;

    /// `positive` where the condition is greater than 0, `otherwise` elsewhere.
    ///
    /// # Examples
    /// ```
    /// use robot_model::Scalar;
    /// // Friction that is larger one way than the other, in any scalar.
    /// let friction = |dq: f64| Scalar::choose(dq, 0.8 * dq, 0.5 * dq);
    /// assert_eq!((friction(2.0), friction(-2.0)), (1.6, -1.0));
    /// ```
    #[must_use]
    fn choose(condition: Self, positive: Self, otherwise: Self) -> Self;

    /// Itself, and `fallback` where it is infinite or no number.
    ///
    /// # Examples
    /// ```
    /// use robot_model::Scalar;
    /// assert_eq!(((1.0_f64 / 0.0).finite_or(7.0), 2.0_f64.finite_or(7.0)), (7.0, 2.0));
    /// ```
    #[must_use]
    fn finite_or(self, fallback: Self) -> Self;

    /// Zero where the value is a number, and no number, with a slope of zero, where it is infinite or none: a flaw in one lane
    /// spreads through what it is added to there, and a flaw of a slope alone does not.
    ///
    /// # Examples
    /// ```
    /// use robot_model::Scalar;
    /// use robot_model::scalar::Lanes4;
    /// // An encoder that failed spoils the sum of its own lane.
    /// let lanes = Lanes4::from([1.0, f64::NAN, 3.0, f64::INFINITY]);
    /// let sum = (Lanes4::of(5.0) + lanes.flaw()).to_array();
    /// assert_eq!(sum.map(f64::is_finite), [true, false, true, false]);
    /// assert_eq!((sum[0], sum[2]), (5.0, 5.0));
    /// ```
    #[must_use]
    fn flaw(self) -> Self;

    /// The smallest value over the lanes; of a dual number that of its value. NaN where one is NaN.
    ///
    /// # Examples
    /// ```
    /// use robot_model::Scalar;
    /// use robot_model::scalar::{Dual, Lanes4};
    /// assert_eq!(Lanes4::from([1.0, -4.0, 2.5, 0.0]).least(), -4.0);
    /// assert!(Lanes4::from([1.0, f64::NAN, 2.5, 0.0]).least().is_nan());
    /// assert_eq!(Dual { value: 3.0, slope: -7.0 }.least(), 3.0);
    /// ```
    #[must_use]
    fn least(self) -> f64;

    /// The largest value over the lanes; of a dual number that of its value. NaN where one is NaN.
    ///
    /// # Examples
    /// ```
    /// use robot_model::Scalar;
    /// use robot_model::scalar::Lanes4;
    /// let torques = Lanes4::from([1.0, -4.0, 2.5, 0.0]);
    /// assert_eq!((torques.least(), torques.most()), (-4.0, 2.5));
    /// ```
    #[must_use]
    fn most(self) -> f64 {
        -(-self).least()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every function once, where all of them have a value and a slope.
    fn everything<S: Scalar>(x: S) -> S {
        let [[sin, sin_twice], [cos, _]] = S::sines_cosines([x, x + x]);
        let mut sum = sin.mul_add(cos, sin_twice / x);
        sum += x.exp() - x.exp_m1();
        sum -= x.ln() * x.sqrt();
        sum *= x.tanh() + (-x).abs();
        sum /= x.pow(S::of(1.5)) + S::of(2.0).pow(x);
        sum + x.sin() * x.cos() + S::choose(x - S::of(1.0), x, -x) + (-x).sign()
    }

    const POINTS: [f64; 8] = [0.1, 0.4, 0.7, 0.95, 1.1, 1.7, 2.9, 7.3];

    #[test]
    fn lanes_are_numbers_side_by_side() {
        let wanted = POINTS.map(|x| everything(x).to_bits());
        let eight = everything(Lanes8::from(POINTS)).to_array();
        let four = [[0, 1, 2, 3], [4, 5, 6, 7]]
            .map(|part| everything(Lanes4::from(part.map(|k| POINTS[k]))).to_array());
        assert_eq!(eight.map(f64::to_bits), wanted);
        assert_eq!(four.concat().as_slice(), eight);
    }

    #[test]
    fn single_precision_has_seven_digits() {
        for x in POINTS {
            let (found, wanted) = (
                everything(f32::of(x)).least(),
                everything(f32::of(x).least()),
            );
            assert!(
                (found - wanted).abs() < 1e-5 * (1.0 + wanted.abs()),
                "{x}: {found} {wanted}"
            );
        }
    }

    #[test]
    fn slopes_are_those_of_differences() {
        for x in POINTS {
            let dual = everything(Dual {
                value: x,
                slope: 1.0,
            });
            let h = 1e-6;
            let slope = (everything(x + h) - everything(x - h)) / (2.0 * h);
            assert_eq!(dual.value.to_bits(), everything(x).to_bits());
            // Of second order in `h`, and its rounding over `h`.
            assert!(
                (dual.slope - slope).abs() < 1e-8 * (1.0 + slope.abs()),
                "{x}: {dual:?} {slope}"
            );
        }
        let by_exponent = Dual::of(2.0).pow(Dual {
            value: 3.0,
            slope: 1.0,
        });
        assert!((by_exponent.slope - 8.0 * 2.0_f64.ln()).abs() < 1e-14);
        assert_eq!(Dual::<f64>::of(-2.0).pow(Dual::of(2.0)), Dual::of(4.0));
    }

    /// The slope of a slope, also where the slope itself is zero.
    #[test]
    fn duals_of_duals_have_second_derivatives() {
        let t = Dual {
            value: Dual {
                value: 0.0,
                slope: 1.0,
            },
            slope: Dual::of(1.0),
        };
        let second = |x: Dual<Dual<f64>>| x.slope.slope;
        let square = t * t;
        let plus = |c: f64| square + Dual::of(c);
        assert!((second(plus(2.0).exp()) - 2.0 * 2.0_f64.exp()).abs() < 1e-14);
        assert!((second(Scalar::sin(plus(1.0))) - 2.0 * 1.0_f64.cos()).abs() < 1e-14);
        assert!((second(plus(4.0).sqrt()) - 0.5).abs() < 1e-14);
        // The root of a constant zero stands still, however steep it is.
        assert_eq!(Dual::<f64>::of(0.0).sqrt(), Dual::of(0.0));
    }

    #[test]
    fn lanes_are_bounded_by_their_extremes() {
        let lanes = Lanes4::from([3.0, -2.0, 5.0, 0.0]);
        assert_eq!((lanes.least(), lanes.most()), (-2.0, 5.0));
        let broken = Lanes4::from([3.0, f64::NAN, 5.0, 0.0]);
        assert!(broken.least().is_nan() && broken.most().is_nan());
        let signs = Lanes4::from([1.0, -1.0, 1.0, 0.0]);
        assert_eq!(lanes.sign(), signs);
    }
}
