//! From options and a compiled spec to what is designed.

use robot_model::excite::{Clearance, Ends, Limits, Regressor, Request};
use robot_model_codegen::{Compiled, Nominal};

use super::{EndsArgument, Excite, columns, limits, room, separate};
use crate::Error;
use crate::interpreted::InterpretedFunction;
use crate::output::names;
use crate::parameters;
use crate::progress::Progress;

/// Velocity within which dry friction turns round while a motion is looked for, as a share of a joint's velocity limit.
const TURN: f64 = 0.01;

impl Excite {
    /// What is designed: columns, limits, ends and criterion.
    pub(super) fn request(
        &self,
        compiled: &Compiled,
        rivals: Option<&separate::Expected>,
        progress: &Progress,
    ) -> Result<Request, Error> {
        let scaling = self.criterion.scaling(self.unit_columns)?;
        let joints: Vec<String> = compiled
            .model
            .joints
            .iter()
            .map(|joint| joint.name.clone())
            .collect();
        let limits = limits::of(&compiled.model, self.acceleration.as_deref())?;
        let expected = rivals.map_or_else(Vec::new, separate::Expected::shapes);
        let known = parameters::known(compiled, self.parameters.as_deref(), &expected)?;
        let guessed = &known.guessed;
        if !guessed.is_empty() {
            let guessed: Vec<&str> = guessed.iter().map(String::as_str).collect();
            progress.note(&format!(
                "note: designed with the spec's first values of {}; give others with `--parameters`",
                names(&guessed)
            ));
        }
        if compiled.check_instantaneous().is_err() || compiled.delay().is_some() {
            progress.note("note: the design ignores effects that displace links or delay torques");
        }
        let nominal = Nominal {
            beta: known.beta.clone(),
            shapes: known.shapes.clone(),
            turn: limits.velocity.iter().map(|speed| TURN * speed).collect(),
        };
        let beside = rivals.map(|rivals| rivals.columns(compiled));
        let beside = beside.unwrap_or_default();
        let columns = compiled.design_columns(&nominal, &beside);
        let jumping = Nominal {
            turn: Vec::new(),
            ..nominal.clone()
        };
        let jumping = compiled.design_columns(&jumping, &beside);
        if !columns.left_out.is_empty() {
            let left_out = columns.left_out.iter();
            let left_out: Vec<String> = left_out.map(|column| column.name(compiled)).collect();
            progress.note(&format!(
                "note: the design ignores {}: {} on more than the motion",
                names(&left_out.iter().map(String::as_str).collect::<Vec<_>>()),
                if left_out.len() == 1 {
                    "it depends"
                } else {
                    "they depend"
                },
            ));
        }
        let criterion = match rivals {
            Some(rivals) => rivals.criterion(compiled, &columns, &known)?,
            None => self.criterion.into(),
        };
        let basis = match &self.columns {
            None => None,
            Some(names) => Some(columns::basis(compiled, &columns, names)?),
        };
        let function = |programs| InterpretedFunction::new(programs, compiled.dof(), self.period);
        let followed = function(columns.function);
        if let Some(state) = followed.restless_state() {
            return Err(Error::Argument(format!(
                "the state `{}` does not become periodic when a motion repeats, so no motion can be designed; remove its effect from the spec",
                compiled.model.states()[state]
            )));
        }
        let clearances = self.clearances(
            compiled,
            rivals,
            &nominal,
            &limits,
            &known.missing,
            progress,
        )?;
        let of_columns = columns.columns.iter();
        let noise = limits::noise(self.noise.as_deref(), &limits, &joints)?;
        Ok(Request {
            regressor: Regressor {
                columns: of_columns.map(|column| column.name(compiled)).collect(),
                entries: columns.entries,
                function: Box::new(followed),
                exact: Box::new(function(jumping.function)),
            },
            joints,
            limits,
            clearances,
            criterion,
            basis,
            scaling,
            noise,
            period: self.period,
            harmonics: self.harmonics,
            ends: match (&self.pose, self.ends) {
                (Some(pose), _) => Ends::At(pose.clone()),
                (None, EndsArgument::Rest) => Ends::AtRest,
                (None, EndsArgument::Free) => Ends::Free,
            },
            starts: self.starts as usize,
            seed: self.seed,
        })
    }

    /// Torque limits and the room, where there are some.
    fn clearances(
        &self,
        compiled: &Compiled,
        rivals: Option<&separate::Expected>,
        nominal: &Nominal,
        limits: &Limits,
        missing: &[String],
        progress: &Progress,
    ) -> Result<Vec<Box<dyn Clearance>>, Error> {
        let mut clearances = Vec::new();
        let is_limited = limits.torque.iter().any(|limit| limit.is_finite());
        let reads_load = rivals.is_some_and(separate::Expected::read_load);
        let said: Vec<&str> = rivals
            .into_iter()
            .flat_map(separate::Expected::parameters)
            .collect();
        let missing = missing.iter().map(String::as_str);
        let missing: Vec<&str> = missing.filter(|name| !said.contains(name)).collect();
        if (is_limited || reads_load) && !missing.is_empty() {
            progress.note(&format!(
                "note: torques are computed without {}, which {} no value; give {} with `--parameters`",
                names(&missing),
                if missing.len() == 1 { "has" } else { "have" },
                if missing.len() == 1 { "it" } else { "them" },
            ));
        }
        if is_limited {
            // Whichever of two rivals is there, the limits are kept.
            let arms = match rivals {
                Some(rivals) => rivals.arms(compiled).to_vec(),
                None => vec![Vec::new()],
            };
            for values in arms {
                let known = parameters::known(compiled, self.parameters.as_deref(), &values)?;
                let arm = Nominal {
                    beta: known.beta,
                    shapes: known.shapes,
                    turn: nominal.turn.clone(),
                };
                clearances.push(limits::torque(compiled, &arm, limits, self.period));
            }
        }
        if let Some(path) = &self.room {
            clearances.push(room::read(path, compiled, nominal, self.period)?);
        }
        Ok(clearances)
    }
}
