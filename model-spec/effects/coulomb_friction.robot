/// Dry friction: a constant torque against the motion.
///
/// `fc * sign(dq)`.
///
/// Identifiable as soon as the joint moves in both directions.
///
/// Confused with `viscous_friction`: at one speed both are a constant against the motion. Distinguished by several speeds.
///
/// Confused with `torque_offset`: in motion in one direction both are the same constant. Distinguished by motion in both
/// directions.
effect coulomb_friction(j) {
    /// Coulomb torque, N m (N for a prismatic joint).
    linear fc >= 0;
    torque(j) = fc * sign(dq(j));
}
