//! Functions of the coordinates in a canonical form: sums of products of rates, powers and one sine or cosine.
//!
//! Two expressions of a robot's energy are the same function exactly when their series are the same, so coefficients of
//! equal functions can be collected. A function without a series (a root, a quotient of coordinates) has none here.

use std::collections::BTreeMap;

use robot_model_spec::model::Function as SpecFunction;
use robot_model_spec::polynomial::{Ring, whole};

use crate::rounded::{Rounded, UNIT};

/// One function of a series. Ordered by rates, then powers, then frequency, cosine before sine.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Harmonic {
    /// Exponent of each rate.
    pub rates: Vec<i32>,
    /// Exponent of each coordinate.
    pub powers: Vec<i32>,
    /// Sum of the magnitudes of `multiples`.
    frequency: i32,
    /// Argument of the sine or cosine: the sum of `multiple * coordinate`; the first that is not zero is positive.
    pub multiples: Vec<i32>,
    /// A sine, else a cosine.
    pub sine: bool,
}

/// A sum of harmonics with coefficients; none of them is nothing but rounding.
pub type Series = BTreeMap<Harmonic, Rounded>;

/// A sine of more than this multiple of a coordinate is not expanded.
const LARGEST_MULTIPLE: i32 = 64;

/// Series as coefficients of parameters.
pub struct SeriesRing {
    dof: usize,
    /// Products of harmonics that may still be made.
    left: usize,
}

impl SeriesRing {
    /// The ring of functions of so many coordinates.
    #[must_use]
    pub const fn new(dof: usize) -> Self {
        /// Beyond this, lumping would take longer than the other way to base parameters.
        const MOST_PRODUCTS: usize = 300_000;
        Self {
            dof,
            left: MOST_PRODUCTS,
        }
    }

    /// Whether a product was cut short for its size: then no series is right.
    #[must_use]
    pub const fn is_exhausted(&self) -> bool {
        self.left == 0
    }

    fn harmonic(&self) -> Harmonic {
        Harmonic {
            rates: vec![0; self.dof],
            powers: vec![0; self.dof],
            frequency: 0,
            multiples: vec![0; self.dof],
            sine: false,
        }
    }

    fn constant(&self, value: Rounded) -> Series {
        let mut series = Series::new();
        accumulate(&mut series, self.harmonic(), value);
        series
    }

    fn as_rounded(&self, x: &Series) -> Option<Rounded> {
        match x.len() {
            0 => Some(Rounded::ZERO),
            1 => x.get(&self.harmonic()).copied(),
            _ => None,
        }
    }

    /// `(multiples, offset)` of an argument that is a sum of whole multiples of coordinates.
    fn argument(&self, x: &Series) -> Option<(Vec<i32>, Rounded)> {
        let mut multiples = vec![0; self.dof];
        let mut offset = Rounded::ZERO;
        for (harmonic, &coefficient) in x {
            if harmonic.rates.iter().any(|k| *k != 0) || harmonic.frequency != 0 {
                return None;
            }
            match harmonic.powers.iter().sum::<i32>() {
                0 => offset = coefficient,
                1 => {
                    let coordinate = harmonic.powers.iter().position(|k| *k == 1)?;
                    multiples[coordinate] = whole(coefficient.value, LARGEST_MULTIPLE)?;
                }
                _ => return None,
            }
        }
        Some((multiples, offset))
    }
}

impl Ring for SeriesRing {
    type Element = Series;

    fn number(&mut self, value: f64) -> Series {
        self.constant(Rounded::constant(value))
    }

    fn as_number(&self, x: &Series) -> Option<f64> {
        self.as_rounded(x).map(|number| number.value)
    }

    fn coordinate(&mut self, joint: usize) -> Series {
        let mut harmonic = self.harmonic();
        harmonic.powers[joint] = 1;
        Series::from([(harmonic, ONE)])
    }

    fn rate(&mut self, joint: usize) -> Series {
        let mut harmonic = self.harmonic();
        harmonic.rates[joint] = 1;
        Series::from([(harmonic, ONE)])
    }

    fn add(&mut self, x: &Series, y: &Series) -> Series {
        let mut sum = x.clone();
        for (harmonic, &coefficient) in y {
            accumulate(&mut sum, harmonic.clone(), coefficient);
        }
        sum
    }

    fn mul(&mut self, x: &Series, y: &Series) -> Series {
        let mut product = Series::new();
        self.left = self.left.saturating_sub(x.len().saturating_mul(y.len()));
        if self.is_exhausted() {
            return product;
        }
        for (left, a) in x {
            for (right, b) in y {
                for (harmonic, factor) in left.times(right) {
                    accumulate(&mut product, harmonic, exact(factor) * *a * *b);
                }
            }
        }
        product
    }

    fn power(&mut self, x: &Series, y: &Series) -> Option<Series> {
        let exponent = self.as_number(y)?;
        if let Some(base) = self.as_rounded(x) {
            let power = base.power(exponent);
            return power.value.is_finite().then(|| self.constant(power));
        }
        let exponent = whole(exponent, 16).filter(|k| *k >= 0)?;
        let mut power = self.constant(ONE);
        for _ in 0..exponent {
            power = self.mul(&power, x);
        }
        Some(power)
    }

    fn call(&mut self, function: SpecFunction, x: &Series) -> Option<Series> {
        if let Some(number) = self.as_rounded(x) {
            let value = Rounded::constant(function.apply(number.value));
            return value.value.is_finite().then(|| self.constant(value));
        }
        let (multiples, offset) = self.argument(x)?;
        let (sin, cos) = offset.value.sin_cos();
        // Quarter turns are exact: what is left beside them is rounding of the angle.
        let of_angle = |value: f64| Rounded::after(value, offset.error + UNIT).cleaned();
        // sin(x + c) = sin x cos c + cos x sin c, cos(x + c) = cos x cos c - sin x sin c
        let (of_sine, of_cosine) = match function {
            SpecFunction::Sin => (cos, sin),
            SpecFunction::Cos => (-sin, cos),
            _ => return None,
        };
        let mut series = Series::new();
        for (sine, coefficient) in [(true, of_sine), (false, of_cosine)] {
            let (harmonic, sign) = self.harmonic().turning(multiples.clone(), sine);
            accumulate(&mut series, harmonic, exact(sign) * of_angle(coefficient));
        }
        Some(series)
    }

    fn derivative(&mut self, x: &Series) -> Option<Series> {
        let mut derivative = Series::new();
        for joint in 0..self.dof {
            for (harmonic, &coefficient) in x {
                for (mut slope, factor) in harmonic.slopes(joint) {
                    slope.rates[joint] += 1;
                    accumulate(&mut derivative, slope, exact(factor) * coefficient);
                }
            }
        }
        Some(derivative)
    }

    fn is_zero(&self, x: &Series) -> bool {
        x.is_empty()
    }
}

const ONE: Rounded = Rounded {
    value: 1.0,
    error: 0.0,
};

/// A sign, or a half.
fn exact(value: f64) -> Rounded {
    Rounded::relative(value, 0.0)
}

/// A named rounding step: a coefficient that is nothing but rounding of what it was made of is gone.
fn accumulate(series: &mut Series, harmonic: Harmonic, coefficient: Rounded) {
    let before = series.get(&harmonic).copied().unwrap_or_default();
    let after = (before + coefficient).cleaned();
    // The sine of nothing is nothing.
    let nothing = harmonic.sine && harmonic.frequency == 0;
    if nothing || after == Rounded::ZERO {
        series.remove(&harmonic);
    } else {
        series.insert(harmonic, after);
    }
}

/// Makes the first multiple that is not zero positive; whether that changed the sign of the argument.
pub fn turned_positive(multiples: &mut [i32]) -> bool {
    let negative = multiples.iter().find(|k| **k != 0).is_some_and(|k| *k < 0);
    if negative {
        for k in multiples {
            *k = -*k;
        }
    }
    negative
}

impl Harmonic {
    /// The same rates and powers with `sin` or `cos` of an argument, and the sign that brings it to its canonical form.
    fn turning(mut self, mut multiples: Vec<i32>, sine: bool) -> (Self, f64) {
        let negative = turned_positive(&mut multiples);
        self.frequency = multiples.iter().map(|k| k.abs()).sum();
        self.multiples = multiples;
        self.sine = sine;
        (self, if negative && sine { -1.0 } else { 1.0 })
    }

    /// The product as a sum of harmonics: `cos a cos b = (cos(a - b) + cos(a + b)) / 2` and its like.
    fn times(&self, other: &Self) -> Vec<(Self, f64)> {
        let add = |x: &[i32], y: &[i32], sign: i32| -> Vec<i32> {
            x.iter().zip(y).map(|(x, y)| x + sign * y).collect()
        };
        let plain = Self {
            rates: add(&self.rates, &other.rates, 1),
            powers: add(&self.powers, &other.powers, 1),
            ..self.clone()
        };
        let sum = add(&self.multiples, &other.multiples, 1);
        let difference = add(&self.multiples, &other.multiples, -1);
        let (sine, of_difference, of_sum) = match (self.sine, other.sine) {
            (false, false) => (false, 0.5, 0.5),
            (true, true) => (false, 0.5, -0.5),
            (true, false) => (true, 0.5, 0.5),
            // cos a sin b = (sin(a + b) - sin(a - b)) / 2
            (false, true) => (true, -0.5, 0.5),
        };
        [(difference, of_difference), (sum, of_sum)]
            .into_iter()
            .map(|(multiples, factor)| {
                let (harmonic, sign) = plain.clone().turning(multiples, sine);
                (harmonic, sign * factor)
            })
            .collect()
    }

    /// The derivative with respect to one coordinate.
    fn slopes(&self, joint: usize) -> Vec<(Self, f64)> {
        let mut slopes = Vec::new();
        if self.powers[joint] != 0 {
            let mut slope = self.clone();
            slope.powers[joint] -= 1;
            slopes.push((slope, f64::from(self.powers[joint])));
        }
        if self.multiples[joint] != 0 {
            let slope = Self {
                sine: !self.sine,
                ..self.clone()
            };
            let sign = if self.sine { 1.0 } else { -1.0 };
            slopes.push((slope, sign * f64::from(self.multiples[joint])));
        }
        slopes
    }

    /// Whether the function depends on no coordinate.
    #[must_use]
    pub fn is_still(&self) -> bool {
        self.frequency == 0 && self.powers.iter().all(|k| *k == 0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(series: &Series, q: [f64; 2], dq: [f64; 2]) -> f64 {
        let term = |(harmonic, coefficient): (&Harmonic, &Rounded)| {
            let power = |x: [f64; 2], k: &[i32]| x[0].powi(k[0]) * x[1].powi(k[1]);
            let m = &harmonic.multiples;
            let angle = f64::from(m[0]) * q[0] + f64::from(m[1]) * q[1];
            let wave = if harmonic.sine {
                angle.sin()
            } else {
                angle.cos()
            };
            coefficient.value * power(q, &harmonic.powers) * power(dq, &harmonic.rates) * wave
        };
        series.iter().map(term).sum()
    }

    #[test]
    fn sums_products_and_rates_are_those_of_the_functions() {
        let mut ring = SeriesRing::new(2);
        let (x, y) = (ring.coordinate(0), ring.coordinate(1));
        let (vx, two) = (ring.rate(0), ring.number(2.0));
        let quarter = ring.number(std::f64::consts::FRAC_PI_4);
        // f = sin(2 x - y) cos(y + pi/4) x + (x - cos(2 x - y))^2
        let twice = ring.mul(&two, &x);
        let minus = ring.number(-1.0);
        let back = ring.mul(&minus, &y);
        let angle = ring.add(&twice, &back);
        let shifted = ring.add(&y, &quarter);
        let sin = ring.call(SpecFunction::Sin, &angle).unwrap();
        let cos = ring.call(SpecFunction::Cos, &angle).unwrap();
        let other = ring.call(SpecFunction::Cos, &shifted).unwrap();
        let first = ring.mul(&sin, &other);
        let first = ring.mul(&first, &x);
        let less = ring.mul(&minus, &cos);
        let base = ring.add(&x, &less);
        let square = ring.power(&base, &two).unwrap();
        let series = ring.add(&first, &square);
        let f = |q: [f64; 2]| {
            let angle = 2.0 * q[0] - q[1];
            angle.sin() * (q[1] + std::f64::consts::FRAC_PI_4).cos() * q[0]
                + (q[0] - angle.cos()).powi(2)
        };
        let (q, dq) = ([0.7, -1.9], [0.4, 1.3]);
        assert!((value(&series, q, dq) - f(q)).abs() < 1e-14);

        let rate = ring.derivative(&series).unwrap();
        let h = 1e-6;
        let at = |t: f64| f([q[0] + t * dq[0], q[1] + t * dq[1]]);
        let wanted = (at(h) - at(-h)) / (2.0 * h);
        assert!((value(&rate, q, dq) - wanted).abs() < 1e-8);

        // sin^2 + cos^2 = 1, with no term left.
        let (sin2, cos2) = (ring.mul(&sin, &sin), ring.mul(&cos, &cos));
        let one = ring.add(&sin2, &cos2);
        assert_eq!(ring.as_number(&one), Some(1.0));
        assert_eq!(ring.power(&vx, &minus), None);
        assert_eq!(ring.call(SpecFunction::Sqrt, &x), None);
    }
}
