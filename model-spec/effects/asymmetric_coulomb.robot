/// Dry friction that differs between the directions of motion.
///
/// `delta * abs(sign(dq))` on top of `fc * sign(dq)`: `fc + delta` forward, `fc - delta` backward.
///
/// Identifiable where the joint moves in both directions, and rests in many samples.
///
/// Confused with `torque_offset`: away from rest both are the same constant. Distinguished by no motion; samples at
/// rest distinguish them.
///
/// Confused with `asymmetric_viscous`: at one speed both are the same constant. Distinguished by several speeds, slow ones
/// among them.
effect asymmetric_coulomb(j) {
    /// Half the difference of the two Coulomb torques, N m (N for a prismatic joint).
    linear delta;
    torque(j) = delta * abs(sign(dq(j)));
}
