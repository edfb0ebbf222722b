//! Parameters that an arm can have, nearest to what the logs say.
//!
//! A body's mass is spread over space, so its pseudo-inertia `P = [[S, h], [h^T, m]]` with `S = tr(I)/2 1 - I` is positive
//! semidefinite, and conversely; friction and rotors take energy. The fit minimizes, over all standard parameters,
//! `|| W (tau - Y_b beta) ||^2 / 2 + w sum over links of (tr(P0^-1 P) - ln det P)`: the second part is the entropic distance
//! to the nominal body `P0`, and for small `w` decides only where the logs do not.
//!
//! Source: Wensing, Kim, Slotine 2018, Linear matrix inequalities for physically consistent inertial parameter
//! identification; Lee, Wensing, Park 2019, Geometric robot dynamic identification.

mod barrier;

use std::fmt;

use faer::{Mat, Side};

use super::IdentifyError;
use super::least_squares::{Factors, Solution};
use super::stack::Stack;
use crate::columns::Arm;
use crate::link::Inertial;

use barrier::{Barrier, Cone, Found};

/// Body of a link whose spec says none: 1 kg, spread by 0.1 m along each axis about the frame's origin.
const UNKNOWN_MASS: f64 = 1.0;
const UNKNOWN_SPREAD: f64 = 0.1;

/// What a friction, rotor or other parameter that is not negative is of the order of, where the logs are silent.
const UNKNOWN_EFFECT: f64 = 1.0;

/// Principal spreads of a nominal body below this share of the largest are this share: a rod has an inside too.
const THINNEST: f64 = 1e-3;

/// A body that is thinner than this share of its length lies on the border of what is possible.
const THIN: f64 = 1e-2;

/// The arms that can be, in standard parameters.
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
pub struct PossibleArms {
    /// Names of the standard parameters.
    pub names: Vec<String>,
    /// What the spec fixes, by standard parameter.
    pub fixed: Vec<Option<f64>>,
    /// Per unknown its combination `(standard parameter, coefficient)`.
    pub combinations: Vec<Vec<(usize, f64)>>,
    /// Per unknown a standard parameter that is in no other's combination, with coefficient 1.
    pub kept: Vec<usize>,
    /// Links whose body is not fixed.
    pub links: Vec<PossibleLink>,
    /// Parameters of effects that are not negative.
    pub nonnegative: Vec<usize>,
}

/// A link's body.
#[derive(Debug, Clone, PartialEq)]
pub struct PossibleLink {
    /// Name of the link.
    pub name: String,
    /// Places of `m mx my mz ixx ixy ixz iyy iyz izz` among the standard parameters.
    pub parameters: [usize; 10],
    /// Those of CAD, where the spec has them.
    pub nominal: Option<[f64; 10]>,
}

/// A possible arm, nearest to the logs.
#[derive(Debug, Clone, PartialEq)]
pub struct Possible {
    /// All standard parameters, name and value; of those that the logs do not tell, values near the nominal ones.
    pub standard: Vec<(String, f64)>,
    /// `100 || residual || / || tau ||` per joint without the constraint, to be compared with the estimate's.
    pub unconstrained_percent: Vec<f64>,
    /// Where the logs would have it beyond what is possible: links whose mass has shrunk to a plane, a line or a point, and
    /// parameters of effects that were negative.
    pub border: Vec<String>,
    /// Steps of Newton's method.
    pub steps: usize,
    /// By how much the weighted sum of squared residuals may exceed the least possible one, as a share of it.
    pub gap: f64,
}

/// What the search found.
pub(super) struct Nearest {
    /// One per unknown.
    pub estimate: Vec<f64>,
    pub standard: Vec<f64>,
    pub steps: usize,
    pub gap: f64,
}

/// The possible arm nearest to a solution takes its place; deviations stay those of the logs alone.
pub(super) fn make(
    arm: &dyn Arm,
    solution: &mut Solution,
    stack: &Stack,
) -> Result<Possible, IdentifyError> {
    let arms = arm.possible_arms().ok_or(IdentifyError::NoBodies)?;
    let unconstrained_percent = stack.relative_percent(&solution.estimate);
    let nearest = arms.nearest(&Factors::new(stack).stacked(&solution.sigma));
    let border = arms.border(&solution.estimate, &nearest.standard);
    solution.estimate = nearest.estimate;
    let standard = arms.names.into_iter().zip(nearest.standard);
    Ok(Possible {
        standard: standard.collect(),
        unconstrained_percent,
        border,
        steps: nearest.steps,
        gap: nearest.gap,
    })
}

impl PossibleArms {
    /// The possible arm nearest to values of the unknowns, each in units of its deviation: unknowns and standard parameters.
    ///
    /// # Examples
    /// A rotor cannot have an inertia below zero.
    /// ```
    /// use robot_model::identify::PossibleArms;
    /// let mut arms = PossibleArms::default();
    /// arms.names = vec!["joint.motor_inertia.ia".to_owned()];
    /// arms.fixed = vec![None];
    /// arms.combinations = vec![vec![(0, 1.0)]];
    /// arms.kept = vec![0];
    /// arms.nonnegative = vec![0];
    /// let (unknowns, standard) = arms.nearest_to(&[-0.2], &[1e-3]);
    /// assert!(unknowns[0] > 0.0 && unknowns[0] < 1e-6 && unknowns == standard);
    /// ```
    #[must_use]
    pub fn nearest_to(&self, values: &[f64], deviations: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let n = values.len();
        let factor = Mat::from_fn(n, n + 1, |row, column| {
            if column == n {
                values[row] / deviations[row]
            } else if row == column {
                1.0 / deviations[row]
            } else {
                0.0
            }
        });
        let nearest = self.nearest(&factor);
        (nearest.estimate, nearest.standard)
    }

    /// The possible arm nearest to a triangular factor `[R | r]` of the weighted rows.
    pub(super) fn nearest(&self, factor: &Mat<f64>) -> Nearest {
        let unknowns = self.kept.len();
        // Variables: the unknowns, then what the logs may be silent about.
        let silent: Vec<usize> = (0..self.names.len())
            .filter(|k| self.fixed[*k].is_none() && !self.kept.contains(k))
            .collect();
        let mut by_variable = Mat::zeros(self.names.len(), unknowns + silent.len());
        for (unknown, &kept) in self.kept.iter().enumerate() {
            by_variable[(kept, unknown)] = 1.0;
            for &(other, coefficient) in &self.combinations[unknown] {
                if let Ok(place) = silent.binary_search(&other) {
                    by_variable[(kept, unknowns + place)] = -coefficient;
                }
            }
        }
        for (place, &standard) in silent.iter().enumerate() {
            by_variable[(standard, unknowns + place)] = 1.0;
        }
        let cones = self.cones();
        let mut start: Vec<f64> = vec![0.0; self.names.len()];
        for cone in &cones {
            cone.start(&mut start);
        }
        let mut first: Vec<f64> = self
            .combinations
            .iter()
            .map(|combination| combination.iter().map(|&(k, c)| c * start[k]).sum())
            .collect();
        first.extend(silent.iter().map(|&k| start[k]));
        let barrier = Barrier {
            factor,
            unknowns,
            by_variable: &by_variable,
            cones: &cones,
            loose: self
                .kept
                .iter()
                .chain(&silent)
                .enumerate()
                .filter(|(_, standard)| !cones.iter().any(|cone| cone.holds(**standard)))
                .map(|(variable, _)| variable)
                .collect(),
        };
        let Found {
            variables,
            steps,
            gap,
        } = barrier.minimize(first);
        let mut standard = barrier.standard(&variables);
        for (value, fixed) in standard.iter_mut().zip(&self.fixed) {
            *value = fixed.unwrap_or(*value);
        }
        Nearest {
            estimate: variables[..unknowns].to_vec(),
            standard,
            steps,
            gap,
        }
    }

    /// What an unconstrained estimate, one per unknown, and the possible arm beside it have at the border.
    fn border(&self, unconstrained: &[f64], standard: &[f64]) -> Vec<String> {
        let is_thin = |link: &&PossibleLink| {
            let ten = link.parameters.map(|k| standard[k]);
            let moments = Inertial::from(ten).second_moments();
            let values = moments.map(|moments| moments.symmetric_eigenvalues());
            values.is_none_or(|values| values.min() < THIN * THIN * values.max())
        };
        let links = self.links.iter().filter(is_thin);
        let links = links.map(|link| format!("link `{}`", link.name));
        let effects = self.kept.iter().zip(unconstrained);
        let effects = effects.filter(|(k, value)| **value < 0.0 && self.nonnegative.contains(k));
        let effects = effects.map(|(&k, _)| format!("`{}`", self.names[k]));
        links.chain(effects).collect()
    }

    fn cones(&self) -> Vec<Cone> {
        let links = self.links.iter().map(|link| {
            let nominal = match link.nominal {
                Some(nominal) => thick(&pseudo_inertia(&nominal)),
                None => unknown_body(),
            };
            let terms = link.parameters.iter().enumerate().map(|(k, &parameter)| {
                let mut unit = [0.0; 10];
                unit[k] = 1.0;
                (parameter, pseudo_inertia(&unit))
            });
            Cone::new(terms.collect(), nominal)
        });
        let free = self.nonnegative.iter();
        let free = free.filter(|&&k| self.fixed[k].is_none());
        let effects = free.map(|&k| {
            let one = Mat::from_fn(1, 1, |_, _| 1.0);
            let nominal = Mat::from_fn(1, 1, |_, _| UNKNOWN_EFFECT);
            Cone::new(vec![(k, one)], nominal)
        });
        links.chain(effects).collect()
    }
}

fn pseudo_inertia(ten: &[f64; 10]) -> Mat<f64> {
    let matrix = Inertial::from(*ten).pseudo_inertia();
    Mat::from_fn(4, 4, |i, j| matrix[(i, j)])
}

fn unknown_body() -> Mat<f64> {
    let diagonal = [
        UNKNOWN_SPREAD * UNKNOWN_SPREAD,
        UNKNOWN_SPREAD * UNKNOWN_SPREAD,
        UNKNOWN_SPREAD * UNKNOWN_SPREAD,
        1.0,
    ];
    Mat::from_fn(4, 4, |i, j| {
        if i == j {
            UNKNOWN_MASS * diagonal[i]
        } else {
            0.0
        }
    })
}

/// The nearest body that has an inside: CAD values may be those of a rod, of a point, or of nothing.
fn thick(nominal: &Mat<f64>) -> Mat<f64> {
    let unknown = unknown_body();
    let Ok(eigen) = nominal.self_adjoint_eigen(Side::Lower) else {
        return unknown;
    };
    let values: Vec<f64> = eigen.S().column_vector().iter().copied().collect();
    let largest = values.iter().copied().fold(0.0, f64::max);
    if !(largest > 0.0 && largest.is_finite()) {
        return unknown;
    }
    let u = eigen.U();
    let scaled = Mat::from_fn(4, 4, |i, j| u[(i, j)] * values[j].max(THINNEST * largest));
    scaled * u.transpose()
}

impl fmt::Display for Possible {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "possible: every link has a body, found in {} steps to {:.0e} of the squared residual",
            self.steps, self.gap
        )?;
        if !self.border.is_empty() {
            writeln!(
                f,
                "on the border of what is possible: {}",
                self.border.join(", ")
            )?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;
