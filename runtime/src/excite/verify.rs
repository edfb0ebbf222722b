//! What a motion is worth, and whether it keeps the limits between the instants that it was designed on.

use faer::{Mat, Side};

use super::check::size;
use super::criterion::{Criterion, Rivals};
use super::fourier::{Fourier, instants};
use super::problem::Problem;
use super::slack::{each_slack, lesser};
use super::{ExciteError, Request};

/// Instants of the grid on which limits are verified, per instant of the design's.
const FINER: usize = 10;

/// What is reserved beyond what a limit was missed by.
const RESERVE: f64 = 1e-3;

/// All criteria at a motion, over one period.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Quality {
    /// Condition number of the counted columns in SI units, each joint's rows over its noise.
    pub condition: f64,
    /// The same with columns of unit length.
    pub condition_of_unit_columns: f64,
    /// `ln det` of the mean information matrix `Y^T W^2 Y` of a sample.
    pub log_det: f64,
    /// Square root of its smallest eigenvalue.
    pub least_singular: f64,
    /// `sum ln` of its diagonal: Hadamard's bound of `log_det`.
    pub hadamard: f64,
    /// Squared T-optimal distances of two effects, each from what the model and its rival can do; only of a design that separates.
    pub distances: Option<[f64; 2]>,
    /// The same as shares of the effects' own squared lengths; tiny where one is imitated.
    pub shares: Option<[f64; 2]>,
    /// By how much the worst limit is exceeded on a grid ten times as fine as the design's, as a share of it, of a room in m; 0 if none
    /// is.
    pub violation: f64,
    /// Which one, where one is.
    pub violated: Option<String>,
}

impl Request {
    /// All criteria at a motion, which may be any.
    ///
    /// # Errors
    /// Columns that it does not excite, a motion of another arm, and what [`Self::run`] refuses.
    ///
    /// # Examples
    /// A rotor with a spring, `tau = ia ddq + k q`: along one wave `ddq = -w^2 q`, and nothing tells one from the other.
    /// ```
    /// # mod rotor { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/rotor.rs")); }
    /// use robot_model::excite::Fourier;
    /// let request = rotor::request();
    /// let wave = |a_3: f64| Fourier { period: 4.0, coefficients: vec![vec![0.0, 0.6, 0.0, a_3, 0.0, 0.0, 0.0]] };
    /// assert!(request.quality(&wave(0.0))?.condition_of_unit_columns > 1e6);
    /// let quality = request.quality(&wave(0.6))?;
    /// assert!(quality.condition_of_unit_columns < 10.0 && quality.violation == 0.0);
    /// # Ok::<(), robot_model::excite::ExciteError>(())
    /// ```
    pub fn quality(&self, motion: &Fourier) -> Result<Quality, ExciteError> {
        self.check()?;
        size(
            "joints of the motion",
            motion.coefficients.len(),
            self.joints.len(),
        )?;
        let fine = motion.motion(&instants(motion.period, FINER * self.samples()));
        let values = self.regressor.exact.values(&fine);
        let n = self.regressor.columns.len();
        let samples = values.first().map_or(0, Vec::len);
        let mut a = Mat::<f64>::zeros(n, n);
        for joint in 0..self.joints.len() {
            let mut rows = Mat::zeros(samples, n);
            for (&(of, column), values) in self.regressor.entries.iter().zip(&values) {
                if of == joint {
                    for (s, value) in values.iter().enumerate() {
                        rows[(s, column)] = value / self.noise[joint];
                    }
                }
            }
            a += rows.transpose() * &rows * faer::Scale(1.0 / samples as f64);
        }
        let names = match &self.basis {
            None => &self.regressor.columns,
            Some(basis) => {
                a = basis.information(&a);
                &basis.names
            }
        };
        let length: Vec<f64> = (0..n).map(|k| a[(k, k)].sqrt()).collect();
        let largest = length.iter().copied().fold(0.0, f64::max);
        let silent: Vec<&str> = (0..n)
            .filter(|&k| length[k].is_nan() || length[k] <= 1e-12 * largest)
            .map(|k| names[k].as_str())
            .collect();
        if !silent.is_empty() {
            return Err(ExciteError::NotExcited(format!(
                "`{}`",
                silent.join("`, `")
            )));
        }
        let unit = Mat::from_fn(n, n, |i, j| a[(i, j)] / (length[i] * length[j]));
        let (raw, unit) = (eigenvalues(&a), eigenvalues(&unit));
        let condition = |lambda: &[f64]| match (lambda.first(), lambda.last()) {
            (Some(least), Some(most)) if *least > 0.0 => (most / least).sqrt(),
            _ => f64::INFINITY,
        };
        let hadamard = 2.0 * length.iter().map(|x| x.ln()).sum::<f64>();
        let distances = match &self.criterion {
            Criterion::Separation(rivals) => distances(rivals, &a),
            _ => None,
        };
        let shares = match &self.criterion {
            Criterion::Separation(rivals) => distances.map(|distances| {
                std::array::from_fn(|own| distances[own] / rivals.length(&a, own))
            }),
            _ => None,
        };
        let (violation, violated) = self.violation(&fine);
        Ok(Quality {
            condition: condition(&raw),
            condition_of_unit_columns: condition(&unit),
            log_det: hadamard + unit.iter().map(|x| x.ln()).sum::<f64>(),
            least_singular: raw.first().map_or(0.0, |x| x.max(0.0).sqrt()),
            hadamard,
            distances,
            shares,
            violation,
            violated,
        })
    }

    /// The worst limit at a motion: by how much, and which one.
    fn violation(&self, motion: &crate::motion::Kinematics) -> (f64, Option<String>) {
        let (mut worst, mut which) = (0.0_f64, None);
        let mut tell = |excess: f64, name: &dyn Fn() -> String| {
            let excess = if excess.is_nan() {
                f64::INFINITY
            } else {
                excess
            };
            // Rounding of sums of waves is no motion.
            if excess > worst.max(1e-12) {
                (worst, which) = (excess, Some(name()));
            }
        };
        for (joint, name) in self.joints.iter().enumerate() {
            let (middle, half) = self.limits.range(joint);
            let signals = [
                ("position", &motion.q[joint], middle, half),
                (
                    "velocity",
                    &motion.dq[joint],
                    0.0,
                    self.limits.velocity[joint],
                ),
                (
                    "acceleration",
                    &motion.ddq[joint],
                    0.0,
                    self.limits.acceleration[joint],
                ),
            ];
            for (what, values, middle, limit) in signals {
                for x in values {
                    tell((x - middle).abs() / limit - 1.0, &|| {
                        format!("{what} of `{name}`")
                    });
                }
            }
        }
        for clearance in &self.clearances {
            each_slack(&**clearance, clearance.exact(), motion, &mut |k, slack| {
                tell(-slack, &|| clearance.name(k));
            });
        }
        (worst, which)
    }

    /// Reserves with which the fine grid would keep the clearances; `None` where it does.
    pub(super) fn missing(&self, problem: &Problem<'_>, z: &[f64]) -> Option<Vec<f64>> {
        let motion = problem.fourier(z);
        let fine = motion.motion(&instants(self.period, FINER * self.samples()));
        let mut is_missed = false;
        let reserves = self.clearances.iter().zip(&problem.reserve);
        let reserves = reserves
            .map(|(clearance, reserve)| {
                let mut least = f64::INFINITY;
                each_slack(&**clearance, clearance.exact(), &fine, &mut |_, slack| {
                    least = lesser(least, slack);
                });
                is_missed |= least < 0.0;
                if least < 0.0 {
                    reserve - least + RESERVE
                } else {
                    *reserve
                }
            })
            .collect();
        is_missed.then_some(reserves)
    }
}

/// Ascending.
fn eigenvalues(a: &Mat<f64>) -> Vec<f64> {
    let found = a.self_adjoint_eigenvalues(Side::Lower);
    found.unwrap_or_default()
}

fn distances(rivals: &Rivals, a: &Mat<f64>) -> Option<[f64; 2]> {
    Some([rivals.distance(a, 0)?, rivals.distance(a, 1)?])
}
