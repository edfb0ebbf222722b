// The shoulder of a PUMA 600 with all other joints locked: equation (2.3) divided by beta,
//     ddth / beta - alpha / beta sin(th) + f(dth) / beta = u,
// th from the upright; u is a voltage across a known resistance, so that units are those of the measurement.

/// Equation (6.1).
effect linear_law(j) {
    linear c >= 0;
    torque(j) = c * dq(j);
}

/// Equation (6.2).
effect quadratic_law(j) {
    linear c1 >= 0;
    linear c2 >= 0;
    torque(j) = c1 * dq(j) + c2 * dq(j) * abs(dq(j));
}

/// Equation (6.3): a constant for each direction.
effect direction_law(j) {
    linear c1 >= 0;
    linear c2 >= 0;
    torque(j) = if dq(j) > 0 { c1 * dq(j) } else { c2 * dq(j) };
}

robot PumaShoulder {
    coordinates th;
    /// m g r / J, 1/s^2.
    parameters alpha;
    /// 1 / J.
    parameters beta;
    kinetic = dot(th)^2/(2*beta);
    potential = alpha/beta*cos(th);
}
