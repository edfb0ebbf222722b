//! Numbers with three infinitesimals `e1, e2, e3`, each of square zero: exact derivatives without symbols.

use std::ops::{Add, Mul};

use robot_model_spec::model::Function;

/// Coefficients of `1, e1, e2, e1 e2, e3, e1 e3, e2 e3, e1 e2 e3`: bit `k` of the index is `e(k+1)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Jet(pub [f64; 8]);

/// Index of `e1`.
pub const E1: usize = 1;
/// Index of `e2`.
pub const E2: usize = 2;
/// Index of `e3`.
pub const E3: usize = 4;

impl Jet {
    /// A number.
    #[must_use]
    pub const fn number(value: f64) -> Self {
        Self([value, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])
    }

    /// The number with a multiple of one infinitesimal added.
    #[must_use]
    pub fn plus(mut self, index: usize, coefficient: f64) -> Self {
        self.0[index] += coefficient;
        self
    }

    /// What `e3` is multiplied with.
    #[must_use]
    pub fn slope_of_e3(&self) -> Self {
        Self(std::array::from_fn(|k| {
            if k & E3 == 0 { self.0[k | E3] } else { 0.0 }
        }))
    }

    /// The jet times `e3`.
    #[must_use]
    pub fn times_e3(&self) -> Self {
        Self(std::array::from_fn(|k| {
            if k & E3 == 0 { 0.0 } else { self.0[k ^ E3] }
        }))
    }

    /// `f(x)` from the values of `f` and its first three derivatives at the number: `sum_k f^(k) n^k / k!`, `n` the
    /// infinitesimal part.
    fn taylor(&self, derivatives: [f64; 4]) -> Self {
        let n = Self(std::array::from_fn(
            |k| if k == 0 { 0.0 } else { self.0[k] },
        ));
        let (n2, n3) = (n * n, n * n * n);
        Self(std::array::from_fn(|k| {
            derivatives[1] * n.0[k]
                + derivatives[2] * n2.0[k] / 2.0
                + derivatives[3] * n3.0[k] / 6.0
        }))
        .plus(0, derivatives[0])
    }

    /// `x ^ p`
    #[must_use]
    pub fn power(&self, p: f64) -> Self {
        let x = self.0[0];
        let term = |factor: f64, k: f64| {
            if factor == 0.0 {
                0.0
            } else {
                factor * x.powf(p - k)
            }
        };
        self.taylor([
            x.powf(p),
            term(p, 1.0),
            term(p * (p - 1.0), 2.0),
            term(p * (p - 1.0) * (p - 2.0), 3.0),
        ])
    }

    /// `f(x)`
    #[must_use]
    pub fn call(&self, function: Function) -> Self {
        let x = self.0[0];
        let (sin, cos) = x.sin_cos();
        match function {
            Function::Sin => self.taylor([sin, cos, -sin, -cos]),
            Function::Cos => self.taylor([cos, -sin, -cos, sin]),
            Function::Exp => self.taylor([x.exp(); 4]),
            Function::Sqrt => self.power(0.5),
            Function::Abs => self.taylor([x.abs(), x.signum(), 0.0, 0.0]),
            Function::Sign => Self::number(function.apply(x)),
            Function::Tanh => {
                let t = x.tanh();
                let s = 1.0 - t * t;
                self.taylor([t, s, -2.0 * t * s, s * (6.0 * t * t - 2.0)])
            }
        }
    }
}

impl Add for Jet {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self(std::array::from_fn(|k| self.0[k] + other.0[k]))
    }
}

impl Mul for Jet {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let mut product = [0.0; 8];
        for (i, x) in self.0.iter().enumerate() {
            for (j, y) in other.0.iter().enumerate() {
                if i & j == 0 {
                    product[i | j] += x * y;
                }
            }
        }
        Self(product)
    }
}
