/// A motor that delivers less than a logged command beyond its limits.
///
/// Delivered is the command between the limits `limit max(0, 1 - max(0, dq sign(command)) / v0)`: `limit` at rest and against
/// the motion, falling to zero at the speed `v0` if command and motion have the same direction. The logged torque that is not
/// delivered adds to the torque of the model. `share` is 1 if the law holds.
///
/// Identifiable if the log has commands within and beyond the limits. Both limits must be given (from the drive's data sheet):
/// with free limits the logged torque would explain itself.
///
/// Confused with `torque_gain`: if most of the large torques are cut, the delivered torque is a smaller share of the logged
/// one. Distinguished by the same motion at half the speed, which stays within the limits.
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
