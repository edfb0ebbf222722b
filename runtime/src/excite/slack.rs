//! What limits have left along a motion, and the barrier of those that are no straight lines in the coefficients.

use super::clearance::Clearance;
use super::function::Function;
use crate::motion::Kinematics;

/// The smaller one; what is no number is none that is kept.
pub(super) fn lesser(least: f64, slack: f64) -> f64 {
    if slack.is_nan() {
        f64::NEG_INFINITY
    } else {
        least.min(slack)
    }
}

/// Slacks of a clearance at every instant of a motion; `function` is the clearance's, smooth or exact.
pub(super) fn each_slack(
    clearance: &dyn Clearance,
    function: &dyn Function,
    motion: &Kinematics,
    tell: &mut dyn FnMut(usize, f64),
) {
    let values = function.values(motion);
    let samples = values.first().map_or(0, Vec::len);
    for s in 0..samples {
        let now: Vec<f64> = values.iter().map(|output| output[s]).collect();
        clearance.slacks(&now, &mut |which, slack, _| tell(which, slack));
    }
}

/// `-weight * sum of ln(slack - reserve)`, and its slopes by the motion.
pub(super) fn barrier(
    clearance: &dyn Clearance,
    reserve: f64,
    motion: &Kinematics,
    weight: f64,
) -> Option<(f64, Kinematics)> {
    let function = clearance.function();
    let values = function.values(motion);
    let samples = values.first().map_or(0, Vec::len);
    let mut weights = vec![vec![0.0; samples]; values.len()];
    let (mut sum, mut is_kept) = (0.0, true);
    for s in 0..samples {
        let now: Vec<f64> = values.iter().map(|output| output[s]).collect();
        clearance.slacks(&now, &mut |_, slack, slopes| {
            let slack = slack - reserve;
            is_kept &= slack > 0.0;
            sum -= weight * slack.ln();
            for &(output, slope) in slopes {
                weights[output][s] -= weight * slope / slack;
            }
        });
    }
    is_kept.then(|| (sum, function.pullback(motion, &weights)))
}
