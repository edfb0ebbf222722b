/// Gear loss in proportion to the transmitted power.
///
/// With an efficiency `eta` the motor supplies `load / eta` where it drives the load and `eta load` where the load drives it:
/// `(1/eta - 1) load` and `(eta - 1) load` on top of the load, which is the torque of the rigid body. Both factors are separate
/// unknowns, `driving = 1/eta - 1` and `driven = 1 - eta`; a worm gear's differ much.
///
/// Identifiable if the load is large in both directions of power, when lifted and lowered, and if part of the load is known:
/// links that are `fixed`, or links that also load other joints. On a single joint with unknown links a scaled load with other
/// factors gives the same torque.
///
/// Confused with `load_dependent_friction`: with `driving = driven` it is the same. Distinguished by no motion if the two
/// losses are equal, and else by loads that are lifted and lowered.
///
/// Confused with `torque_gain`: where the load is only lifted both are in proportion to it, and `driven = -driving` would be a
/// gain. Distinguished by no motion but by the signs, as a gear that is driven loses as well: loads have to be lifted and
/// lowered.
effect transmission_efficiency(j) {
    /// Loss per unit of load where the motor drives.
    linear driving >= 0;
    /// Loss per unit of load where the motor is driven.
    linear driven >= 0;
    let load = rigid_torque(j);
    torque(j) = if load * dq(j) > 0 { driving * load } else { -driven * load };
}
