/// A constant in the torque channel: the current sensor's zero, or a preload.
///
/// `offset`.
///
/// Identifiable where gravity's torque on the joint changes with the pose. Not distinguishable from gravity on a joint that is
/// loaded by a constant gravity torque.
effect torque_offset(j) {
    /// Offset, N m (N for a prismatic joint).
    linear offset;
    torque(j) = offset;
}
