/// Viscous friction but for a hundred-millionth.
effect nearly_viscous(j) {
    linear f;
    torque(j) = f * (dq(j) + 0.00000001 * dq(j)^3 / (1 + dq(j)^2));
}
