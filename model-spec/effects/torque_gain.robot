/// A torque channel with a wrong scale: the torque constant, or the gear ratio, is not what was assumed.
///
/// Logged is `gain` times the true torque: `excess load` on top of the load, which is the torque of the rigid body, with `gain
/// = 1 + excess`. Friction is scaled as well, which its own coefficients absorb.
///
/// Identifiable if part of the load is known: links that are `fixed`, or links that also load other joints.
effect torque_gain(j) {
    /// Gain less one.
    linear excess;
    torque(j) = excess * rigid_torque(j);
}
