/// Dry friction: a constant torque against the motion.
///
/// `fc * sign(dq)`. Identifiable as soon as the joint moves in both directions.
effect coulomb_friction(j) {
    /// Coulomb torque, N m (N for a prismatic joint).
    linear fc >= 0;
    torque(j) = fc * sign(dq(j));
}
