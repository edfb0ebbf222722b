/// Dry friction that changes with the joint's position: an eccentric gear, a seal that is not round.
///
/// `(a cos(k q) + b sin(k q)) sign(dq)`, on top of Coulomb friction: amplitude `sqrt(a^2 + b^2)`. The torque opposes the
/// motion, unlike a ripple, which keeps its sign when the motion reverses.
///
/// Identifiable from slow motion in both directions over several periods.
///
/// Confused with `torque_ripple`: in motion in one direction both are a wave over the position. Distinguished by the same path
/// in both directions.
///
/// Confused with `load_dependent_friction`: in slow motion of one joint the load is a function of its position. Distinguished
/// by accelerations, and by poses of the other joints that change the load.
effect position_dependent_friction(j) {
    /// Amplitude of the cosine, N m (N for a prismatic joint).
    linear a;
    /// Amplitude of the sine, N m (N for a prismatic joint).
    linear b;
    /// Periods per revolution (rad per m for a prismatic joint).
    shape k in 1 .. 20 step 0.25;
    torque(j) = (a * cos(k * q(j)) + b * sin(k * q(j))) * sign(dq(j));
}
