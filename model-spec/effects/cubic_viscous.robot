/// The odd correction of viscous friction: drag that bends up, or down where lubricant thins, at high speed.
///
/// `c * dq^3`. Identifiable where high speeds are reached. Free in sign: together with viscous friction, a negative value
/// describes friction that levels off.
effect cubic_viscous(j) {
    /// Coefficient, N m s^3/rad^3 (N s^3/m^3 for a prismatic joint).
    linear c;
    torque(j) = c * dq(j)^3;
}
