/// A motor that delivers less than the logged command where that is beyond its limits.
///
/// Delivered is the command between the limits `limit max(0, 1 - max(0, dq sign(command)) / v0)`: `limit` at rest and against
/// the motion, falling to nothing at the speed `v0` where command and motion have one direction. What is logged and not
/// delivered adds to the torque of the model. `share` comes out as 1 where the law holds.
///
/// Identifiable where the log has commands within the limits and beyond them. Both limits have to be given (from the drive's
/// data sheet): with free limits the logged torque would explain itself.
///
/// Confused with `torque_gain`: where most of the large torques are cut, what is delivered is a smaller share of what is logged.
/// Parted by the same motion at half the speed, which stays within the limits.
effect torque_saturation(j) {
    /// Share of the excess that is not delivered.
    linear share >= 0;
    /// Largest torque at rest, N m (N for a prismatic joint).
    shape limit in 1e-3 .. 1e5;
    /// Speed at which no torque is left, rad/s (m/s for a prismatic joint).
    shape v0 in 1e-2 .. 1e5;
    let command = measured_torque(j);
    let forward = max(0, dq(j) * sign(command));
    let most = limit * max(0, 1 - forward / v0);
    torque(j) = share * (command - max(-most, min(most, command)));
}
