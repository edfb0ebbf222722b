/// Dry friction that grows with the load on the transmission.
///
/// `mu * abs(rigid_torque) * sign(dq)`, where `rigid_torque` is what the transmission carries: inertia, Coriolis and gravity
/// torque of the rigid body. Identifiable where the load changes much while the direction of motion changes too. Where a
/// rotor's inertia cannot be told from its link's (on the first joint, say), the load includes that of the rotor.
effect load_dependent_friction(j) {
    /// Friction per unit of load.
    linear mu >= 0;
    torque(j) = mu * abs(rigid_torque(j)) * sign(dq(j));
}
