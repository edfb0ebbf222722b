//! The specs behind the runtime's traits, with the paper's parameters as unknowns.

use robot_model::identify::output_error::Distance;
use robot_model::simulate::{Adjustable, Plant};
use robot_model::simulate::{Functions, Integrator, SimulateError, Through, Tolerances};
use robot_model_cli::interpreted::{Constants, InterpretedPlant};
use robot_model_codegen::Compiled;

use super::plant::{Position, degrees};
use super::truth::{Physical, Printed, STEP};
use crate::paper::{Error, compiled};

const ENERGIES: &str = include_str!("arm.robot");
const CHAIN: &str = include_str!("arm_dh.robot");
const SMOOTH: &str = include_str!("arm_smooth.robot");

/// How exact simulated motions are, as those of output error.
const TOLERANCES: Tolerances = Tolerances {
    relative: 1e-8,
    absolute: 1e-9,
    floor: 1e-6,
};

/// The arm of a spec that says its energies.
#[derive(Debug, Clone)]
pub struct Model {
    /// What was compiled.
    pub compiled: Compiled,
    /// Base parameters by the constants of the spec.
    pub constants: Constants,
}

/// An arm by the constants of its spec.
pub type Arm = Through<InterpretedPlant, Constants>;

impl Model {
    fn new(name: &str, spec: &str) -> Result<Self, Error> {
        let compiled = compiled(name, spec)?;
        let constants = Constants::new(&compiled).ok_or("a chain has no constants")?;
        Ok(Self {
            compiled,
            constants,
        })
    }

    /// With dry friction that holds.
    ///
    /// # Errors
    /// None are expected.
    pub fn dry() -> Result<Self, Error> {
        Self::new("arm.robot", ENERGIES)
    }

    /// With a steep curve in its place.
    ///
    /// # Errors
    /// None are expected.
    pub fn smooth() -> Result<Self, Error> {
        Self::new("arm_smooth.robot", SMOOTH)
    }

    /// By base parameters.
    ///
    /// # Errors
    /// None are expected.
    pub fn base(&self, physical: &Physical) -> Result<InterpretedPlant, Error> {
        let beta = self.constants.own(&physical.values());
        Ok(InterpretedPlant::new(self.compiled.clone(), &beta, &[])?)
    }

    /// By the constants of the spec, which are in the order of Table 2.
    ///
    /// # Errors
    /// None are expected.
    pub fn arm(&self, physical: &Physical) -> Result<Arm, Error> {
        let values = physical.values().to_vec();
        Ok(Through::new(
            self.base(physical)?,
            self.constants.clone(),
            values,
        ))
    }
}

/// The chain with a first link of this length.
///
/// # Errors
/// None are expected.
pub fn chain(l1: f64) -> Result<Compiled, Error> {
    let length = format!("a = {l1};");
    compiled("arm_dh.robot", &CHAIN.replace("a = 0.615;", &length))
}

/// Positions at every sample of an arm of the library that is let go at `q`.
///
/// # Errors
/// [`SimulateError`], of which none are expected.
pub fn simulate<P: Plant + Clone>(
    arm: &P,
    q: Position,
    samples: usize,
) -> Result<Vec<Position>, SimulateError> {
    let mut arm = Integrator::new(arm.clone(), &q, &[0.0; 2], TOLERANCES)?;
    let mut positions = Vec::with_capacity(samples);
    for sample in 0..samples {
        if sample > 0 {
            arm.advance(sample as f64 * STEP)?;
        }
        positions.push([arm.q()[0], arm.q()[1]]);
    }
    Ok(positions)
}

/// Where an arm of the library hangs in the end, after a minute.
///
/// # Errors
/// [`SimulateError`], of which none are expected.
pub fn rest<P: Plant + Clone>(arm: &P, q: Position) -> Result<Position, SimulateError> {
    let mut arm = Integrator::new(arm.clone(), &q, &[0.0; 2], TOLERANCES)?;
    arm.advance(60.0)?;
    Ok([arm.q()[0], arm.q()[1]])
}

/// The arm with other values of its parameters.
#[must_use]
pub fn with<P: Adjustable + Clone>(arm: &P, values: &[f64]) -> P {
    let mut arm = arm.clone();
    arm.adjust(values);
    arm
}

/// Equations (7), in degrees, and (8) of one joint.
#[must_use]
pub fn errors(measured: &[Position], simulated: &[Position], joint: usize) -> Printed {
    let pairs = degrees(measured, joint)
        .into_iter()
        .zip(degrees(simulated, joint));
    let distance = Distance::new(&pairs.collect::<Vec<_>>());
    Printed {
        mae: distance.mae,
        nrmse: distance.nrmse_fit_percent.unwrap_or(0.0),
    }
}
