/// Friction of a ROKAE arm's joints: dry friction that differs between the directions, and a cubic polynomial of the speed.
///
/// Below the speed `eps` a straight line to zero, `fc dq / eps`; above it `fc sign(dq) + fv1 dq + fv2 dq^2 + fv3 dq^3`, with
/// `fc = fc1` forward and `fc = fc2` backward. The polynomial begins at `eps` with a jump, as in the publication. `fv2` is even
/// in the speed: it differs between the directions. With `fv3 < 0` friction falls at high speed and may change its sign: do not
/// use the law beyond the identified speeds. Use it instead of Coulomb and viscous friction.
///
/// Identifiable from motion in both directions at speeds from slow ones to the limit.
///
/// Confused with `coulomb_friction`, `asymmetric_coulomb`, `viscous_friction`, `cubic_viscous`: above `eps` it is a sum of
/// these, and of the square of the speed. Distinguished by no motion: declare the sum or its parts, not both.
effect rokae(j) {
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
    torque(j) = if abs(v) < eps { dry * v / eps } else { dry * sign(v) + fv1 * v + fv2 * v^2 + fv3 * v^3 };
}
