/// A spring between the base and the link that carries part of its weight.
///
/// Anchored at `a` from the joint's axis on the base and at `b` on the link, its length is `L^2 = a^2 + b^2 + 2 a b cos(q -
/// q0)`, and its torque `K (L - l0) dL/dq`. In the unknowns `s = K a b`, `p = K l0 sqrt(a b)` and `apart = (a - b)^2 / (a b)`
/// that is `-s sin(q - q0) + p sin(q - q0) / sqrt(apart + 4 cos((q - q0)/2)^2)`. At `apart = 0` the spring could reach length
/// zero.
///
/// Identifiable from motion over most of a half turn. On a joint with a horizontal axis `s` regroups into the link's first
/// moments: what can be identified there is `p`.
///
/// Confused with `joint_spring`: over a small range of positions both are a straight line. Distinguished by motion over most of
/// a half turn.
///
/// Confused with `torque_offset`: where the spring's torque is largest it hardly changes with the position. Distinguished by
/// motion over most of a half turn.
effect gravity_compensation_spring(j) {
    /// Stiffness times both distances, N m.
    linear s >= 0;
    /// Stiffness times length at rest times the geometric mean of the distances, N m.
    linear p >= 0;
    /// `(a - b)^2 / (a b)`
    shape apart in 0.002 .. 20;
    /// Position at which the spring is longest, rad.
    shape q0 in -3.14 .. 3.14 step 0.314;
    let angle = q(j) - q0;
    torque(j) = -s * sin(angle) + p * sin(angle) / sqrt(apart + 4 * cos(angle / 2)^2);
}
