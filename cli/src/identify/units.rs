//! Whether positions of a log are in another unit than the spec's, asked of the torques.

use robot_model::identify::{Estimate, Identify};
use robot_model::log::Log;
use robot_model_spec::Model;
use robot_model_spec::model::JointKind;

use super::fit::Fit;

/// Degrees are asked for where a joint moves further than this, rad: less is a motion of less than three degrees.
const LEAST_RANGE: f64 = 3.0;

/// A model that explains its torques to this, percent, has its unit.
const WELL: f64 = 15.0;

/// By which factor errors have to be less in degrees, over joints.
const FACTOR: f64 = 2.0;

/// Says so where the torques follow positions in degrees far better than in radians. Where nothing bends with positions, as on a lone
/// joint without gravity, no torque can tell.
pub(super) fn degrees(
    form: &dyn Fit,
    identify: &Identify,
    logs: &[Log],
    found: &Estimate,
) -> Option<String> {
    let model = form.model();
    let is_ill = found.relative_percent.iter().any(|percent| *percent > WELL);
    if !is_ill || !logs.iter().any(|log| goes_far(model, log)) {
        return None;
    }
    let logs: Vec<Log> = logs.iter().map(|log| in_degrees(model, log)).collect();
    let plain = Identify {
        bootstrap: 0,
        essential: false,
        instruments: Vec::new(),
        method: robot_model::identify::Method::Wls,
        ..identify.clone()
    };
    let other = form.fit(&plain, &logs).ok()?;
    let falls = other.relative_percent.iter().zip(&found.relative_percent);
    let falls: Vec<f64> = falls
        .map(|(other, found)| (found / other.max(f64::MIN_POSITIVE)).ln())
        .collect();
    let mean = falls.iter().sum::<f64>() / falls.len() as f64;
    let percent = |of: &[f64]| of.iter().copied().fold(0.0, f64::max);
    (mean > FACTOR.ln()).then(|| {
        format!(
            "with positions in degrees the model leaves {:.1} % of the torque of its worst joint, as they are {:.0} %: are they in degrees? \
             Logs are in rad, or as the spec says: `log {{ q = \"q1\": deg, ..; }}`",
            percent(&other.relative_percent),
            percent(&found.relative_percent)
        )
    })
}

fn revolute(model: &Model) -> impl Iterator<Item = usize> + '_ {
    let joints = model.joints.iter().enumerate();
    joints
        .filter(|(_, joint)| joint.kind != JointKind::Prismatic)
        .map(|(k, _)| k)
}

fn goes_far(model: &Model, log: &Log) -> bool {
    revolute(model).any(|joint| {
        let high = log.q[joint]
            .iter()
            .copied()
            .fold(f64::NEG_INFINITY, f64::max);
        let low = log.q[joint].iter().copied().fold(f64::INFINITY, f64::min);
        high - low > LEAST_RANGE
    })
}

fn in_degrees(model: &Model, log: &Log) -> Log {
    let mut log = log.clone();
    for joint in revolute(model) {
        for q in &mut log.q[joint] {
            *q = q.to_radians();
        }
    }
    log
}
