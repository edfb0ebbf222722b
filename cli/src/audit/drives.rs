//! Whether motors move their joints at all: what holds a joint that creeps, and what it takes to stand, is below the largest torque of its
//! motor.

use robot_model_codegen::Compiled;
use robot_model_codegen::expr::Symbol;
use robot_model_codegen::interpreter::Program;
use robot_model_spec::model::Joint;

use super::friction::{Effects, fastest};
use super::workspace::{POSES, descend, pose, workspace};
use super::{Check, Finding, Quantity};
use crate::parameters::Values;
use crate::units::Units;

/// `None` where the spec has no torque limits.
pub(super) fn check(compiled: &Compiled, values: &Values) -> Option<Check> {
    let joints = &compiled.model.joints;
    if joints.iter().all(|joint| joint.limits.torque.is_none()) {
        return None;
    }
    let effects = Effects::new(compiled, values);
    let fastest = fastest(compiled);
    let rest = Rest::new(compiled, values);
    let joints = joints.iter().enumerate();
    let limited = joints.filter_map(|(place, joint)| Some((place, joint, joint.limits.torque?)));
    let findings = limited.flat_map(|(place, joint, most)| {
        let hold = effects.hold(place, &fastest);
        let held = (hold > most).then(|| held(joint, hold, most));
        held.into_iter().chain(rest.beyond(place, joint, most))
    });
    let findings = findings.collect();
    let scope =
        "friction at creeping speed and static torques in the workspace, compared with torque limits"
            .to_owned();
    Some(Check::new("drives", scope, findings))
}

fn held(joint: &Joint, hold: f64, most: f64) -> Finding {
    let (name, unit) = (&joint.name, Units::of(joint.kind).torque);
    let said = format!(
        "joint `{name}` has {hold:.4} {unit} of friction, but its torque limit is {most:.4} {unit}: it cannot move"
    );
    let own = [("friction", hold), ("largest_torque", most)];
    let own = own.map(|(what, value)| Quantity::of(what, name, value, unit));
    (said, own.to_vec())
}

/// The arm at rest under gravity and springs.
struct Rest<'a> {
    torque: Program,
    values: &'a Values,
    workspace: Vec<(f64, f64)>,
    poses: Vec<Vec<f64>>,
    /// Of all joints at these poses.
    torques: Vec<Vec<f64>>,
}

impl<'a> Rest<'a> {
    fn new(compiled: &Compiled, values: &'a Values) -> Self {
        let workspace = workspace(compiled);
        let mut rest = Self {
            torque: compiled.torque_at_rest(),
            values,
            poses: (0..POSES).map(|k| pose(&workspace, k)).collect(),
            workspace,
            torques: Vec::new(),
        };
        rest.torques = rest.poses.iter().map(|pose| rest.torque(pose)).collect();
        rest
    }

    fn torque(&self, pose: &[f64]) -> Vec<f64> {
        self.torque.eval(&|symbol| match symbol {
            Symbol::Q(joint) => pose[joint],
            Symbol::Parameter(k) => self.values.parameters[k],
            Symbol::Shape(k) => self.values.shapes[k],
            _ => 0.0,
        })
    }

    /// Where a joint takes more to stand than its motor has: the most that was found.
    fn beyond(&self, place: usize, joint: &Joint, most: f64) -> Option<Finding> {
        let torques = self.torques.iter().enumerate();
        let (worst, _) =
            torques.max_by(|(_, x), (_, y)| x[place].abs().total_cmp(&y[place].abs()))?;
        let pose = descend(&self.workspace, self.poses[worst].clone(), &|pose| {
            -self.torque(pose)[place].abs()
        });
        let torque = self.torque(&pose)[place].abs();
        (torque > most).then(|| {
            let (name, unit) = (&joint.name, Units::of(joint.kind).torque);
            let at: Vec<String> = pose.iter().map(|q| format!("{q:.4}")).collect();
            let said = format!(
                "joint `{name}` needs {torque:.4} {unit} at rest at q = [{}], but its torque limit is {most:.4} {unit}: it cannot hold the arm there",
                at.join(", ")
            );
            let own = [("at_rest", torque), ("largest_torque", most)];
            let own = own.map(|(what, value)| Quantity::of(what, name, value, unit));
            (said, own.to_vec())
        })
    }
}
