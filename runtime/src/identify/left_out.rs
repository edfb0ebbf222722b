//! Samples of a log that say nothing of a joint's torque.

use super::stack::says_nothing;
use super::turns;
use crate::columns::Arm;
use crate::signal::Prepared;

/// Which samples of a log's motion these are: what is made up in a hole, a torque at its limit that no column knows, a joint that a brake
/// or its dry friction holds, a torque that was not measured.
pub(crate) fn samples(arm: &dyn Arm, log: &Prepared, joint: usize) -> Vec<bool> {
    let count = log.motion.time.len();
    if says_nothing(log).contains(&joint) {
        return vec![true; count];
    }
    let mut left_out = if arm.saturated_joints().contains(&joint) {
        vec![false; count]
    } else {
        log.is_clipped(joint, 0)
    };
    let held = turns::held(arm, log, joint);
    for (is_out, is_held) in left_out.iter_mut().zip(held) {
        *is_out |= is_held;
    }
    for (k, is_out) in left_out.iter_mut().enumerate() {
        *is_out |= log.is_in_hole(k as f64);
    }
    left_out
}
