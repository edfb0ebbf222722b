/// Two wrist joints whose motors are coupled by the gear: the second motor turns with both joints.
///
/// The motor of `k` turns by `q(j) + q(k)`. Its inertia and friction act on both joints; the part that each joint feels of its
/// own motion is in the joint's own `motor_inertia` and `viscous_friction`. Symmetric in `j` and `k`.
///
/// Identifiable when both joints move, at times alone and at times together.
///
/// Confused with `motor_inertia`, `viscous_friction`, `coulomb_friction`: where both joints move in proportion, each feels what
/// its own motor could do to it. Parted by joints that move at times alone and at times together.
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
