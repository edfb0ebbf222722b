//! `f64` and `f32`.

use super::{Scalar, sealed, sin_cos};
use crate::math;

/// Where the target has no instruction for it, the function of that name is slower than all the rest; `core` has none, and the
/// one in the lane of a register costs more moves than it spares.
macro_rules! mul_add {
    () => {
        #[inline]
        fn mul_add(self, factor: Self, term: Self) -> Self {
            #[cfg(all(feature = "std", any(target_feature = "fma", target_arch = "aarch64")))]
            return Self::mul_add(self, factor, term);
            #[cfg(not(all(
                feature = "std",
                any(target_feature = "fma", target_arch = "aarch64")
            )))]
            return self * factor + term;
        }
    };
}

impl sealed::Sealed for f64 {}
impl sealed::Sealed for f32 {}

impl Scalar for f64 {
    const ROUNDING: f64 = f64::EPSILON / 2.0;

    #[inline]
    fn of(value: f64) -> Self {
        value
    }

    mul_add!();

    #[expect(clippy::inline_always, reason = "see `sin_cos`")]
    #[inline(always)]
    fn sines_cosines<const N: usize>(angles: [Self; N]) -> [[Self; N]; 2] {
        sin_cos::of(angles)
    }

    #[inline]
    fn exp(self) -> Self {
        math::exp(self)
    }

    #[inline]
    fn exp_m1(self) -> Self {
        math::exp_m1(self)
    }

    #[inline]
    fn ln(self) -> Self {
        math::ln(self)
    }

    #[inline]
    fn sqrt(self) -> Self {
        math::sqrt(self)
    }

    #[inline]
    fn tanh(self) -> Self {
        math::tanh(self)
    }

    #[inline]
    fn pow(self, exponent: Self) -> Self {
        math::pow(self, exponent)
    }

    #[inline]
    fn abs(self) -> Self {
        math::abs(self)
    }

    #[inline]
    fn sign(self) -> Self {
        math::sign(self)
    }

    #[inline]
    fn choose(condition: Self, positive: Self, otherwise: Self) -> Self {
        if condition > 0.0 { positive } else { otherwise }
    }

    #[inline]
    fn finite_or(self, fallback: Self) -> Self {
        if self.is_finite() { self } else { fallback }
    }

    #[inline]
    fn flaw(self) -> Self {
        self * 0.0
    }

    #[inline]
    fn least(self) -> f64 {
        self
    }
}

macro_rules! functions_of_f32 {
    ($($name:ident($($x:ident),*) = $std:path | $libm:path;)+) => {
        $(
            #[inline]
            fn $name(self $(, $x: Self)*) -> Self {
                #[cfg(feature = "std")]
                return $std(self $(, $x)*);
                #[cfg(not(feature = "std"))]
                return $libm(self $(, $x)*);
            }
        )+
    };
}

/// In its own precision throughout. Where `f64` is not in hardware, call emitted functions with a `beta` in `f32`: a value of an
/// arm's type holds its parameters in `f64`, and combines and rounds them at every call.
impl Scalar for f32 {
    const ROUNDING: f64 = f32::EPSILON as f64 / 2.0;

    #[expect(
        clippy::cast_possible_truncation,
        reason = "rounded to the precision that is wanted"
    )]
    #[inline]
    fn of(value: f64) -> Self {
        value as Self
    }

    mul_add!();

    #[inline]
    fn sines_cosines<const N: usize>(angles: [Self; N]) -> [[Self; N]; 2] {
        let mut out = [[0.0; N]; 2];
        for (k, angle) in angles.into_iter().enumerate() {
            #[cfg(feature = "std")]
            let (sin, cos) = Self::sin_cos(angle);
            #[cfg(not(feature = "std"))]
            let (sin, cos) = libm::sincosf(angle);
            (out[0][k], out[1][k]) = (sin, cos);
        }
        out
    }

    functions_of_f32! {
        exp() = f32::exp | libm::expf;
        exp_m1() = f32::exp_m1 | libm::expm1f;
        ln() = f32::ln | libm::logf;
        sqrt() = f32::sqrt | libm::sqrtf;
        tanh() = f32::tanh | libm::tanhf;
        pow(exponent) = f32::powf | libm::powf;
    }

    #[inline]
    fn abs(self) -> Self {
        Self::abs(self)
    }

    #[inline]
    fn sign(self) -> Self {
        if self > 0.0 {
            1.0
        } else if self < 0.0 {
            -1.0
        } else {
            // 0 stays 0, NaN stays NaN.
            self
        }
    }

    #[inline]
    fn choose(condition: Self, positive: Self, otherwise: Self) -> Self {
        if condition > 0.0 { positive } else { otherwise }
    }

    #[inline]
    fn finite_or(self, fallback: Self) -> Self {
        if self.is_finite() { self } else { fallback }
    }

    #[inline]
    fn flaw(self) -> Self {
        self * 0.0
    }

    #[inline]
    fn least(self) -> f64 {
        f64::from(self)
    }
}
