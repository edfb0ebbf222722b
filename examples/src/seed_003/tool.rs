//! What is asked of robot-model: the friction curve, the bristles, output error, motions.

use std::collections::BTreeMap;

use robot_model::columns::Arm;
use robot_model::friction_curve::{Bristles, Curve, Law, Measured, Value};
use robot_model::identify::output_error::{Hold, OutputError, Recording};
use robot_model::identify::{Identify, torque_of};
use robot_model::log::Log;
use robot_model::motion::{Kinematics, Motion};
use robot_model::simulate::Adjustable;
use robot_model_cli::audit::{Check, audit};
use robot_model_cli::interpreted::{InterpretedArm, InterpretedPlant};
use robot_model_codegen::Compiled;

use super::plant::Friction;
use super::truth;
use crate::paper::{Error, compiled};

/// The link without friction of bristles.
pub const LINK: &str = include_str!("link.robot");
/// The link with it.
pub const BRISTLES: &str = include_str!("bristles.robot");

/// The friction curve of logs, and its law. The link's weight is known, as the paper computes `G`, unless it `is_fitted` beside.
///
/// # Errors
/// Why there is none.
pub fn curve(logs: &[Log], is_fitted: bool) -> Result<(Curve, Law), Error> {
    let arm = link(is_fitted)?;
    let curve = measured(&arm).curve(logs)?;
    let law = Law::fit(&curve)?;
    Ok((curve, law))
}

/// Bristles from a torque that rises from rest.
///
/// # Errors
/// Why they cannot be had.
pub fn bristles(curve: &Curve, law: &Law, log: &Log) -> Result<Bristles, Error> {
    let arm = link(false)?;
    Ok(measured(&arm).bristles(curve, law, log)?)
}

fn link(is_fitted: bool) -> Result<InterpretedArm, Error> {
    let text = if is_fitted {
        LINK.replace("th: fixed", "th")
    } else {
        LINK.to_owned()
    };
    Ok(InterpretedArm::new(compiled("link.robot", &text)?))
}

/// Columns of the rigid body; viscous friction is a part of the curve.
fn measured(arm: &InterpretedArm) -> Measured<'_> {
    let compiled = arm.compiled();
    let columns = (0..compiled.base.kept.len()).filter(|&column| compiled.is_rigid(column));
    Measured {
        arm,
        joint: 0,
        shapes: Vec::new(),
        columns: columns.collect(),
        known: None,
    }
}

/// The link with bristles as a plant, with values of a friction; hanging, or with another inertia where
/// nothing weighs.
///
/// # Errors
/// What is wrong in the spec.
pub fn plant(friction: &Friction, inertia: Option<f64>) -> Result<InterpretedPlant, Error> {
    let text = inertia.map_or_else(|| BRISTLES.to_owned(), lying);
    plant_of(compiled("bristles.robot", &text)?, friction)
}

/// As [`plant`], of a spec that is compiled.
///
/// # Errors
/// None is expected: values that are not its own.
pub fn plant_of(compiled: Compiled, friction: &Friction) -> Result<InterpretedPlant, Error> {
    let (beta, shapes) = numbers(&compiled, friction);
    Ok(InterpretedPlant::new(compiled, &beta, &shapes)?)
}

/// The spec with the axis upright, where nothing weighs, and another inertia about it.
fn lying(inertia: f64) -> String {
    let about_center = inertia - truth::MASS * (0.5 * truth::LENGTH).powi(2);
    BRISTLES
        .replace("[0, -9.81, 0]", "[0, 0, -9.81]")
        .replace("1.65375e-4", &about_center.to_string())
}

/// Values of base parameters and of shapes.
fn numbers(compiled: &Compiled, friction: &Friction) -> (Vec<f64>, Vec<f64>) {
    let values = |names: &[String]| names.iter().map(|name| value(friction, name)).collect();
    (
        values(&compiled.base.names),
        values(&compiled.shape_names()),
    )
}

/// The end of a parameter's name.
fn own(name: &str) -> &str {
    name.rsplit_once('.').map_or(name, |(_, own)| own)
}

/// The value of a parameter or a shape by the end of its name.
fn value(friction: &Friction, name: &str) -> f64 {
    match own(name) {
        "fc" => friction.coulomb,
        "s1" => friction.damping,
        "fv" => friction.viscous,
        "d" => friction.coulomb / friction.stiffness,
        "vs" => friction.stribeck,
        "rise" => friction.breakaway / friction.coulomb - 1.0,
        _ => f64::NAN,
    }
}

/// Torque of the spec's friction where it has slid at a constant speed for long, N m.
///
/// # Errors
/// What is wrong in the spec.
pub fn settled(friction: &Friction, speed: f64) -> Result<f64, Error> {
    let arm = InterpretedArm::new(compiled("bristles.robot", &lying(LYING_INERTIA))?);
    let (beta, shapes) = numbers(arm.compiled(), friction);
    let interval = SETTLED_RAD / (SETTLED_SAMPLES as f64 * speed.abs());
    let time: Vec<f64> = (0..SETTLED_SAMPLES).map(|k| k as f64 * interval).collect();
    let torque = along(&arm, &time, |t| [speed * t, speed, 0.0], (&beta, &shapes));
    Ok(torque[SETTLED_SAMPLES - 1])
}

/// How far the link turns until its friction has settled, in so many samples.
const SETTLED_RAD: f64 = 60.0;
const SETTLED_SAMPLES: usize = 3000;

/// Of a link that does not accelerate.
const LYING_INERTIA: f64 = 1e-3;

/// Torque along a motion that is known exactly: position, velocity, acceleration at a time.
fn along(
    arm: &InterpretedArm,
    time: &[f64],
    motion: impl Fn(f64) -> [f64; 3],
    (beta, shapes): (&[f64], &[f64]),
) -> Vec<f64> {
    let of = |k: usize| vec![time.iter().map(|t| motion(*t)[k]).collect()];
    let exact = Kinematics {
        q: of(0),
        dq: of(1),
        ddq: of(2),
    };
    let motion = Motion {
        time: time.to_vec(),
        smooth: exact.clone(),
        wide: exact,
        ..Motion::default()
    };
    let known = arm.known_torque(&motion, shapes).swap_remove(0);
    let torque = torque_of(arm, &motion, shapes, beta, 1).swap_remove(0);
    torque
        .iter()
        .zip(&known)
        .map(|(torque, known)| torque + known)
        .collect()
}

/// Inertia, kg m^2, and torque of gravity at some angles, N m, of a spec without friction in it.
///
/// # Errors
/// What is wrong in the spec.
pub fn rigid(
    name: &str,
    text: &str,
    beta: &[f64],
    angles: &[f64],
) -> Result<(f64, Vec<f64>), Error> {
    let arm = InterpretedArm::new(compiled(name, text)?);
    let torque = |q: f64, ddq: f64| along(&arm, &[0.0, 1.0], |_| [q, 0.0, ddq], (beta, &[]))[0];
    let gravity = angles.iter().map(|q| torque(*q, 0.0)).collect();
    Ok((torque(0.0, 1.0) - torque(0.0, 0.0), gravity))
}

/// Values of parameters by name.
#[must_use]
pub fn values(friction: &Friction) -> BTreeMap<String, f64> {
    let linear = [
        "soft_bristles.fc",
        "soft_bristles.s1",
        "viscous_friction.fv",
    ];
    let shapes = ["soft_bristles.d", "soft_bristles.vs", "soft_bristles.rise"];
    let names = linear.into_iter().chain(shapes);
    names
        .map(|name| (format!("th.{name}"), value(friction, name)))
        .collect()
}

/// What `audit` says of the link with this friction.
///
/// # Errors
/// What is wrong in the spec.
pub fn checks(friction: &Friction) -> Result<Vec<Check>, Error> {
    let compiled = compiled("bristles.robot", BRISTLES)?;
    Ok(audit(&compiled, &values(friction))?)
}

/// A parameter by least squares on one log, with its deviation, and the error of the torque, %.
///
/// # Errors
/// Why there is none.
pub fn least_squares(
    name: &str,
    text: &str,
    parameters: [&str; 2],
    log: &Log,
) -> Result<([Value; 2], f64), Error> {
    let arm = InterpretedArm::new(compiled(name, text)?);
    let logs = std::slice::from_ref(log);
    let estimate = Identify::default().fit(&arm, logs)?;
    let found = parameters.map(|parameter| {
        let mut all = estimate.parameters.iter();
        let nothing = Value {
            value: 0.0,
            std: f64::NAN,
        };
        all.find(|found| found.name.ends_with(parameter))
            .map_or(nothing, |found| Value {
                value: found.value,
                std: found.std,
            })
    });
    let errors = estimate.errors(&arm, log)?;
    Ok((found, errors.relative_percent[0]))
}

/// `s0` and `s1` by output error from `start`, whose static parameters stay.
///
/// # Errors
/// Why there is none.
pub fn dynamic(start: &Friction, log: &Log) -> Result<Dynamic, Error> {
    let compiled = compiled("bristles.robot", BRISTLES)?;
    let base = compiled.base.names.iter().cloned();
    let names: Vec<String> = base.chain(compiled.shape_names()).collect();
    let plant = plant(start, None)?;
    let values = plant.values();
    let is_open = |name: &String| matches!(own(name), "s1" | "d");
    let bounds = names.iter().zip(&values).map(|(name, &value)| {
        if is_open(name) {
            [1e-3 * value, 1e3 * value]
        } else {
            [value, value]
        }
    });
    let setting = OutputError {
        bounds: bounds.collect(),
        // Logged torques are those of their instants.
        hold: Some(Hold::Mean),
        ..OutputError::default()
    };
    let joints = compiled.model.joints.iter();
    let gain: Vec<f64> = joints.map(|joint| joint.actuator_gain).collect();
    let recording = Recording::new(log, &gain, 0.0, Vec::new());
    let found = setting.fit(&plant, &names, &values, &[recording], &mut |_| ())?;
    let told = |end: &str| {
        let place = names.iter().position(|name| own(name) == end)?;
        Some(Value {
            value: found.values[place],
            std: found.std[place].unwrap_or(f64::NAN),
        })
    };
    let (Some(deflection), Some(damping)) = (told("d"), told("s1")) else {
        return Err("the spec of the bristles has other names".into());
    };
    let stiffness = start.coulomb / deflection.value;
    Ok(Dynamic {
        stiffness: Value {
            value: stiffness,
            std: stiffness * deflection.std / deflection.value,
        },
        damping,
        rmse: found.fit.position[0].rmse,
    })
}

/// The dynamic two parameters.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dynamic {
    /// `s0`, N m/rad.
    pub stiffness: Value,
    /// `s1`, N m s/rad.
    pub damping: Value,
    /// Root mean square of the errors of positions, rad.
    pub rmse: f64,
}
