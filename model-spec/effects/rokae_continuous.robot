/// The friction of `rokae` without its jump: dry friction that differs between the directions, and a cubic polynomial of the
/// speed from rest on.
///
/// `fc min(|dq| / eps, 1) sign(dq) + fv1 dq + fv2 dq^2 + fv3 dq^3`, with `fc = fc1` forward and `fc = fc2` backward. `rokae` as
/// published leaves the polynomial out below the speed `eps`, so its torque jumps there; here it begins at rest. `fv2` is even
/// in the speed: it differs between the directions. With `fv3 < 0` friction falls at high speed and may change its sign: do not
/// use the law beyond the identified speeds. Use it instead of Coulomb and viscous friction.
///
/// Identifiable from motion in both directions at speeds from slow ones to the limit.
///
/// Confused with `rokae`: above `eps` both are the same, and below it they differ by less than the variation of dry friction.
/// Distinguished by no motion that is worth the effort: declare one of them.
effect rokae_continuous(j) {
    /// Dry friction forward, N m (N for a prismatic joint).
    linear fc1 >= 0;
    /// Dry friction backward, N m (N for a prismatic joint).
    linear fc2 >= 0;
    /// Viscous coefficient, N m s/rad (N s/m for a prismatic joint).
    linear fv1;
    /// Coefficient of the square, N m s^2/rad^2 (N s^2/m^2 for a prismatic joint).
    linear fv2;
    /// Coefficient of the cube, N m s^3/rad^3 (N s^3/m^3 for a prismatic joint).
    linear fv3;
    /// Speed below which dry friction falls to zero, rad/s (m/s for a prismatic joint).
    shape eps in 0.001 .. 0.1;
    let v = dq(j);
    let dry = if v > 0 { fc1 } else { fc2 };
    torque(j) = dry * max(-1, min(1, v / eps)) + fv1 * v + fv2 * v^2 + fv3 * v^3;
}
