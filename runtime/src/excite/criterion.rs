//! What makes a motion good: functions of the information matrix `A = mean over samples of Y^T W^2 Y`, with their slopes.

use faer::linalg::solvers::Solve;
use faer::{Mat, Side};

/// What is minimized, in logarithms; `lambda` are the eigenvalues of the information matrix.
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
pub enum Criterion {
    /// `-ln det A / n`: the volume of the parameters' confidence ellipsoid. It does not depend on their units.
    #[default]
    DOptimal,
    /// `ln cond(Y) = ln(lambda_max / lambda_min) / 2`: how much the worst-known direction is worse than the best.
    Condition,
    /// `-ln(lambda_min) / 2`: the longest axis of the ellipsoid.
    EOptimal,
    /// `-sum ln A_jj / n`, Hadamard's bound of the determinant (Liu et al., A New Joint Friction Model, equation 29, whose product of sums is this
    /// sum of logarithms): the lengths of the columns alone. It does not see columns that look alike, and with columns
    /// of unit length it is constant.
    Hadamard,
    /// `-ln` of the product of the squared distances of two effects, each from all that the model and the other can do.
    Separation(Rivals),
}

/// Two effects that are to be told apart: columns of the regressor with what they are worth.
///
/// The T-optimal distance `D = min over delta of |Z_1 g_1 - [W Z_2] delta|^2` is how much of the first effect neither the model's
/// columns `W` nor those of its rival can imitate. With `A` over all columns it is the Schur complement
/// `g_1^T (A_11 - A_1x A_xx^-1 A_x1) g_1`. Source: Atkinson & Fedorov 1975.
#[derive(Debug, Clone, PartialEq)]
pub struct Rivals {
    /// Columns of each with the sizes that the effect is expected to have.
    pub effects: [Vec<(usize, f64)>; 2],
}

/// Columns as they are counted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub enum Scaling {
    /// In SI units.
    #[default]
    Raw,
    /// Each divided by its length.
    UnitLength,
}

/// How sharply smooth stand-ins follow the largest and the smallest eigenvalue: `(sum lambda^p)^(1/p)`. The largest of `n` is
/// missed by a factor `n^(1/p)` at most.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Sharpness(pub f64);

/// A value with `slopes[i][j] = d value / d A_ij`, symmetric.
pub(super) struct Valued {
    pub value: f64,
    pub slopes: Mat<f64>,
}

impl Criterion {
    /// The value and its slopes; `None` where the matrix is singular.
    pub(super) fn evaluate(
        &self,
        a: &Mat<f64>,
        scaling: Scaling,
        sharpness: Sharpness,
    ) -> Option<Valued> {
        // Nothing to be scaled: the determinant's slopes do not see it, a rival's columns have sizes.
        let is_scaled = matches!(self, Self::Condition | Self::EOptimal | Self::Hadamard);
        if scaling == Scaling::Raw || !is_scaled {
            return self.of_matrix(a, sharpness);
        }
        let n = a.nrows();
        let length: Vec<f64> = (0..n).map(|k| a[(k, k)].sqrt()).collect();
        if !length.iter().all(|x| *x > 0.0) {
            return None;
        }
        let unit = Mat::from_fn(n, n, |i, j| a[(i, j)] / (length[i] * length[j]));
        let Valued { value, slopes } = self.of_matrix(&unit, sharpness)?;
        // d unit_ij = d a_ij / (l_i l_j) - unit_ij (d a_ii / a_ii + d a_jj / a_jj) / 2
        let slopes = Mat::from_fn(n, n, |i, j| {
            let own = slopes[(i, j)] / (length[i] * length[j]);
            if i != j {
                return own;
            }
            let of_length: f64 = (0..n).map(|k| slopes[(i, k)] * unit[(i, k)]).sum();
            own - of_length / a[(i, i)]
        });
        Some(Valued { value, slopes })
    }

    fn of_matrix(&self, a: &Mat<f64>, Sharpness(p): Sharpness) -> Option<Valued> {
        let n = a.nrows() as f64;
        match self {
            Self::Separation(rivals) => rivals.evaluate(a),
            Self::Hadamard => {
                let diagonal: Vec<f64> = (0..a.nrows()).map(|k| a[(k, k)]).collect();
                let value = -diagonal.iter().map(|x| x.ln()).sum::<f64>() / n;
                let slopes = Mat::from_fn(a.nrows(), a.nrows(), |i, j| {
                    if i == j {
                        -1.0 / (n * diagonal[i])
                    } else {
                        0.0
                    }
                });
                value.is_finite().then_some(Valued { value, slopes })
            }
            Self::DOptimal => {
                // ln det A = ln det of the matrix with unit diagonal + sum ln A_jj: digits do not depend on units.
                let length: Vec<f64> = (0..a.nrows()).map(|k| a[(k, k)].sqrt()).collect();
                let scale = |i: usize, j: usize| length[i] * length[j];
                let unit = Mat::from_fn(a.nrows(), a.nrows(), |i, j| a[(i, j)] / scale(i, j));
                let Valued { value, slopes } = spectral(&unit, |lambda| {
                    let value = -lambda.iter().map(|x| x.ln()).sum::<f64>() / n;
                    (value, lambda.iter().map(|x| -1.0 / (n * x)).collect())
                })?;
                let lengths = 2.0 * length.iter().map(|x| x.ln()).sum::<f64>();
                let inverse = |i, j| slopes[(i, j)] / scale(i, j);
                Some(Valued {
                    value: value - lengths / n,
                    slopes: Mat::from_fn(a.nrows(), a.nrows(), inverse),
                })
            }
            Self::EOptimal => spectral(a, |lambda| {
                let (least, slopes) = soft_extreme(lambda, -p);
                (-0.5 * least, slopes.iter().map(|d| -0.5 * d).collect())
            }),
            Self::Condition => spectral(a, |lambda| {
                let (most, up) = soft_extreme(lambda, p);
                let (least, down) = soft_extreme(lambda, -p);
                let slopes = up.iter().zip(down).map(|(up, down)| 0.5 * (up - down));
                (0.5 * (most - least), slopes.collect())
            }),
        }
    }
}

/// `ln((sum lambda^p)^(1/p))` and its slopes: near the logarithm of the largest of `lambda`, with `p < 0` of the smallest.
fn soft_extreme(lambda: &[f64], p: f64) -> (f64, Vec<f64>) {
    let pick = if p > 0.0 { f64::max } else { f64::min };
    let extreme = lambda.iter().copied().reduce(pick).unwrap_or(1.0);
    let powers: Vec<f64> = lambda.iter().map(|x| (x / extreme).powf(p)).collect();
    let sum: f64 = powers.iter().sum();
    let slopes = powers
        .iter()
        .zip(lambda)
        .map(|(power, x)| power / (sum * x));
    (extreme.ln() + sum.ln() / p, slopes.collect())
}

/// A function of the eigenvalues: its slopes have the eigenvectors of the matrix.
fn spectral(a: &Mat<f64>, f: impl Fn(&[f64]) -> (f64, Vec<f64>)) -> Option<Valued> {
    let eigen = a.self_adjoint_eigen(Side::Lower).ok()?;
    let lambda: Vec<f64> = eigen.S().column_vector().iter().copied().collect();
    if !lambda.iter().all(|x| *x > 0.0) {
        return None;
    }
    let (value, by_lambda) = f(&lambda);
    let u = eigen.U();
    let scaled = Mat::from_fn(a.nrows(), a.nrows(), |i, j| u[(i, j)] * by_lambda[j]);
    Some(Valued {
        value,
        slopes: scaled * u.transpose(),
    })
}

impl Rivals {
    fn evaluate(&self, a: &Mat<f64>) -> Option<Valued> {
        let n = a.nrows();
        let (mut value, mut slopes) = (0.0, Mat::zeros(n, n));
        for own in [0, 1] {
            let v = self.unexplained(a, own)?;
            let image = a * &v;
            let distance: f64 = (0..n).map(|k| v[(k, 0)] * image[(k, 0)]).sum();
            if distance.is_nan() || distance <= 0.0 {
                return None;
            }
            value -= distance.ln();
            slopes -= faer::Scale(1.0 / distance) * (&v * v.transpose());
        }
        Some(Valued { value, slopes })
    }

    /// The squared distance of effect `own` from all that the model and its rival can do.
    pub(super) fn distance(&self, a: &Mat<f64>, own: usize) -> Option<f64> {
        let v = self.unexplained(a, own)?;
        Some((v.transpose() * (a * &v))[(0, 0)])
    }

    /// The squared length of effect `own`.
    pub(super) fn length(&self, a: &Mat<f64>, own: usize) -> f64 {
        let v = self.weights(a.nrows(), own);
        (v.transpose() * (a * &v))[(0, 0)]
    }

    /// Weights of the columns in effect `own`.
    fn weights(&self, columns: usize, own: usize) -> Mat<f64> {
        let mut v = Mat::zeros(columns, 1);
        for &(column, size) in &self.effects[own] {
            v[(column, 0)] = size;
        }
        v
    }

    /// Weights of the columns in what is left of effect `own`.
    fn unexplained(&self, a: &Mat<f64>, own: usize) -> Option<Mat<f64>> {
        let n = a.nrows();
        let mut v = self.weights(n, own);
        let is_own = |k: usize| self.effects[own].iter().any(|&(column, _)| column == k);
        let others: Vec<usize> = (0..n).filter(|&k| !is_own(k)).collect();
        let image = a * &v;
        // Units of parameters are far apart: scaled, so that the factor's pivots are not.
        let length: Vec<f64> = others.iter().map(|&k| a[(k, k)].sqrt()).collect();
        let count = others.len();
        let matrix = Mat::from_fn(count, count, |i, j| {
            a[(others[i], others[j])] / (length[i] * length[j])
        });
        let right = Mat::from_fn(count, 1, |i, _| image[(others[i], 0)] / length[i]);
        let solution = matrix.llt(Side::Lower).ok()?.solve(&right);
        for (k, &column) in others.iter().enumerate() {
            v[(column, 0)] = -solution[(k, 0)] / length[k];
        }
        Some(v)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn information() -> Mat<f64> {
        let rows = Mat::from_fn(9, 4, |i, j| {
            ((1.3 * i as f64 + 0.7) * (j as f64 + 1.0)).sin() * [0.5, 1.0, 3.0, 6.0][j]
        });
        rows.transpose() * &rows
    }

    #[test]
    fn slopes_are_those_of_the_values() {
        let rivals = Rivals {
            effects: [vec![(1, 0.5)], vec![(3, 2.0)]],
        };
        let criteria = [
            Criterion::DOptimal,
            Criterion::Condition,
            Criterion::EOptimal,
            Criterion::Hadamard,
            Criterion::Separation(rivals),
        ];
        let (a, sharpness) = (information(), Sharpness(4.0));
        for criterion in criteria {
            for scaling in [Scaling::Raw, Scaling::UnitLength] {
                let at = |a: &Mat<f64>| {
                    let valued = criterion.evaluate(a, scaling, sharpness);
                    valued.expect("no singular matrix")
                };
                let slopes = at(&a).slopes;
                for (i, j) in [(0, 0), (1, 1), (3, 3), (0, 2), (1, 3), (2, 1)] {
                    let size = (a[(i, i)] * a[(j, j)]).sqrt();
                    let h = 1e-6 * size;
                    let moved = |by: f64| {
                        let mut moved = a.clone();
                        moved[(i, j)] += by;
                        if i != j {
                            moved[(j, i)] += by;
                        }
                        at(&moved).value
                    };
                    let numeric = (moved(h) - moved(-h)) / (2.0 * h);
                    let exact = slopes[(i, j)] * if i == j { 1.0 } else { 2.0 };
                    assert!(
                        (numeric - exact).abs() < 1e-5 * (exact.abs() + 1.0 / size),
                        "{criterion:?} {scaling:?} {i} {j}: {numeric} {exact}"
                    );
                }
            }
        }
    }

    /// Seed 002's objective on columns of unit length is the same for every motion.
    #[test]
    fn hadamards_bound_of_unit_columns_is_constant() {
        let a = information();
        let valued = Criterion::Hadamard
            .evaluate(&a, Scaling::UnitLength, Sharpness(1.0))
            .expect("columns have a length");
        assert!(valued.value.abs() < 1e-12);
        assert!((0..4).all(|i| (0..4).all(|j| valued.slopes[(i, j)].abs() < 1e-12 / a[(i, i)])));
    }

    #[test]
    fn soft_extremes_come_near_as_they_sharpen() {
        let lambda = [1e-3, 0.5, 2.0, 40.0, 41.0];
        for p in [4.0, 16.0, 64.0] {
            let most = soft_extreme(&lambda, p).0.exp();
            let least = soft_extreme(&lambda, -p).0.exp();
            let room = 5f64.powf(1.0 / p) + 1e-12;
            assert!((1.0..room).contains(&(most / 41.0)), "{most}");
            assert!(
                (1.0 / room..1.0 + 1e-12).contains(&(least / 1e-3)),
                "{least}"
            );
        }
    }

    #[test]
    fn a_singular_matrix_has_no_value() {
        let rows = Mat::from_fn(9, 2, |i, _| i as f64);
        let a = rows.transpose() * &rows;
        assert!(
            Criterion::DOptimal
                .evaluate(&a, Scaling::Raw, Sharpness(4.0))
                .is_none_or(|v| v.value > 15.0)
        );
        let zero = Mat::zeros(2, 2);
        assert!(
            Criterion::Condition
                .evaluate(&zero, Scaling::UnitLength, Sharpness(4.0))
                .is_none()
        );
    }
}
