//! Where an arm may stand, and looking for the worst place.

use robot_model_codegen::Compiled;
use robot_model_spec::model::JointKind;

/// Poses that are looked at.
pub(super) const POSES: usize = 2000;

/// Range of a joint without position limits: all angles, or so many meters either way.
const ANGLE: f64 = std::f64::consts::PI;
const SLIDE: f64 = 1.0;

/// Part of a range at which a search ends.
const FINE: f64 = 1e-5;

/// Ranges of the joints.
pub(super) fn workspace(compiled: &Compiled) -> Vec<(f64, f64)> {
    let joints = compiled.model.joints.iter();
    let range = joints.map(|joint| {
        let all = match joint.kind {
            JointKind::Prismatic => SLIDE,
            JointKind::Revolute => ANGLE,
        };
        joint.limits.position.unwrap_or((-all, all))
    });
    range.collect()
}

/// Poses that fill the workspace evenly: Halton's sequence.
pub(super) fn pose(workspace: &[(f64, f64)], number: usize) -> Vec<f64> {
    let mut primes = (2_usize..).filter(|n| (2..*n).all(|k| !n.is_multiple_of(k)));
    let place = |&(low, high): &(f64, f64)| {
        let base = primes.next().unwrap_or(2);
        let (mut rest, mut share, mut sum) = (number + 1, 1.0, 0.0);
        while rest > 0 {
            share /= base as f64;
            sum += share * (rest % base) as f64;
            rest /= base;
        }
        low + sum * (high - low)
    };
    workspace.iter().map(place).collect()
}

/// The pose with the least value that is found from `pose` on: one joint after the other, in steps that become smaller.
pub(super) fn descend(
    workspace: &[(f64, f64)],
    mut pose: Vec<f64>,
    value: &dyn Fn(&[f64]) -> f64,
) -> Vec<f64> {
    let mut least = value(&pose);
    let mut step = 0.1;
    while step > FINE {
        let before = least;
        for (joint, &(low, high)) in workspace.iter().enumerate() {
            for way in [-1.0, 1.0] {
                let mut trial = pose.clone();
                trial[joint] = (pose[joint] + way * step * (high - low)).clamp(low, high);
                let value = value(&trial);
                if value < least {
                    (least, pose) = (value, trial);
                }
            }
        }
        // No number is lower than none.
        if least.total_cmp(&before).is_ge() {
            step *= 0.5;
        }
    }
    pose
}
