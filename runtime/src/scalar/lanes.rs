//! Several states at once, one to a lane of the machine's vector registers.

use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use num_traits::{One, Zero};
use wide::{f64x4, f64x8};

use super::{Scalar, sealed, sin_cos};
use crate::math;

macro_rules! lanes {
    ($(#[$doc:meta])* $name:ident($floats:ident, $count:literal, $sin_cos:ident)) => {
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq, Default)]
        pub struct $name($floats);

        impl $name {
            /// How many states there are.
            pub const COUNT: usize = $count;

            /// The numbers, lane by lane.
            ///
            /// # Examples
            /// ```
            #[doc = concat!("use robot_model::scalar::", stringify!($name), ";")]
            #[doc = concat!("let lanes = ", stringify!($name), "::from([2.0; ", $count, "]);")]
            #[doc = concat!("assert_eq!((lanes * lanes + 0.5).to_array(), [4.5; ", $count, "]);")]
            /// ```
            #[inline]
            #[must_use]
            pub fn to_array(self) -> [f64; $count] {
                self.0.to_array()
            }

            fn map(self, f: impl Fn(f64) -> f64) -> Self {
                self.to_array().map(f).into()
            }
        }

        /// The same number in every lane.
        impl From<f64> for $name {
            #[inline]
            fn from(value: f64) -> Self {
                Self::of(value)
            }
        }

        impl From<[f64; $count]> for $name {
            #[inline]
            fn from(values: [f64; $count]) -> Self {
                Self(values.into())
            }
        }

        lanes!(@operators $name, Add add AddAssign add_assign);
        lanes!(@operators $name, Sub sub SubAssign sub_assign);
        lanes!(@operators $name, Mul mul MulAssign mul_assign);
        lanes!(@operators $name, Div div DivAssign div_assign);

        impl Neg for $name {
            type Output = Self;
            #[inline]
            fn neg(self) -> Self {
                Self(-self.0)
            }
        }

        impl Zero for $name {
            #[inline]
            fn zero() -> Self {
                Self::of(0.0)
            }
            #[inline]
            fn is_zero(&self) -> bool {
                *self == Self::zero()
            }
        }

        impl One for $name {
            #[inline]
            fn one() -> Self {
                Self::of(1.0)
            }
        }

        impl sealed::Sealed for $name {}

        impl Scalar for $name {
            const ROUNDING: f64 = f64::EPSILON / 2.0;

            #[inline]
            fn of(value: f64) -> Self {
                Self($floats::splat(value))
            }

            #[inline]
            fn mul_add(self, factor: Self, term: Self) -> Self {
                Self(self.0.mul_add(factor.0, term.0))
            }

            #[inline]
            fn sines_cosines<const N: usize>(angles: [Self; N]) -> [[Self; N]; 2] {
                let both = angles.map(|angle| sin_cos::$sin_cos(angle.0));
                [both.map(|[sin, _]| Self(sin)), both.map(|[_, cos]| Self(cos))]
            }

            #[inline]
            fn exp(self) -> Self {
                self.map(math::exp)
            }

            #[inline]
            fn exp_m1(self) -> Self {
                self.map(math::exp_m1)
            }

            #[inline]
            fn ln(self) -> Self {
                self.map(math::ln)
            }

            #[inline]
            fn sqrt(self) -> Self {
                Self(self.0.sqrt())
            }

            #[inline]
            fn tanh(self) -> Self {
                self.map(math::tanh)
            }

            #[inline]
            fn pow(self, exponent: Self) -> Self {
                let (bases, exponents) = (self.to_array(), exponent.to_array());
                core::array::from_fn(|k| math::pow(bases[k], exponents[k])).into()
            }

            #[inline]
            fn abs(self) -> Self {
                Self(self.0.abs())
            }

            #[inline]
            fn sign(self) -> Self {
                self.map(math::sign)
            }

            #[inline]
            fn choose(condition: Self, positive: Self, otherwise: Self) -> Self {
                let mask = condition.0.simd_gt($floats::splat(0.0));
                Self(mask.bitselect(positive.0, otherwise.0))
            }

            #[inline]
            fn finite_or(self, fallback: Self) -> Self {
                Self(self.0.is_finite().bitselect(self.0, fallback.0))
            }

            #[inline]
            fn flaw(self) -> Self {
                self * Self::zero()
            }

            #[inline]
            fn least(self) -> f64 {
                // `f64::min` would pass over what is no number.
                let smaller = |least: f64, x: f64| if x < least || x.is_nan() { x } else { least };
                self.to_array().into_iter().fold(f64::INFINITY, smaller)
            }
        }
    };
    (@operators $name:ident, $operator:ident $function:ident $assign:ident $assigning:ident) => {
        impl $operator<f64> for $name {
            type Output = Self;
            #[inline]
            fn $function(self, other: f64) -> Self {
                $operator::$function(self, Self::of(other))
            }
        }

        impl $operator for $name {
            type Output = Self;
            #[inline]
            fn $function(self, other: Self) -> Self {
                Self($operator::$function(self.0, other.0))
            }
        }

        impl $assign for $name {
            #[inline]
            fn $assigning(&mut self, other: Self) {
                *self = $operator::$function(*self, other);
            }
        }
    };
}

lanes! {
    /// Four states at once: a vector register of machines with AVX2.
    Lanes4(f64x4, 4, of4)
}
lanes! {
    /// Eight states at once: a vector register of machines with AVX-512.
    Lanes8(f64x8, 8, of8)
}
