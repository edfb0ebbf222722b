//! Rows where a torque stands at its limit.
//!
//! A drive that gives no more than its limit, or a recorder that shows no more, logs another torque than that which moved the arm. Such
//! samples say nothing of a model's torque, so rows of that joint which the shared filter spreads them over are left out; rows of other
//! joints stay. Joints of [`Arm::saturated_joints`] keep them all: their columns say what the limit took.

use super::stack::{JointRows, Stack};
use crate::columns::Arm;
use crate::signal::Prepared;

/// Notes which rows of a stack of the logs are of clipped torque, and makes them zero.
pub(super) fn leave_out(stack: &mut Stack, arm: &dyn Arm, logs: &[Prepared]) {
    stack.clipped = vec![Vec::new(); stack.dof()];
    let joints = (0..arm.dof()).filter(|joint| !arm.saturated_joints().contains(joint));
    for joint in joints {
        for (number, log) in logs.iter().enumerate() {
            let start = stack.segments[number].start;
            let is_clipped = log.is_clipped(joint, log.shared.border());
            stack.clipped[joint].extend(rows_at(start, log, &is_clipped));
        }
    }
    clear_again(stack);
}

/// The same rows once more, and those of joints that friction holds, of a stack that has got columns since.
pub(super) fn clear_again(stack: &mut Stack) {
    clear_rows(&mut stack.joints, &stack.clipped);
    clear_rows(&mut stack.joints, &stack.held);
}

/// Makes rows of joints zero.
pub(super) fn clear_rows(joints: &mut [JointRows], rows: &[Vec<usize>]) {
    for (joint, rows) in joints.iter_mut().zip(rows) {
        for &row in rows {
            joint.clear(row..row + 1);
        }
    }
}

/// Rows of a log, which begin with `start`, at samples of its motion for which that is so.
pub(super) fn rows_at(start: usize, log: &Prepared, is_so: &[bool]) -> Vec<usize> {
    let kept = log.shared.kept(is_so.len()).enumerate();
    kept.filter(|&(_, k)| is_so[k])
        .map(|(row, _)| start + row)
        .collect()
}
