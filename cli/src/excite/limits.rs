//! Limits of a motion: those of the spec, and those of the command line.

use robot_model::excite::{Clearance, Limits, TorqueLimits};
use robot_model_codegen::{Compiled, Nominal};
use robot_model_spec::Model;
use robot_model_spec::model::{Joint, JointKind};

use crate::Error;
use crate::interpreted::InterpretedFunction;

/// Limits of a model's joints; `acceleration` has one number, or one a joint, for joints whose spec says none.
pub(super) fn of(model: &Model, acceleration: Option<&[f64]>) -> Result<Limits, Error> {
    let joints = &model.joints;
    let mut limits = Limits::none(joints.len());
    let given = per_joint("--acceleration", acceleration, joints.len())?;
    let is_limited = |joint: &Joint| joint.limits.acceleration.is_some();
    let mut all = given.iter().flatten();
    if let Some(other) = all.find(|x| x.is_nan() || **x <= 0.0) {
        return Err(Error::Argument(format!(
            "--acceleration: {other} is no limit; write a positive number, one for all joints or one for each"
        )));
    }
    if given.is_some() && joints.iter().all(is_limited) {
        return Err(Error::Argument(format!(
            "--acceleration is for joints without a limit in the spec, but {} has one for each; change it there",
            model.source
        )));
    }
    for (k, joint) in joints.iter().enumerate() {
        let own = &joint.limits;
        if joint.kind == JointKind::Prismatic && own.position.is_none() {
            return Err(Error::Argument(format!(
                "{}: prismatic joint `{}` has no position limits; write `position = .. m .. .. m` into its spec",
                model.source, joint.name
            )));
        }
        limits.position[k] = own.position.unwrap_or(limits.position[k]);
        limits.velocity[k] = own.velocity.unwrap_or(f64::INFINITY);
        let other = given.as_ref().map_or(f64::INFINITY, |given| given[k]);
        limits.acceleration[k] = own.acceleration.unwrap_or(other);
        limits.torque[k] = own.torque.unwrap_or(f64::INFINITY);
    }
    Ok(limits)
}

/// One number a joint, of one for all or one each.
fn per_joint(what: &str, given: Option<&[f64]>, dof: usize) -> Result<Option<Vec<f64>>, Error> {
    match given {
        None => Ok(None),
        Some(&[one]) => Ok(Some(vec![one; dof])),
        Some(each) if each.len() == dof => Ok(Some(each.to_vec())),
        Some(each) => Err(Error::Argument(format!(
            "{what} has {} numbers, the arm {dof} joints: give one for all, or one per joint",
            each.len()
        ))),
    }
}

/// Limits on the torques of an arm: looked for with friction that turns round smoothly, verified with friction that jumps.
pub(super) fn torque(
    compiled: &Compiled,
    arm: &Nominal,
    limits: &Limits,
    period: f64,
) -> Box<dyn Clearance> {
    let joints = compiled.model.joints.iter();
    let joints: Vec<String> = joints.map(|joint| joint.name.clone()).collect();
    let jumping = Nominal {
        turn: Vec::new(),
        ..arm.clone()
    };
    let function = |arm: &Nominal| {
        Box::new(InterpretedFunction::new(
            compiled.design_torque(arm),
            joints.len(),
            period,
        ))
    };
    Box::new(TorqueLimits {
        torque: function(arm),
        exact: function(&jumping),
        limits: limits.torque.clone(),
        joints,
    })
}

/// Torque noise: as given, else in proportion to torque limits, else the same for all.
pub(super) fn noise(
    given: Option<&[f64]>,
    limits: &Limits,
    joints: &[String],
) -> Result<Vec<f64>, Error> {
    if let Some(noise) = per_joint("--noise", given, joints.len())? {
        return Ok(noise);
    }
    let is_known = limits.torque.iter().all(|limit| limit.is_finite());
    let noise = |limit: &f64| if is_known { *limit } else { 1.0 };
    Ok(limits.torque.iter().map(noise).collect())
}
