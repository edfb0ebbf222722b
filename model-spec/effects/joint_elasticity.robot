/// A spring between motor and link: a harmonic drive, a belt, a long shaft.
///
/// The encoder is on the motor's side. The link lags by the load of the transmission divided by the stiffness; its velocity and
/// acceleration follow. Motor inertia and friction stay on the motor's side: declare `motor_inertia` with it. The logged torque
/// deflects the spring, so its noise is in the prediction.
///
/// Identifiable if the load changes so much that the link lags by many encoder steps, and if torque and positions are filtered
/// alike.
///
/// Confused with `time_delay`: in fast motion both shift the torque in time against the position. Distinguished by slow motion
/// under large loads, which deflects a spring, while a delay has no effect.
effect joint_elasticity(j) {
    /// N m/rad (N/m for a prismatic joint).
    shape stiffness in 0.1 .. 1000000;
    position(j) = -rigid_torque(j) / stiffness;
}
