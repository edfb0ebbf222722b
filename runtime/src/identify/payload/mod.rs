//! What an arm carries: the difference of logs with and without it.
//!
//! A payload is a body on a link, so with it the base parameters are `beta + K pi`, where `K` has the combinations of that link's ten
//! parameters. All logs are fitted at once, `tau = Y_b beta` without and `tau = Y_b (beta + K pi)` with it: friction and the arm itself
//! are the same in both, and what they have in common tells nothing of the payload and harms nothing.
//!
//! Source: Khalil, Gautier, Lemoine 2007, Identification of the payload inertial parameters of industrial manipulators, method of two
//! trajectories.

use super::stack::Stack;
use super::{
    Estimate, Fitted, Form, Identified, Identify, IdentifyError, RIGID_TORQUE_PASSES, check_logs,
    load_motion, prepare_all, slowest_bands, update_load,
};
use crate::columns::{Arm, Entry, Unknown};
use crate::log::Log;
use crate::signal::Bands;

/// An arm and what it carries.
#[derive(Debug, Clone, PartialEq)]
pub struct Carried {
    /// The link that carries it.
    pub link: String,
    /// The arm's parameters and behind them the payload's, `LINK.payload.m` and so on, about the origin of the link's frame.
    pub estimate: Estimate,
    /// The arm with its payload, for errors on logs with it.
    pub loaded: Estimate,
}

impl Carried {
    /// The payload's parameters, as the estimate has them. Those that no torque depends on are not among them.
    #[must_use]
    pub fn payload(&self) -> &[Identified] {
        &self.estimate.parameters[self.loaded.parameters.len()..]
    }

    /// Its mass, kg, with the standard deviation, and its center of mass in the link's frame, m, each as far as the logs tell; no center where
    /// the mass is not two deviations above zero.
    #[must_use]
    pub fn mass_and_center(&self) -> (Option<[f64; 2]>, [Option<f64>; 3]) {
        let told = |own: &str| {
            let name = format!("{}.payload.{own}", self.link);
            let found = self.payload().iter().find(|p| p.name == name)?;
            let is_told = self.estimate.is_separated(&name);
            is_told.then_some([found.value, found.std])
        };
        let mass = told("m");
        let body = mass.filter(|[mass, std]| *mass > 2.0 * std);
        let center = ["mx", "my", "mz"].map(|own| Some(told(own)?[0] / body?[0]));
        (mass, center)
    }
}

/// What a payload's parameters add to the unknowns: per unknown its coefficients.
struct Shares {
    link: String,
    unknowns: Vec<Unknown>,
    coefficients: Vec<Vec<f64>>,
}

impl Shares {
    fn of(arm: &dyn Arm, link: Option<&str>) -> Result<Self, IdentifyError> {
        let arms = arm.possible_arms().ok_or(IdentifyError::NoBodies)?;
        // Bodies of effects have names with a dot.
        let links = arms.links.iter().filter(|link| !link.name.contains('.'));
        let links: Vec<_> = links.collect();
        let mut last = arms
            .names
            .iter()
            .filter_map(|name| name.strip_suffix(".izz"));
        let last = last.rfind(|name| !name.contains('.'));
        let wanted = link.or(last).unwrap_or_default();
        let Some(found) = links.iter().find(|link| link.name == wanted) else {
            if arms
                .names
                .iter()
                .any(|name| *name == format!("{wanted}.izz"))
            {
                return Err(IdentifyError::FixedLink {
                    link: wanted.to_owned(),
                });
            }
            return Err(IdentifyError::NoLink {
                links: links.iter().map(|link| link.name.clone()).collect(),
            });
        };
        let factor = |terms: &[(usize, f64)], place: usize| -> f64 {
            let own = terms.iter().filter(|(standard, _)| *standard == place);
            own.map(|(_, factor)| factor).sum()
        };
        // Of those that any torque depends on.
        let places = found.parameters.iter().copied();
        let places = places.filter(|&place| {
            let all = arms.combinations.iter();
            all.into_iter().any(|terms| factor(terms, place) != 0.0)
        });
        let places: Vec<usize> = places.collect();
        let unknown = |&place: &usize| {
            let name = &arms.names[place];
            let own = name.rsplit('.').next().unwrap_or(name);
            Unknown {
                name: format!("{}.payload.{own}", found.name),
                nonnegative: own == "m",
            }
        };
        let coefficients = arms.combinations.iter().map(|terms| {
            let places = places.iter();
            places.map(|&place| factor(terms, place)).collect()
        });
        Ok(Self {
            link: found.name.clone(),
            unknowns: places.iter().map(unknown).collect(),
            coefficients: coefficients.collect(),
        })
    }

    /// The unknowns with the payload in them.
    fn loaded(&self, values: &[f64]) -> Vec<f64> {
        let (arm, payload) = values.split_at(self.coefficients.len());
        let pairs = arm.iter().zip(&self.coefficients);
        pairs
            .map(|(value, factors)| {
                let terms = factors.iter().zip(payload);
                value + terms.map(|(factor, own)| factor * own).sum::<f64>()
            })
            .collect()
    }

    /// Columns of the payload, which is there from row `start` on.
    fn columns(&self, stack: &Stack, start: usize) -> Vec<Entry> {
        let mut entries = Vec::new();
        for (joint, rows) in stack.joints.iter().enumerate() {
            for column in 0..self.unknowns.len() {
                let mut values = vec![0.0; rows.target.len()];
                for (unknown, own) in &rows.columns {
                    let factor = self.coefficients[*unknown][column];
                    if factor != 0.0 {
                        let pairs = values[start..].iter_mut().zip(&own[start..]);
                        pairs.for_each(|(sum, value)| *sum += factor * value);
                    }
                }
                entries.push(Entry {
                    joint,
                    column,
                    values,
                });
            }
        }
        entries
    }
}

impl Identify {
    /// Identifies an arm from logs without its payload, and the payload from logs with it; `link` carries it, without a name the last one.
    /// Open shapes are those of the logs without it.
    ///
    /// # Errors
    /// Those of [`Self::fit`]; [`IdentifyError::NoLink`], [`IdentifyError::FixedLink`], [`IdentifyError::NoBodies`].
    pub fn fit_payload(
        &self,
        arm: &dyn Arm,
        unloaded: &[Log],
        loaded: &[Log],
        link: Option<&str>,
    ) -> Result<Carried, IdentifyError> {
        check_logs(arm, unloaded)?;
        check_logs(arm, loaded)?;
        let shares = Shares::of(arm, link)?;
        let bands = self.bands.map_or_else(
            || {
                let without = self.choose_bands(arm, unloaded)?;
                let with = slowest_bands(loaded);
                Ok::<_, IdentifyError>(Bands {
                    smooth_hz: without.smooth_hz.min(with.smooth_hz),
                    wide_hz: without.wide_hz.min(with.wide_hz),
                    shared_hz: without.shared_hz.min(with.shared_hz),
                })
            },
            Ok,
        )?;
        let both = Self {
            bands: Some(bands),
            ..self.clone()
        };
        let alone = both.fit(arm, unloaded)?;
        let shapes: Vec<f64> = alone.shapes.iter().map(|(_, value)| *value).collect();
        let n = shares.coefficients.len();
        let mut values = alone.values();
        values.resize(n + shares.unknowns.len(), 0.0);
        let mut without = prepare_all(unloaded, &bands)?;
        let mut with = prepare_all(loaded, &bands)?;
        let passes = if arm.uses_rigid_torque() {
            RIGID_TORQUE_PASSES
        } else {
            1
        };
        let mut last = None;
        for _ in 0..passes {
            if arm.uses_rigid_torque() {
                update_load(arm, &mut without, &shapes, &values[..n]);
                let loaded = shares.loaded(&values);
                for log in &mut with {
                    load_motion(arm, &mut log.motion, &shapes, &loaded);
                }
            }
            let all = [without.clone(), with.clone()].concat();
            let mut stack = Stack::new(arm, &all, &shapes);
            let start = stack.segments[without.len()].start;
            let columns = shares.columns(&stack, start);
            stack.append(&shares.unknowns, &columns);
            let solution = self.solve_stack(&stack)?;
            values.clone_from(&solution.estimate);
            last = Some((stack, solution));
        }
        let (stack, mut solution) = last.ok_or(IdentifyError::NoLog)?;
        solution.std = self.deviations(&stack, &solution);
        let fitted = Fitted::new(&stack, &solution.estimate);
        let mut estimate = Estimate::new(
            arm,
            self.method,
            Form::Acceleration,
            bands,
            &solution,
            shapes,
            fitted,
        );
        estimate.shape_std.clone_from(&alone.shape_std);
        let mut loaded = alone;
        for (parameter, value) in loaded.parameters.iter_mut().zip(shares.loaded(&values)) {
            parameter.value = value;
        }
        Ok(Carried {
            link: shares.link,
            estimate,
            loaded,
        })
    }
}
