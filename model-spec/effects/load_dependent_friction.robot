/// Dry friction that grows with the load on the transmission.
///
/// `mu * abs(rigid_torque) * sign(dq)`, where `rigid_torque` is the load of the transmission: inertia, Coriolis and gravity
/// torque of the rigid body. If a rotor's inertia cannot be separated from its link's (on a first and often on a second joint),
/// the load uses the spec's nominal values for the links, and the remainder is the rotor; without nominal values, or if the sum
/// has further parameters, the load includes the rotor. `simulate` uses a rotor's own value, if given.
///
/// Identifiable if both the load and the direction of motion change.
///
/// Confused with `coulomb_friction`: under a load that hardly changes both are a constant against the motion. Distinguished by
/// poses and accelerations that change the load.
///
/// Confused with `torque_gain`: in motion in one direction under a load of one sign both are proportional to the load.
/// Distinguished by motion in both directions under the same load.
effect load_dependent_friction(j) {
    /// Friction per unit of load.
    linear mu >= 0;
    torque(j) = mu * abs(rigid_torque(j)) * sign(dq(j));
}
