//! Sine and cosine of several angles at once, without branches.
//!
//! `x = k pi/2 + r` by the three-part reduction of Cody and Waite, with the rounding of its second part carried along; sine and
//! cosine of `r` by the polynomials of fdlibm (Sun Microsystems 1993), whose errors are below half a unit in the last place; the
//! two lowest bits of `k` say which is which and their signs. An angle beyond [`LIMIT`], or no number, goes to
//! the general functions.

#![expect(
    clippy::inline_always,
    reason = "behind a call the angles are an array in memory, written in parts and read at once, and all that follows waits for it"
)]

use wide::{f64x4, f64x8, u64x4, u64x8};

use crate::math;

/// Up to here `k` has so few digits that its product with the first two parts of `pi/2` is exact, rad.
const LIMIT: f64 = 1e6;

/// `1.5 * 2^52`: a small number added to it is rounded to an integer, which stands in the lowest bits.
const TO_INTEGER: f64 = 6_755_399_441_055_744.0;

/// `pi/2` in parts of 33 bits, and the rest.
const HALF_TURN: [f64; 3] = [
    1.570_796_326_734_125_6,
    6.077_100_506_303_966e-11,
    2.022_266_248_795_950_6e-21,
];

/// `sin r = r + r^3 (S0 + S1 r^2 + ..)`, highest power first.
const SIN: [f64; 6] = [
    1.589_690_995_211_55e-10,
    -2.505_076_025_340_686_3e-8,
    2.755_731_370_707_006_8e-6,
    -1.984_126_982_985_795e-4,
    8.333_333_333_322_49e-3,
    -1.666_666_666_666_663_2e-1,
];

/// `cos r = 1 - r^2/2 + r^4 (C0 + C1 r^2 + ..)`, highest power first.
const COS: [f64; 6] = [
    -1.135_964_755_778_819_5e-11,
    2.087_572_321_298_175e-9,
    -2.755_731_435_139_066_3e-7,
    2.480_158_728_947_673e-5,
    -1.388_888_888_887_411e-3,
    4.166_666_666_666_66e-2,
];

macro_rules! kernel {
    ($(#[$doc:meta])* $name:ident($floats:ident, $bits:ident, [$($lane:ident)*])) => {
        $(#[$doc])*
        #[inline(always)]
        pub fn $name(x: $floats) -> [$floats; 2] {
            // Numbers as arguments: an array would be in memory, and the fast road would wait for it.
            #[allow(clippy::too_many_arguments, reason = "one a lane")]
            #[cold]
            #[inline(never)]
            fn general($($lane: f64),*) -> [$floats; 2] {
                [$floats::from([$(math::sin($lane)),*]), $floats::from([$(math::cos($lane)),*])]
            }

            let c = $floats::splat;
            let shifted = x.mul_add(c(core::f64::consts::FRAC_2_PI), c(TO_INTEGER));
            let k = shifted - c(TO_INTEGER);
            let bits: $bits = bytemuck::cast(shifted);

            let t = k.mul_neg_add(c(HALF_TURN[0]), x);
            let r = k.mul_neg_add(c(HALF_TURN[1]), t);
            let lost = k.mul_neg_add(c(HALF_TURN[1]), t - r);
            // The angle is `r + tail`, whose first order is enough, and for which the series need not wait:
            // `sin r + tail cos r`, `cos r - tail sin r`.
            let tail = k.mul_neg_add(c(HALF_TURN[2]), lost);

            let z = r * r;
            let zz = z * z;
            // Pairs of terms side by side, as Estrin has it: in a plain Horner scheme each step waits for the one before.
            let series = |terms: &[f64; 6]| {
                let [high, mid, low] = [(0, 1), (2, 3), (4, 5)].map(|(a, b)| c(terms[a]).mul_add(z, c(terms[b])));
                high.mul_add(zz, mid).mul_add(zz, low)
            };
            let half = z * c(0.5);
            let one = c(1.0) - half;
            let sin = r + (r * z).mul_add(series(&SIN), tail * one);
            let slope = r * z.mul_neg_add(c(1.0 / 6.0), c(1.0));
            let rest = slope.mul_neg_add(tail, (c(1.0) - one) - half);
            let cos = one + zz.mul_add(series(&COS), rest);

            // All bits where `k` is odd.
            let odd: $floats = bytemuck::cast($bits::splat(0) - (bits & $bits::splat(1)));
            let sign = |quadrants: $bits| -> $floats { bytemuck::cast((quadrants & $bits::splat(2)) << 62) };
            let both = [
                odd.bitselect(cos, sin) ^ sign(bits),
                odd.bitselect(sin, cos) ^ sign(bits + $bits::splat(1)),
            ];
            let near = x.abs().simd_le(c(LIMIT));
            if near.all() {
                return both;
            }
            let [$($lane),*] = x.to_array();
            let general = general($($lane),*);
            [near.bitselect(both[0], general[0]), near.bitselect(both[1], general[1])]
        }
    };
}

kernel! {
    /// Sines, cosines.
    of4(f64x4, u64x4, [a b c d])
}
kernel! {
    /// Sines, cosines.
    of8(f64x8, u64x8, [a b c d e f g h])
}

/// Sines and cosines of any number of angles.
#[inline(always)]
pub fn of<const N: usize>(angles: [f64; N]) -> [[f64; N]; 2] {
    let mut both = [[0.0; N]; 2];
    let mut first = 0;
    while first < N {
        // Entry by entry: a slice would be copied through memory.
        let angle = |k: usize| angles.get(first + k).copied().unwrap_or(0.0);
        // Registers of four: eight angles from several places would meet in memory on their way into one register of eight, which
        // waits for the slowest store; two fours are filled from registers.
        if N - first > 4 && !cfg!(target_feature = "avx") {
            let values = of8(core::array::from_fn(angle).into());
            put(&mut both, first, values.map(f64x8::to_array));
            first += 8;
        } else {
            let values = of4(core::array::from_fn(angle).into());
            put(&mut both, first, values.map(f64x4::to_array));
            first += 4;
        }
    }
    both
}

#[inline(always)]
fn put<const N: usize, const LANES: usize>(
    both: &mut [[f64; N]; 2],
    first: usize,
    values: [[f64; LANES]; 2],
) {
    for (both, values) in both.iter_mut().zip(values) {
        for (out, value) in both[first..].iter_mut().zip(values) {
            *out = value;
        }
    }
}

#[cfg(test)]
mod tests {
    use rand::{RngExt as _, SeedableRng as _};
    use rand_chacha::ChaCha8Rng;

    use super::of;

    /// Difference in units in the last place of `wanted`.
    fn ulps(found: f64, wanted: f64) -> f64 {
        let size = wanted.abs();
        let unit = f64::from_bits(size.to_bits() + 1) - size;
        (found - wanted).abs() / unit
    }

    #[track_caller]
    fn assert_close(angles: [f64; 7]) {
        let [sines, cosines] = of(angles);
        for ((angle, sin), cos) in angles.into_iter().zip(sines).zip(cosines) {
            for (found, wanted) in [(sin, libm::sin(angle)), (cos, libm::cos(angle))] {
                // libm itself is within one, and in all but a few of a million numbers within a half.
                let error = ulps(found, wanted);
                assert!(error <= 2.0, "{angle:e}: {error} ulp");
            }
        }
    }

    #[test]
    fn within_two_units_in_the_last_place() {
        let mut random = ChaCha8Rng::seed_from_u64(1);
        for size in [1e-300, 1e-8, 0.5, 4.0, 100.0, 1e6] {
            for _ in 0..20_000 {
                assert_close(core::array::from_fn(|_| random.random_range(-size..size)));
            }
        }
    }

    /// Where a sine or a cosine is next to nothing, all of its digits come from the reduction.
    #[test]
    fn near_multiples_of_a_quarter_turn() {
        for k in 0..600_000 {
            let angle = f64::from(k) * core::f64::consts::FRAC_PI_2;
            let near = |steps: i64| f64::from_bits(angle.to_bits().saturating_add_signed(steps));
            assert_close([
                near(-1),
                near(0),
                near(1),
                near(2),
                -near(0),
                near(-2),
                near(3),
            ]);
        }
    }

    #[test]
    fn beyond_all_arms_and_at_no_number() {
        assert_close([1e7, -3e15, 1e22, 2.0, 1e300, -1e6, 0.1]);
        let [[nan, infinite, sound], [zero, ..]] = of([f64::NAN, f64::INFINITY, 0.5]);
        assert!(nan.is_nan() && infinite.is_nan() && zero.is_nan());
        assert!((sound - 0.5_f64.sin()).abs() < 1e-15);
        assert_eq!(of([]), [[0.0; 0]; 2]);
    }
}
