//! Accelerations that are noise of encoders.

use robot_model::identify::{Estimate, Form, Method};
use robot_model::log::Log;
use robot_model::signal::{acceleration_noise, prepare};
use robot_model_spec::Model;

/// Shares of an acceleration's power from where on they are told: inertias are too small by as much, which is several times what logs leave
/// open elsewhere.
const MUCH: f64 = 0.1;

/// Joints whose accelerations are noise to a large part in the best of all logs, but for those that `rest`.
pub(super) fn doubt(
    estimate: &Estimate,
    model: &Model,
    logs: &[Log],
    resting: &[&str],
) -> Option<String> {
    // Instruments have none of that noise, and the filtered form no acceleration.
    if estimate.form != Form::Acceleration || estimate.method == Method::Instrumental {
        return None;
    }
    let mut least = vec![f64::INFINITY; model.joints.len()];
    for log in logs {
        let prepared = prepare(log, &estimate.bands).ok()?;
        let shares = acceleration_noise(&prepared, &estimate.bands)?;
        for (least, share) in least.iter_mut().zip(shares) {
            *least = least.min(share);
        }
    }
    let joints = model.joints.iter().zip(least);
    let noisy = joints.filter(|(joint, share)| {
        *share > MUCH && share.is_finite() && !resting.contains(&joint.name.as_str())
    });
    let noisy: Vec<String> = noisy
        .map(|(joint, share)| format!("`{}` {:.0} %", joint.name, 100.0 * share))
        .collect();
    (!noisy.is_empty()).then(|| {
        format!(
            "accelerations are largely position noise, as from a coarse encoder (share of their power within the filters: {}): inertias are \
             too small by about as much; use `--form filtered` or `--method iv`, or a faster motion",
            noisy.join(", ")
        )
    })
}
