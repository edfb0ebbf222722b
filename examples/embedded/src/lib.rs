//! What a controller's firmware would hold: one compiled arm, its numbers in its equations, and a control law. No `std`, no allocator.
#![no_std]

use robot_model::{RobotModel, Scalar, State, Vector};

/// The page of `arm.robot` with the values of `arm.json`: a type of no size.
#[allow(clippy::pedantic, reason = "derived, not written")]
pub mod page {
    robot_model::include_robot!("arm");
}
pub use page::TwoLinkArm;

/// Computed torque: `tau = M (ddq_r + kd (dq_r - dq) + kp (q_r - q)) + bias + friction`, N m.
///
/// With an exact model the error obeys `ddq + kd dq + kp q = 0`; `kd = 2 sqrt(kp)` damps it critically.
#[must_use]
pub fn computed_torque(
    arm: &TwoLinkArm,
    now: &State<2>,
    reference: &State<2>,
    kp: f64,
) -> Vector<2> {
    let kd = 2.0 * Scalar::sqrt(kp);
    let ddq = reference.ddq + kd * (reference.dq - now.dq) + kp * (reference.q - now.q);
    arm.inverse_dynamics(&now.q, &now.dq, &ddq)
}
