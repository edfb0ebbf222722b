//! What looks like another unit, sign or order than the spec's.

use robot_model::identify::Estimate;
use robot_model::log::Log;
use robot_model_spec::Model;
use robot_model_spec::model::JointKind;

/// Positions beyond this many times their limit are of another unit.
const BEYOND: f64 = 3.0;

/// A joint without limits that turns further than this, rad, in a log.
const FAR: f64 = 30.0;

/// What is left of each joint's torque, from where on the model says nothing of it, percent.
const LITTLE: f64 = 85.0;

/// Revolute joints that go where none goes in radians.
pub(super) fn far_positions(model: &Model, logs: &[Log]) -> Vec<String> {
    let joints = model.joints.iter().enumerate();
    let revolute = joints.filter(|(_, joint)| joint.kind != JointKind::Prismatic);
    let far = revolute.filter_map(|(k, joint)| {
        let samples = logs.iter().flat_map(|log| &log.q[k]);
        let most = samples.map(|q| q.abs()).fold(0.0, f64::max);
        let limit = joint.limits.position;
        let limit = limit.map_or(FAR, |(low, high)| BEYOND * low.abs().max(high.abs()));
        (most > limit).then(|| {
            format!(
                "q{} of joint `{}` reaches {most:.1} rad, which is {:.1} turns: is it in degrees? Logs are in rad",
                k + 1,
                joint.name,
                most / std::f64::consts::TAU
            )
        })
    });
    far.collect()
}

/// A model that explains next to nothing.
pub(super) fn unexplained(estimate: &Estimate) -> Option<&'static str> {
    let all = &estimate.relative_percent;
    let is_nothing = all.iter().all(|percent| *percent > LITTLE);
    is_nothing.then_some(
        "the model explains next to nothing of the torque of any joint; see whether the log has positions in rad and m, torques in N m \
         and N (else `actuator_gain`), signs and order of the spec's joints, and both of the same time",
    )
}
