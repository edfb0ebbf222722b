/// Two wrist joints whose motors are coupled by the gear: the second motor turns with both joints.
///
/// The motor of `k` turns by `q(j) + q(k)`. Its inertia and friction act on both joints; the part from each joint's own motion
/// is in its `motor_inertia` and `viscous_friction`. Symmetric in `j` and `k`.
///
/// Identifiable if both joints move, sometimes alone and sometimes together.
///
/// Confused with `motor_inertia`, `viscous_friction`, `coulomb_friction`: if both joints move in proportion, the coupling looks
/// like an effect of each joint's own motor. Distinguished by joints that move sometimes alone and sometimes together.
effect gear_coupling(j, k) {
    /// Coupling inertia, kg m^2.
    linear ia;
    /// Viscous coefficient of the coupling, N m s/rad.
    linear fv >= 0;
    /// Coulomb torque of the motor that turns with both joints, N m.
    linear fc >= 0;
    torque(j) = ia * ddq(k) + fv * dq(k) + fc * sign(dq(j) + dq(k));
    torque(k) = ia * ddq(j) + fv * dq(j) + fc * sign(dq(j) + dq(k));
}
