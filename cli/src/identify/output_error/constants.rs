//! What logs say of the constants of a spec that says its energies: they show in sums of products, which are what logs tell.

use std::fmt::{self, Display, Formatter};

use nalgebra::DVector;
use robot_model::identify::output_error::{Direction, OutputEstimate};
use robot_model::identify::table_value;
use robot_model::simulate::Functions as _;
use robot_model_codegen::Compiled;
use robot_model_spec::parameter::Owner;
use serde::Serialize;

use super::directions::{DirectionReport, direction};
use super::listed;
use crate::interpreted::Constants;

/// Steps in which constants are looked for that make what was found, the share by which one changes at most in a step, and how near sums have
/// to come, as shares of themselves.
const STEPS: usize = 200;
const STRIDE: f64 = 0.5;
const NEAR: f64 = 1e-9;

/// What is told of constants.
pub(super) struct Told {
    /// Names of all constants of the energies, which are more than sums.
    own: Vec<String>,
    sums: usize,
    /// None where no constants near those of the spec make the sums that were found.
    values: Option<Values>,
}

struct Values {
    rank: usize,
    /// Unknowns with the constants in the place of sums.
    unknowns: usize,
    /// Of the energies, with values where logs tell one.
    constants: Vec<(String, Option<f64>)>,
    directions: Vec<Direction>,
}

/// As `--json` has it.
#[derive(Serialize)]
pub(super) struct ConstantsReport<'a> {
    rank: usize,
    unknowns: usize,
    values: Vec<(&'a str, Option<f64>)>,
    directions: Vec<DirectionReport<'a>>,
}

impl Told {
    /// Nothing of a chain, and of constants that are no more than the sums.
    pub fn new(compiled: &Compiled, found: &OutputEstimate) -> Option<Self> {
        let energies = compiled.model.energies()?;
        let kept = compiled.base.kept.iter();
        let is_sum = |k: &&usize| !matches!(compiled.standard[**k].owner, Owner::Effect { .. });
        let sums = kept.filter(is_sum).count();
        let own = energies.parameters.iter();
        let own: Vec<String> = own.map(|constant| constant.name.clone()).collect();
        (own.len() > sums).then(|| Self {
            values: Values::new(compiled, found, own.len()),
            own,
            sums,
        })
    }

    pub fn report(&self) -> Option<ConstantsReport<'_>> {
        let values = self.values.as_ref()?;
        let constants = values.constants.iter();
        Some(ConstantsReport {
            rank: values.rank,
            unknowns: values.unknowns,
            values: constants.map(|(name, x)| (name.as_str(), *x)).collect(),
            directions: values.directions.iter().map(direction).collect(),
        })
    }
}

impl Display for Told {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let (own, sums) = (listed(&self.own), self.sums);
        let Some(values) = &self.values else {
            return writeln!(
                f,
                "the spec's own constants {own} appear only in {sums} sums of products, and no values near the spec's give the identified sums"
            );
        };
        let (told, untold): (Vec<_>, Vec<_>) =
            values.constants.iter().partition(|(_, x)| x.is_some());
        let untold: Vec<String> = untold.into_iter().map(|(name, _)| name.clone()).collect();
        let told = told.into_iter().filter_map(|(name, value)| {
            let value = table_value((*value)?);
            Some(format!("{name} = {}", value.trim()))
        });
        let told: Vec<String> = told.collect();
        let told = if told.is_empty() {
            String::new()
        } else {
            format!("; the sums determine {}", told.join(", "))
        };
        writeln!(
            f,
            "rank {} of {} with the spec's own constants: {own} appear only in {sums} sums of products, which do not determine {}{told}",
            values.rank,
            values.unknowns,
            listed(&untold)
        )?;
        for direction in &values.directions {
            writeln!(f, "  {direction}")?;
        }
        Ok(())
    }
}

impl Values {
    fn new(compiled: &Compiled, found: &OutputEstimate, own: usize) -> Option<Self> {
        let functions = Constants::new(compiled)?;
        let values = making(&functions, &found.values)?;
        let slopes = functions.slopes(&values);
        let free = (0..found.values.len()).filter(|k| !found.bound.contains(k));
        let free: Vec<usize> = free.collect();
        let slopes = slopes.select_rows(&free);
        // What a bound holds of an effect is no unknown of the logs.
        let open = (0..values.len()).filter(|&k| k < own || slopes.column(k).amax() > 0.0);
        let open: Vec<usize> = open.collect();
        let names: Vec<String> = open.iter().map(|&k| functions.names()[k].clone()).collect();
        let values: Vec<f64> = open.iter().map(|&k| values[k]).collect();
        let slopes = slopes.select_columns(&open);
        let told = found.identifiability.through(&slopes, &values, &names);
        let constants = names.iter().zip(&values).take(own).enumerate();
        let constants =
            constants.map(|(k, (name, x))| (name.clone(), told.is_identified(k).then_some(*x)));
        Some(Self {
            rank: told.rank,
            unknowns: names.len(),
            constants: constants.collect(),
            directions: told.directions,
        })
    }
}

/// Constants near those of the spec that make these base parameters and shapes; none where the search ends elsewhere.
fn making(functions: &Constants, wanted: &[f64]) -> Option<Vec<f64>> {
    let nominal = functions.nominal().iter();
    // Values that a spec does not give differ, as those of an arm do.
    let mut values: Vec<f64> = nominal
        .enumerate()
        .map(|(k, nominal)| nominal.unwrap_or(1.0 + 0.618 * k as f64 % 1.0))
        .collect();
    let slopes = functions.slopes(&values);
    for (row, wanted) in slopes.row_iter().zip(wanted) {
        let mut parts = row.iter().enumerate().filter(|(_, slope)| **slope != 0.0);
        if let (Some((k, slope)), None) = (parts.next(), parts.next())
            && functions.nominal()[k].is_none()
        {
            values[k] = wanted / slope;
        }
    }
    for _ in 0..STEPS {
        let own = functions.own(&values);
        let size = |x: f64| x.abs().max(f64::MIN_POSITIVE);
        let off = own.iter().zip(wanted);
        let off = DVector::from_iterator(own.len(), off.map(|(own, x)| (x - own) / size(*x)));
        if !off.iter().all(|x| x.is_finite()) {
            return None;
        }
        if off.amax() < NEAR {
            return Some(values);
        }
        let mut slopes = functions.slopes(&values);
        for (mut row, x) in slopes.row_iter_mut().zip(wanted) {
            row /= size(*x);
        }
        for (mut column, x) in slopes.column_iter_mut().zip(&values) {
            column *= *x;
        }
        let step = slopes.svd(true, true).solve(&off, 1e-9).ok()?;
        let stride = (STRIDE / step.amax()).min(1.0);
        for (x, share) in values.iter_mut().zip(step.iter()) {
            *x *= 1.0 + stride * share;
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use robot_model_codegen::compile_model;

    use super::*;

    const SWING: &str = "robot Swing {
        coordinates q1;
        parameters m = 6 kg, c = 0.3 m, i = 0.4 kg*m^2;
        constants g = 9.81 m/s^2;
        kinetic = (m*c^2 + i)/2*dot(q1)^2;
        potential = -g*m*c*cos(q1);
        effects { viscous_friction on all; }
    }";

    #[test]
    fn constants_make_what_was_found_or_there_are_none() {
        let model = robot_model_spec::load("swing.robot", SWING).expect("a spec");
        let functions = Constants::new(&compile_model(&model)).expect("it says its energies");
        let wanted = functions.own(&[5.0, 0.4, 0.3, 0.7]);
        let values = making(&functions, &wanted).expect("constants");
        for (own, wanted) in functions.own(&values).into_iter().zip(&wanted) {
            assert!((own - wanted).abs() < 1e-8, "{values:?}");
        }
        assert!(values.iter().all(|x| *x > 0.0), "{values:?}");
        // Nothing makes an inertia of a mass's and a body's own below zero out of values above.
        let below: Vec<f64> = wanted.iter().map(|x| -x.abs()).collect();
        assert!(making(&functions, &below).is_none());
    }
}
