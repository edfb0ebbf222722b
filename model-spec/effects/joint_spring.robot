/// A linear spring between a link and the previous one.
///
/// `k * (q - q0)`, written `k * q + t0` so that it is linear in both: the rest position is `q0 = -t0/k`.
///
/// Identifiable from motion over a wide range; `t0` is not distinguishable from a torque offset.
///
/// Confused with `torque_offset`: `t0` is one. Distinguished by no motion for `t0`; for `k` by motion over a wide range.
effect joint_spring(j) {
    /// Stiffness, N m/rad (N/m for a prismatic joint).
    linear k >= 0;
    /// Torque at `q = 0`, N m (N for a prismatic joint).
    linear t0;
    torque(j) = k * q(j) + t0;
}
