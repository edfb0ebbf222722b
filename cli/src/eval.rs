//! `robot-model eval`: the equations' values at given states.

mod states;

use std::collections::BTreeMap;
use std::path::PathBuf;

use clap::Args;
use robot_model_codegen::expr::Symbol;
use robot_model_codegen::interpreter::Program;
use robot_model_codegen::{Block, Compiled};
use serde::Serialize;

use crate::parameters::{self, Values};
use crate::spec::compile_instantaneous;
use crate::{Error, output};
use states::State;

/// Compute mass matrix, Coriolis matrix, gravity, torque, regressors (`torque = base_regressor * beta + known_torque`), energies,
/// derivatives, positions of links or points and their Jacobians at given states, as JSON.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  robot-model eval arm.robot --states states.json --parameters fit.json
  robot-model eval arm.robot --states states.json > values.json")]
pub(crate) struct Eval {
    /// The `.robot` file.
    spec: PathBuf,
    /// States: `{"states":[{"q":[..],"dq":[..],"ddq":[..]}]}`, in rad and m; if effects read them, also `"time"`,
    /// `"measured_torque":[..]`, `"inputs":{"temperature":30}` and `"states":{"elbow.lugre_presliding.z":0}`.
    #[arg(long, value_name = "FILE.json")]
    states: PathBuf,
    /// Parameter values by name, or what `identify --json` writes; without it the spec's own values.
    #[arg(long, value_name = "FILE.json")]
    parameters: Option<PathBuf>,
}

#[derive(Serialize)]
struct Evaluation<'a> {
    robot: &'a str,
    dof: usize,
    standard_parameters: Vec<&'a str>,
    base_parameters: Vec<BaseParameter<'a>>,
    states: Vec<StateValues>,
}

#[derive(Serialize)]
struct BaseParameter<'a> {
    name: &'a str,
    /// Names are listed in alphabetical order.
    combination: BTreeMap<&'a str, f64>,
}

type Matrix = Vec<Vec<f64>>;

#[derive(Serialize)]
struct StateValues {
    mass_matrix: Matrix,
    coriolis_matrix: Matrix,
    gravity: Vec<f64>,
    torque: Vec<f64>,
    regressor: Matrix,
    base_regressor: Matrix,
    /// Of what the spec fixes: `torque = base_regressor * beta + known_torque`.
    known_torque: Vec<f64>,
    kinetic_energy: f64,
    /// Up to a constant.
    potential_energy: f64,
    /// Columns without a momentum form are zero.
    momentum_regressor: Matrix,
    drift_regressor: Matrix,
    /// `d tau / dq` and `d tau / d dq`.
    torque_by_position: Matrix,
    torque_by_velocity: Matrix,
    /// Of a chain: homogeneous matrices, base to tip.
    #[serde(skip_serializing_if = "Option::is_none")]
    forward_kinematics: Option<Vec<Matrix>>,
    /// Of a chain.
    #[serde(skip_serializing_if = "Option::is_none")]
    jacobian: Option<Matrix>,
    /// Of a robot that says its energies, in the order of the spec.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    points: Vec<PointValues>,
}

#[derive(Serialize)]
struct PointValues {
    name: String,
    /// In the base frame, m.
    position: Vec<f64>,
    /// `d position / dq`
    jacobian: Matrix,
}

impl Eval {
    pub(crate) fn run(&self) -> Result<(), Error> {
        let compiled = compile_instantaneous(&self.spec)?;
        let states = states::read(&self.states, &compiled)?;
        let values = parameters::resolve(&compiled, self.parameters.as_deref())?;
        let programs = Programs::new(&compiled);
        let evaluation = Evaluation {
            robot: &compiled.model.name,
            dof: compiled.dof(),
            standard_parameters: compiled
                .standard
                .iter()
                .map(|parameter| parameter.name.as_str())
                .collect(),
            base_parameters: base_parameters(&compiled),
            states: states
                .iter()
                .map(|state| programs.eval(state, &values))
                .collect(),
        };
        let written = output::json(&evaluation);
        match not_finite(&written) {
            Some((state, form)) => Err(Error::json(
                &self.states,
                &format!(
                    "state {state}: `{form}` is not finite there; give states that the arm can reach, or change the parameters"
                ),
            )),
            None => output::print(&written),
        }
    }
}

/// The first state, from 1, with a value that is not finite, and the name of this value: JSON has `null` there.
fn not_finite(written: &str) -> Option<(usize, String)> {
    fn has_null(value: &serde_json::Value) -> bool {
        match value {
            serde_json::Value::Null => true,
            serde_json::Value::Array(items) => items.iter().any(has_null),
            serde_json::Value::Object(entries) => entries.values().any(has_null),
            _ => false,
        }
    }
    let evaluation: serde_json::Value = serde_json::from_str(written).ok()?;
    let states = evaluation["states"].as_array()?;
    states.iter().enumerate().find_map(|(k, state)| {
        let (form, _) = state
            .as_object()?
            .iter()
            .find(|(_, value)| has_null(value))?;
        Some((k + 1, form.clone()))
    })
}

fn base_parameters(compiled: &Compiled) -> Vec<BaseParameter<'_>> {
    let base = &compiled.base;
    let combination = |terms: &Vec<(usize, f64)>| {
        terms
            .iter()
            .map(|&(k, coefficient)| (compiled.standard[k].name.as_str(), coefficient))
            .collect()
    };
    base.names
        .iter()
        .zip(&base.combinations)
        .map(|(name, terms)| BaseParameter {
            name,
            combination: combination(terms),
        })
        .collect()
}

/// The programs of all forms.
struct Programs {
    dof: usize,
    standard: usize,
    base: usize,
    inputs: Vec<String>,
    states: Vec<String>,
    mass_matrix: Program,
    coriolis_matrix: Program,
    gravity: Program,
    rigid_torque: Program,
    torque: Program,
    regressor: Block,
    base_regressor: Block,
    known_torque: Program,
    energies: Program,
    momentum: Block,
    drift: Block,
    by_position: Program,
    by_velocity: Program,
    forward_kinematics: Option<Program>,
    jacobian: Option<Program>,
    point_names: Vec<String>,
    points: Program,
}

impl Programs {
    fn new(compiled: &Compiled) -> Self {
        Self {
            dof: compiled.dof(),
            standard: compiled.standard.len(),
            base: compiled.base.kept.len(),
            inputs: compiled.model.inputs(),
            states: compiled.model.states(),
            mass_matrix: compiled.mass_matrix(),
            coriolis_matrix: compiled.coriolis_matrix(),
            gravity: compiled.gravity(),
            rigid_torque: compiled.rigid_torque(),
            torque: compiled.inverse_dynamics(),
            regressor: compiled.regressor(),
            base_regressor: compiled.base_regressor(),
            known_torque: compiled.known_torque(),
            energies: compiled.energies(),
            momentum: compiled.momentum_regressor(),
            drift: compiled.drift_regressor(),
            by_position: compiled.by_position(),
            by_velocity: compiled.by_velocity(),
            forward_kinematics: compiled.forward_kinematics(),
            jacobian: compiled.jacobian(),
            point_names: compiled.points.iter().map(|p| p.name.clone()).collect(),
            points: compiled.points(),
        }
    }

    fn eval(&self, state: &State, values: &Values) -> StateValues {
        let bind = |rigid_torque: &[f64], symbol| match symbol {
            Symbol::Q(joint) => state.q[joint],
            Symbol::Dq(joint) => state.dq[joint],
            Symbol::Ddq(joint) => state.ddq[joint],
            Symbol::Time => state.time,
            Symbol::Parameter(k) => values.parameters[k],
            Symbol::Shape(k) => values.shapes[k],
            Symbol::RigidTorque(joint) => rigid_torque[joint],
            Symbol::MeasuredTorque(joint) => state.measured_torque[joint],
            Symbol::Input(k) => state.inputs[&self.inputs[k]],
            Symbol::State(k) => state.states.get(&self.states[k]).copied().unwrap_or(0.0),
            Symbol::Switch(_) | Symbol::Weight(_) => {
                unreachable!("in equations of simulation and design alone")
            }
        };
        // The load comes first: effects may depend on it.
        let load = self.rigid_torque.eval(&|symbol| bind(&[], symbol));
        let run = |program: &Program| program.eval(&|symbol| bind(&load, symbol));
        let square =
            |program: &Program| run(program).chunks(self.dof).map(<[f64]>::to_vec).collect();
        let columns = |block: &Block, count: usize| {
            let mut matrix = vec![vec![0.0; count]; self.dof];
            for (&(joint, column), value) in block.entries.iter().zip(run(&block.program)) {
                matrix[joint][column] = value;
            }
            matrix
        };
        let energies = run(&self.energies);
        let poses = |program: &Program| {
            let values = run(program);
            let pose = |pose: &[f64]| pose.chunks(4).map(<[f64]>::to_vec).collect();
            values.chunks(16).map(pose).collect()
        };
        StateValues {
            mass_matrix: square(&self.mass_matrix),
            coriolis_matrix: square(&self.coriolis_matrix),
            gravity: run(&self.gravity),
            torque: run(&self.torque),
            regressor: columns(&self.regressor, self.standard),
            base_regressor: columns(&self.base_regressor, self.base),
            known_torque: run(&self.known_torque),
            kinetic_energy: energies[0],
            potential_energy: energies[1],
            momentum_regressor: columns(&self.momentum, self.standard),
            drift_regressor: columns(&self.drift, self.standard),
            torque_by_position: square(&self.by_position),
            torque_by_velocity: square(&self.by_velocity),
            forward_kinematics: self.forward_kinematics.as_ref().map(poses),
            jacobian: self.jacobian.as_ref().map(square),
            points: self.point_values(&run(&self.points)),
        }
    }

    fn point_values(&self, values: &[f64]) -> Vec<PointValues> {
        let each = values.chunks(3 + 3 * self.dof);
        let names = self.point_names.iter();
        names
            .zip(each)
            .map(|(name, values)| {
                let (position, jacobian) = values.split_at(3);
                PointValues {
                    name: name.clone(),
                    position: position.to_vec(),
                    jacobian: jacobian.chunks(self.dof).map(<[f64]>::to_vec).collect(),
                }
            })
            .collect()
    }
}
