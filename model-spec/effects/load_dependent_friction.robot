/// Dry friction that grows with the load on the transmission.
///
/// `mu * abs(rigid_torque) * sign(dq)`, where `rigid_torque` is what the transmission carries: inertia, Coriolis and gravity
/// torque of the rigid body. Where a rotor's inertia cannot be told from its link's (on a first and often on a second joint), the
/// load has what the links have by the spec's nominal values, and the rotor what is more; without them, or where further parameters are
/// in the sum, the load includes the rotor. `simulate` takes a rotor that parameters name by itself for what it is.
///
/// Identifiable where the load changes much while the direction of motion changes too.
///
/// Confused with `coulomb_friction`: under a load that hardly changes both are a constant against the motion. Parted by poses
/// and accelerations that change the load.
///
/// Confused with `torque_gain`: in motion one way under a load of one sign both are in proportion to the load. Parted by motion
/// in both directions under the same load.
effect load_dependent_friction(j) {
    /// Friction per unit of load.
    linear mu >= 0;
    torque(j) = mu * abs(rigid_torque(j)) * sign(dq(j));
}
