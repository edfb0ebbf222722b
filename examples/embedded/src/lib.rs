//! What a controller's firmware would hold: the compiled arm and a control law. No `std`, no allocator.
#![no_std]

use robot_model::{FromParameters, RobotModel, Scalar, State, Vector};

/// The page of `arm.robot`.
#[allow(clippy::pedantic, reason = "derived, not written")]
pub mod page {
    robot_model::include_robot!("arm");
}
pub use page::TwoLinkArm;

/// Standard parameters of one such arm, by name, in SI units; those that are not listed are 0.
pub const MEASURED: [(&str, f64); 8] = [
    ("shoulder.m", 4.0),
    ("shoulder.mx", -0.90),
    ("shoulder.izz", 0.28),
    ("elbow.m", 2.5),
    ("elbow.mx", -0.45),
    ("elbow.izz", 0.12),
    ("shoulder.viscous_friction.fv", 1.5),
    ("elbow.viscous_friction.fv", 0.6),
];

/// That arm.
#[must_use]
pub fn arm() -> TwoLinkArm {
    let standard = TwoLinkArm::STANDARD_PARAMETERS.map(|name| {
        let known = MEASURED.iter().find(|(known, _)| *known == name);
        known.map_or(0.0, |(_, value)| *value)
    });
    TwoLinkArm::from_standard(&standard.into())
}

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
