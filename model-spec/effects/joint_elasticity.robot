/// A spring between motor and link: a harmonic drive, a belt, a long shaft.
///
/// The encoder is on the motor's side. The link stands behind by what the transmission carries over the stiffness; its velocity
/// and acceleration follow. Motor inertia and friction stay on the motor's side: declare `motor_inertia` with it. The spring is
/// bent by the logged torque, so its noise is in the prediction.
///
/// Identifiable where the load changes so fast that the link falls behind by many encoder steps, and where torque and positions
/// are not filtered apart.
///
/// Confused with `time_delay`: in fast motion both put the torque out of step with the position. Parted by slow motion under
/// large loads, in which a spring is bent and a delay is nothing.
effect joint_elasticity(j) {
    /// N m/rad (N/m for a prismatic joint).
    shape stiffness in 0.1 .. 1000000;
    position(j) = -rigid_torque(j) / stiffness;
}
