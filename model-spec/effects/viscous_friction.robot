/// Friction of lubricated contacts: torque proportional to speed.
///
/// `fv * dq`.
///
/// Identifiable as soon as the joint moves at different speeds.
effect viscous_friction(j) {
    /// Viscous coefficient, N m s/rad (N s/m for a prismatic joint).
    linear fv >= 0;
    torque(j) = fv * dq(j);
}
