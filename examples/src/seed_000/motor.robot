// The shoulder with its motor, driven by the voltage of equation (5.2): the back-EMF brakes as friction does.

/// Equation (6.3): a constant for each direction.
effect direction_law(j) {
    linear c1 >= 0;
    linear c2 >= 0;
    torque(j) = if dq(j) > 0 { c1 * dq(j) } else { c2 * dq(j) };
}

/// The voltage that a turning motor makes.
effect back_emf(j) {
    linear k >= 0;
    torque(j) = k * dq(j);
}

robot PumaShoulder {
    coordinates th;
    /// m g r / J, 1/s^2.
    parameters alpha;
    /// 1 / J.
    parameters beta;
    kinetic = dot(th)^2/(2*beta);
    potential = alpha/beta*cos(th);
    effects { direction_law on th; back_emf on th; }
}
