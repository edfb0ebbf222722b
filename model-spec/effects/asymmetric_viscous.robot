/// Viscous friction that differs between the directions of motion.
///
/// `delta * abs(dq)` on top of `fv * dq`: `fv + delta` forward, `fv - delta` backward.
///
/// Identifiable from motion at several speeds in both directions.
///
/// Confused with `torque_offset`: at one speed both are the same constant. Distinguished by several speeds, slow ones among
/// them.
effect asymmetric_viscous(j) {
    /// Half the difference of the two viscous coefficients, N m s/rad (N s/m for a prismatic joint).
    linear delta;
    torque(j) = delta * abs(dq(j));
}
