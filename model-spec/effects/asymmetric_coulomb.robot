/// Dry friction that differs between the directions of motion.
///
/// `delta * abs(sign(dq))` on top of `fc * sign(dq)`: `fc + delta` forward, `fc - delta` backward. Away from rest it is the
/// same as an offset of the torque channel; samples at rest tell them apart.
effect asymmetric_coulomb(j) {
    /// Half the difference of the two Coulomb torques, N m (N for a prismatic joint).
    linear delta;
    torque(j) = delta * abs(sign(dq(j)));
}
