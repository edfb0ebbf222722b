/// The odd correction of viscous friction: drag that bends up, or down where lubricant thins, at high speed.
///
/// `c * dq^3`. Free in sign: together with viscous friction, a negative value describes friction that levels off.
///
/// Identifiable where high speeds are reached.
///
/// Confused with `quadratic_viscous`, `viscous_friction`: over a narrow range of speeds each is a straight line. Distinguished
/// by speeds from slow ones to the limit.
effect cubic_viscous(j) {
    /// Coefficient, N m s^3/rad^3 (N s^3/m^3 for a prismatic joint).
    linear c;
    torque(j) = c * dq(j)^3;
}
