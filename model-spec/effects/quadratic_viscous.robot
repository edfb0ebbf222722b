/// Churning and other turbulent losses: torque grows with the square of the speed.
///
/// `c * dq * abs(dq)`.
///
/// Identifiable where high speeds are reached; at low speed it hides in viscous friction.
///
/// Confused with `viscous_friction`: over a narrow range of speeds both are a straight line. Distinguished by speeds from slow
/// ones to the limit.
effect quadratic_viscous(j) {
    /// Coefficient, N m s^2/rad^2 (N s^2/m^2 for a prismatic joint).
    linear c >= 0;
    torque(j) = c * dq(j) * abs(dq(j));
}
