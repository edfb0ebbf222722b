//! Parameters that an arm can have, nearest to what the logs say.
//!
//! A body's mass is spread over space, so its pseudo-inertia `P = [[S, h], [h^T, m]]` with `S = tr(I)/2 1 - I` is positive
//! semidefinite, and conversely; friction and rotors take energy. The fit minimizes, over all standard parameters,
//! `|| W (tau - Y_b beta) ||^2 / 2 + w sum over links of (tr(P0^-1 P) - ln det P)`: the second part is the entropic distance
//! to the nominal body `P0`, and for small `w` decides only where the logs do not. A body of CAD has the weight of a guess that may be
//! off by its own size, one that stands for what nobody said a thousandth of that.
//!
//! Source: Wensing, Kim, Slotine 2018, Linear matrix inequalities for physically consistent inertial parameter
//! identification; Lee, Wensing, Park 2019, Geometric robot dynamic identification.

mod barrier;
mod bodies;
mod origin;

use std::fmt;

use faer::Mat;

use super::IdentifyError;
use super::least_squares::{Factors, Solution};
use super::stack::Stack;
use crate::columns::Arm;
use crate::link::Inertial;

use barrier::{Barrier, Cone, Found, LAST_WEIGHT};
use bodies::{pseudo_inertia, thick, unknown_body};
pub use origin::Origin;

/// Powers of ten of a mass, kg, that links have whose spec says no body; that is taken with which the logs agree best.
const UNKNOWN_MASSES: std::ops::RangeInclusive<i32> = -6..=6;

/// What a friction, rotor or other parameter that is not negative is of the order of, where the logs are silent.
const UNKNOWN_EFFECT: f64 = 1.0;

/// Weight of the pull to bodies of CAD, in units of half a squared residual over its variance: one that is off by its
/// own size costs as much as one deviation. With less, logs that tell little bend bodies to where noise is.
const CAD_WEIGHT: f64 = 1.0;

/// CAD contradicts the logs where it moves a parameter by more than so many deviations.
const FAR: f64 = 3.0;

/// A body that is thinner than this share of its length lies on the border of what is possible.
const THIN: f64 = 1e-2;

/// The arms that can be, in standard parameters.
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
pub struct PossibleArms {
    /// Names of the standard parameters.
    pub names: Vec<String>,
    /// What is fixed, by standard parameter: unknowns are sums of the others.
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
#[non_exhaustive]
pub struct PossibleLink {
    /// Name of the link.
    pub name: String,
    /// Places of `m mx my mz ixx ixy ixz iyy iyz izz` among the standard parameters.
    pub parameters: [usize; 10],
    /// Those of CAD, where the spec has them.
    pub nominal: Option<[f64; 10]>,
}

impl PossibleLink {
    /// A body whose ten parameters are at these places, with those of CAD.
    ///
    /// # Examples
    /// ```
    /// use robot_model::identify::PossibleLink;
    /// // The second link's parameters stand behind those of the first.
    /// let link = PossibleLink::new("forearm", std::array::from_fn(|k| 10 + k), None);
    /// assert_eq!((link.name.as_str(), link.parameters[9]), ("forearm", 19));
    /// ```
    #[must_use]
    pub fn new(
        name: impl Into<String>,
        parameters: [usize; 10],
        nominal: Option<[f64; 10]>,
    ) -> Self {
        Self {
            name: name.into(),
            parameters,
            nominal,
        }
    }

    /// The pseudo-inertia of CAD, made one of a body with an inside; `None` where the spec says none, or that of a point or of nothing.
    fn body(&self) -> Option<Mat<f64>> {
        let nominal = self.nominal?;
        thick(&Inertial::from(nominal))
    }
}

/// A possible arm, nearest to the logs.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Possible {
    /// All standard parameters, name and value; of those that the logs do not tell, values near the nominal ones.
    pub standard: Vec<(String, f64)>,
    /// Where each of these values is from.
    pub origins: Vec<Origin>,
    /// `100 || residual || / || tau ||` per joint without the constraint, to be compared with the estimate's.
    pub unconstrained_percent: Vec<f64>,
    /// Where the logs would have it beyond what is possible: links whose mass has shrunk to a plane, a line or a point, and
    /// parameters of effects that were negative.
    pub border: Vec<String>,
    /// Steps of Newton's method.
    pub steps: usize,
    /// By how much the weighted sum of squared residuals exceeds the least one of a possible arm, as a share of it: what the pull to CAD costs,
    /// and what the barriers that are left cost at most, about.
    pub gap: f64,
    /// Parameters that CAD moves by more than three deviations away from where the logs alone would have them.
    pub pulled: Vec<String>,
}

/// What the logs tell of the unknowns.
struct Told<'a> {
    values: &'a [f64],
    deviations: &'a [f64],
}

/// What the search found.
struct Nearest {
    /// One per unknown.
    estimate: Vec<f64>,
    standard: Vec<f64>,
    steps: usize,
    /// Half the sum of squares.
    cost: f64,
    gap: f64,
}

/// That of the rows of a stack, see [`of_factors`].
pub(super) fn make(
    arm: &dyn Arm,
    solution: &mut Solution,
    stack: &Stack,
) -> Result<Possible, IdentifyError> {
    let percent = stack.relative_percent(&solution.estimate);
    let worth = solution.worth(stack);
    of_factors(arm, solution, &Factors::new(stack), &worth, percent)
}

/// The possible arm nearest to a solution takes its place; deviations stay those of the logs alone, and what the logs tell only in sums
/// stays in them.
///
/// Rows of each joint are divided by what one independent sample of it is `worth`, so that the weight of CAD is that beside deviations.
pub(super) fn of_factors(
    arm: &dyn Arm,
    solution: &mut Solution,
    factors: &Factors,
    worth: &[f64],
    unconstrained_percent: Vec<f64>,
) -> Result<Possible, IdentifyError> {
    let arms = arm.possible_arms().ok_or(IdentifyError::NoBodies)?;
    let factor = factors.stacked(worth);
    let told = Told {
        values: &solution.estimate,
        deviations: &solution.std,
    };
    let nearest = arms.nearest(&factor, &told, CAD_WEIGHT);
    let nearest = nearest.ok_or(IdentifyError::NoEnd)?;
    // Where all barriers fade the search may come to no end, and nothing is known of what CAD costs.
    let has_cad = arms.links.iter().any(|link| link.body().is_some());
    let freest = has_cad
        .then(|| arms.nearest(&factor, &told, LAST_WEIGHT))
        .flatten();
    let freest = freest.as_ref().unwrap_or(&nearest);
    let pairs = nearest.estimate.iter().zip(&freest.estimate).enumerate();
    let pulled = pairs.filter(|(k, (near, free))| {
        solution.is_told(*k) && (*near - *free).abs() > FAR * solution.std[*k]
    });
    let pulled = pulled
        .map(|(k, _)| arm.unknowns()[k].name.clone())
        .collect();
    let gap = (nearest.cost / freest.cost.max(f64::MIN_POSITIVE) - 1.0).max(0.0) + freest.gap;
    let border = arms.border(&solution.estimate, &nearest.standard);
    solution.estimate = nearest.estimate;
    let origins = arms.origins(solution);
    let standard = arms.names.into_iter().zip(nearest.standard);
    Ok(Possible {
        standard: standard.collect(),
        origins,
        unconstrained_percent,
        border,
        steps: nearest.steps,
        gap,
        pulled,
    })
}

impl PossibleArms {
    /// The possible arm nearest to values of the unknowns, each in units of its deviation: unknowns and standard parameters.
    /// `None` where the search does not come to an end.
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
    /// let (unknowns, standard) = arms.nearest_to(&[-0.2], &[1e-3]).expect("one unknown");
    /// assert!(unknowns[0] > 0.0 && unknowns[0] < 1e-6 && unknowns == standard);
    /// ```
    #[must_use]
    pub fn nearest_to(&self, values: &[f64], deviations: &[f64]) -> Option<(Vec<f64>, Vec<f64>)> {
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
        let nearest = self.nearest(&factor, &Told { values, deviations }, LAST_WEIGHT)?;
        Some((nearest.estimate, nearest.standard))
    }

    /// The possible arm nearest to a triangular factor `[R | r]` of the weighted rows, with the weight of bodies of CAD.
    fn nearest(&self, factor: &Mat<f64>, told: &Told<'_>, of_cad: f64) -> Option<Nearest> {
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
        let cones = self.cones(factor, told, of_cad);
        let start = self.start(&cones);
        let mut first = self.unknowns_of(&start);
        first.extend(silent.iter().map(|&k| start[k]));
        let is_held = |variable: usize, standard: usize| {
            let is_told = variable < unknowns && factor.col(variable).iter().any(|x| *x != 0.0);
            is_told || cones.iter().any(|cone| cone.holds(standard))
        };
        let loose = self.kept.iter().chain(&silent).enumerate();
        let loose = loose.filter(|&(variable, &standard)| !is_held(variable, standard));
        let fixed: Vec<f64> = self.fixed.iter().map(|x| x.unwrap_or(0.0)).collect();
        let barrier = Barrier {
            factor,
            unknowns,
            by_variable: &by_variable,
            fixed: &fixed,
            cones: &cones,
            loose: loose.map(|(variable, _)| variable).collect(),
        };
        let Found {
            variables,
            steps,
            cost,
            gap,
        } = barrier.minimize(first)?;
        let standard = barrier.standard(&variables);
        Some(Nearest {
            estimate: variables[..unknowns].to_vec(),
            standard,
            steps,
            cost,
            gap,
        })
    }

    /// Standard parameters at which every matrix is its nominal one.
    fn start(&self, cones: &[Cone]) -> Vec<f64> {
        let mut start: Vec<f64> = vec![0.0; self.names.len()];
        for cone in cones {
            cone.start(&mut start);
        }
        start
    }

    /// Combinations of standard parameters that are not fixed.
    fn unknowns_of(&self, standard: &[f64]) -> Vec<f64> {
        let sum = |combination: &Vec<(usize, f64)>| -> f64 {
            let free = combination.iter().filter(|(k, _)| self.fixed[*k].is_none());
            free.map(|&(k, c)| c * standard[k]).sum()
        };
        self.combinations.iter().map(sum).collect()
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

    /// Bodies and effects, with nominal ones that are of the order of what the logs tell.
    fn cones(&self, factor: &Mat<f64>, told: &Told<'_>, of_cad: f64) -> Vec<Cone> {
        let n = self.kept.len();
        let missed = |mass: &f64| -> f64 {
            let unknowns = self.unknowns_of(&self.start(&self.cones_of(*mass, told, of_cad)));
            let rows = 0..factor.nrows();
            rows.map(|row| {
                let fitted: f64 = (0..n).map(|k| factor[(row, k)] * unknowns[k]).sum();
                (fitted - factor[(row, n)]).powi(2)
            })
            .sum()
        };
        let best = if self.links.iter().all(|link| link.body().is_some()) {
            None
        } else {
            let masses = UNKNOWN_MASSES.map(|power| 10f64.powi(power));
            masses.min_by(|x, y| missed(x).total_cmp(&missed(y)))
        };
        self.cones_of(best.unwrap_or(1.0), told, of_cad)
    }

    fn cones_of(&self, mass: f64, told: &Told<'_>, of_cad: f64) -> Vec<Cone> {
        let unknown = unknown_body(mass);
        let links = self.links.iter().map(|link| {
            let (nominal, least) = match link.body() {
                Some(body) => (body, of_cad),
                None => (unknown.clone(), LAST_WEIGHT),
            };
            let terms = link.parameters.iter().enumerate().map(|(k, &parameter)| {
                let mut unit = [0.0; 10];
                unit[k] = 1.0;
                (parameter, pseudo_inertia(&Inertial::from(unit)))
            });
            Cone::new(terms.collect(), nominal, least)
        });
        let free = self.nonnegative.iter();
        let free = free.filter(|&&k| self.fixed[k].is_none());
        let effects = free.map(|&k| {
            let one = Mat::from_fn(1, 1, |_, _| 1.0);
            let place = self.kept.iter().position(|&kept| kept == k);
            let size = place.map(|place| told.values[place].max(told.deviations[place]));
            let size = size.filter(|size| *size > 0.0).unwrap_or(UNKNOWN_EFFECT);
            Cone::new(vec![(k, one)], Mat::from_fn(1, 1, |_, _| size), LAST_WEIGHT)
        });
        links.chain(effects).collect()
    }
}

impl fmt::Display for Possible {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "possible: every link has a body, found by Newton's method with log-determinant barriers in {} steps, to {:.0e} of the squared \
             residual",
            self.steps, self.gap
        )?;
        if !self.border.is_empty() {
            writeln!(
                f,
                "on the boundary of physical possibility: {}; standard deviations are without the constraint, so they do not apply to these",
                self.border.join(", ")
            )?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;
