//! Parameters from which a search by simulation begins.

use std::path::Path;

use robot_model::identify::output_error::{OutputErrorError, OutputEstimate};
use robot_model::identify::{Estimate, Identify, IdentifyError};
use robot_model::log::Log;
use robot_model::signal::Bands;
use robot_model::simulate::Adjustable;
use robot_model_codegen::Compiled;

use super::super::doubts;
use super::super::fit::{ByAcceleration, Fit, errors_of_all};
use super::{law, lumped, refused, rmse, starts};
use crate::Error;
use crate::audit;
use crate::interpreted::InterpretedPlant;
use crate::output;
use crate::parameters::{self, Values};

/// An arm as the spec has it, and with parameters of motors and of links that move apart each on its own.
#[derive(Clone, Copy)]
pub(super) struct Parted<'a> {
    pub whole: &'a Compiled,
    pub parted: &'a Compiled,
}

/// Where the search starts, and what least squares says where it has a say.
pub(super) struct Beginning {
    pub plant: InterpretedPlant,
    pub names: Vec<String>,
    pub shapes: Vec<f64>,
    pub linear: Option<Estimate>,
    /// Parameters of the plant to start from: of several the one that leads deepest is to be found.
    pub starts: Vec<Vec<f64>>,
}

impl Beginning {
    /// Parameters from a file, from least squares, or from the spec.
    pub(super) fn of(
        arm: Parted<'_>,
        form: &ByAcceleration,
        logs: &[Log],
        bands: Option<Bands>,
        start: Option<&Path>,
    ) -> Result<Self, Error> {
        let compiled = arm.parted;
        let shape_names = compiled.shape_names();
        let free = compiled.free_shapes();
        let base = compiled.base.names.iter().cloned();
        let names = base.chain(free.iter().map(|&k| shape_names[k].clone()));
        let identify = Identify {
            bands,
            ..Identify::default()
        };
        let linear = form.fit(&identify, logs);
        let both = |values: Values| (values.beta, values.shapes);
        let mut others = Vec::new();
        let fitted = linear.as_ref().ok();
        let fitted = fitted.filter(|estimate| estimate.unexcited.is_empty());
        let shapes_of = |estimate: &Estimate| {
            let mut shapes = robot_model_codegen::base::shape_values(&compiled.model);
            for (&k, (_, value)) in free.iter().zip(&estimate.shapes) {
                shapes[k] = *value;
            }
            shapes
        };
        let of_shapes = |shapes: &[f64]| {
            let with = Identify {
                shapes: Some(free.iter().map(|&k| shapes[k]).collect()),
                ..identify.clone()
            };
            let estimate = form.fit(&with, logs).ok()?;
            estimate.unexcited.is_empty().then(|| estimate.values())
        };
        let (beta, shapes) = match (start, fitted) {
            (Some(file), fitted) => match parameters::resolve(compiled, Some(file)) {
                Ok(values) => both(values),
                Err(lack) => {
                    if let Some(both) = lumped::apart(arm.whole, compiled, file)? {
                        both
                    } else {
                        let shapes = fitted.map(shapes_of);
                        let over = shapes
                            .map(|shapes| parameters::over(compiled, file, shapes, &of_shapes));
                        over.transpose()?.flatten().ok_or(lack)?
                    }
                }
            },
            (None, Some(estimate)) => {
                others = starts::starts(form, estimate, logs);
                (estimate.values(), shapes_of(estimate))
            }
            (None, None) => both(parameters::resolve(compiled, None).map_err(|lack| {
                let why = match &linear {
                    // The arm may well move, as one that is let go does.
                    Err(IdentifyError::NothingExcited { .. }) => "constant torques and joints at rest are no use to it; if the arm falls \
                                                                  freely, give `--start`"
                        .to_owned(),
                    Err(error) => error.to_string(),
                    Ok(estimate) => {
                        let names: Vec<&str> =
                            estimate.unexcited.iter().map(String::as_str).collect();
                        format!("it does not separate {}", output::names(&names))
                    }
                };
                Error::Argument(format!(
                    "a simulation needs start values, which neither least squares on these logs gives ({why}) nor the spec: {lack}"
                ))
            })?),
        };
        let plant = InterpretedPlant::new(compiled.clone(), &beta, &shapes)?;
        let others = others.into_iter().skip(1);
        let others = others.map(|(beta, shapes)| [beta, shapes].concat());
        Ok(Beginning {
            names: names.collect(),
            starts: std::iter::once(plant.values()).chain(others).collect(),
            plant,
            shapes,
            linear: linear.ok(),
        })
    }

    /// Why nothing was found, with what is wrong with the arm that the search starts from.
    pub(super) fn refused(&self, compiled: &Compiled, error: &OutputErrorError) -> Error {
        let start = &self.starts[0][..compiled.base.kept.len()];
        let inertia = match error {
            OutputErrorError::Start { .. } => audit::inertia_of(compiled, start, &self.shapes),
            _ => None,
        };
        let Some(inertia) = inertia else {
            return refused(error);
        };
        Error::Argument(format!(
            "{error}\nthe search starts from physically impossible parameters: {inertia}; start from the nearest possible arm: `--method \
             physical --json start.json`, then `--start start.json`"
        ))
    }

    /// What is odd about what was found from it.
    pub(super) fn doubts(
        &self,
        form: &ByAcceleration,
        logs: &[Log],
        found: &OutputEstimate,
    ) -> Vec<String> {
        // What its sign holds is as least squares would have it.
        let free = |name: &String| {
            let linear = self.linear.iter().flat_map(|linear| &linear.parameters);
            let mut linear = linear.filter(|parameter| parameter.name == *name);
            linear.next().map(|found| (found.value, found.std))
        };
        let told = self.names.iter().enumerate().filter_map(|(k, name)| {
            let own = found.std[k].map(|std| (found.values[k], std));
            let at_bound = || found.bound.contains(&k).then(|| free(name)).flatten();
            let (value, std) = own.or_else(at_bound)?;
            Some((name.as_str(), value, std))
        });
        let unknowns = form.unknowns();
        let told = told.filter_map(|told| {
            let unknown = unknowns.iter().find(|unknown| unknown.name == told.0)?;
            Some((told, unknown))
        });
        let beyond = doubts::beyond_noise(form.model(), logs, &rmse(found));
        // A torque whose positions are right has noise.
        let torques = found.fit.torque.as_ref().filter(|_| beyond.is_some());
        let controller = torques.and_then(|torques| {
            let equations = self.linear.as_ref()?;
            let left = errors_of_all(equations, form, logs).ok()?;
            law::doubt(&equations.joints, torques, &left.rmse)
        });
        let doubts = [doubts::below_zero(told), beyond, controller];
        doubts.into_iter().flatten().collect()
    }
}
