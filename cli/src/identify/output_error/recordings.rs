//! Logs as they drive a simulation.

use robot_model::identify::output_error::Recording;
use robot_model::log::Log;
use robot_model_codegen::Compiled;
use robot_model_codegen::expr::Symbol;

use crate::Error;

/// Logs as they drive a simulation.
pub(super) fn recordings(
    compiled: &Compiled,
    shapes: &[f64],
    logs: &[Log],
) -> Result<Vec<Recording>, Error> {
    let gain: Vec<f64> = compiled
        .model
        .joints
        .iter()
        .map(|joint| joint.actuator_gain)
        .collect();
    let late = compiled.delay().map_or(0.0, |delay| {
        delay.eval(&|symbol| match symbol {
            Symbol::Shape(k) => shapes[k],
            _ => unreachable!("checked in model-spec: a delay is constant"),
        })[0]
    });
    let channels = compiled.model.inputs();
    let recording = |log: &Log| {
        let inputs = channels.iter().map(|name| {
            let place = log.extra.iter().position(|channel| channel.name == *name);
            place.ok_or_else(|| {
                Error::Argument(format!(
                    "{}: it has no column `{name}`, which a declared effect reads",
                    log.source
                ))
            })
        });
        let inputs = inputs.collect::<Result<Vec<usize>, Error>>()?;
        Ok(Recording::new(log, &gain, late, inputs))
    };
    logs.iter().map(recording).collect()
}
