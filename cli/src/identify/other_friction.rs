//! Friction that is another law of speed than the spec's.

use robot_model::identify::Estimate;

/// A law of less than this share of a joint's torque, percent, is no matter; its part in deviations says enough.
const NOTHING: f64 = 0.3;

pub(super) fn doubt(estimate: &Estimate) -> Option<String> {
    let laws = estimate.other_friction.iter();
    let told = laws.filter(|law| law.percent > NOTHING);
    let told: Vec<String> = told
        .map(|law| {
            let joint = &estimate.joints[law.joint];
            format!("`{joint}` ({:.1} % of its torque)", law.percent)
        })
        .collect();
    (!told.is_empty()).then(|| {
        format!(
            "friction depends on speed differently than the spec says: {}; standard deviations include the bias of the values, and `trace` \
             looks for the law",
            told.join(", ")
        )
    })
}
