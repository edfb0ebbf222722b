//! Elementary functions of `f64` with and without `std`.
//!
//! `core` has no `sin` or `sqrt` for `f64`; without the `std` feature they come from `libm`.

macro_rules! functions {
    ($($(#[$doc:meta])* $name:ident($($x:ident),+) = $std:path | $libm:path;)+) => {
        $(
            $(#[$doc])*
            #[inline]
            #[must_use]
            pub fn $name($($x: f64),+) -> f64 {
                #[cfg(feature = "std")]
                return $std($($x),+);
                #[cfg(not(feature = "std"))]
                return $libm($($x),+);
            }
        )+
    };
}

functions! {
    /// Sine of an angle in rad.
    sin(x) = f64::sin | libm::sin;
    /// Cosine of an angle in rad.
    cos(x) = f64::cos | libm::cos;
    /// `e^x`
    exp(x) = f64::exp | libm::exp;
    /// `e^x - 1`, exact near 0.
    exp_m1(x) = f64::exp_m1 | libm::expm1;
    /// Natural logarithm.
    ln(x) = f64::ln | libm::log;
    /// Square root.
    sqrt(x) = f64::sqrt | libm::sqrt;
    /// Hyperbolic tangent.
    tanh(x) = f64::tanh | libm::tanh;
    /// `x^y`
    pow(x, y) = f64::powf | libm::pow;
}

/// Absolute value.
#[inline]
#[must_use]
pub const fn abs(x: f64) -> f64 {
    x.abs()
}

/// -1, 0 or 1; 0 at 0, unlike `f64::signum`.
#[inline]
#[must_use]
pub fn sign(x: f64) -> f64 {
    if x > 0.0 {
        1.0
    } else if x < 0.0 {
        -1.0
    } else {
        // 0 stays 0, NaN stays NaN.
        x
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn sign_is_zero_at_zero_and_nan_at_nan() {
        let signs = [-2.5, 0.0, 3.0].map(|x| super::sign(x).to_bits());
        assert_eq!(signs, [-1.0f64, 0.0, 1.0].map(f64::to_bits));
        assert!(super::sign(f64::NAN).is_nan());
    }

    #[test]
    fn std_and_libm_agree_to_rounding() {
        let x = 0.73;
        let pairs = [
            (super::sin(x), libm::sin(x)),
            (super::cos(x), libm::cos(x)),
            (super::exp(x), libm::exp(x)),
            (super::exp_m1(x), libm::expm1(x)),
            (super::ln(x), libm::log(x)),
            (super::sqrt(x), libm::sqrt(x)),
            (super::tanh(x), libm::tanh(x)),
            (super::pow(x, 2.2), libm::pow(x, 2.2)),
        ];
        for (ours, reference) in pairs {
            assert!((ours - reference).abs() < 1e-15, "{ours} {reference}");
        }
    }
}
