/// Torque that repeats with the joint's position: cogging of the motor, mesh of the gear.
///
/// `a * cos(k q) + b * sin(k q)`: amplitude `sqrt(a^2 + b^2)`.
///
/// Identifiable from slow motion over several periods, sampled several times a period.
///
/// Confused with `joint_spring`: over a small part of a period both are a straight line. Distinguished by motion over several
/// periods.
effect torque_ripple(j) {
    /// Amplitude of the cosine, N m (N for a prismatic joint).
    linear a;
    /// Amplitude of the sine, N m (N for a prismatic joint).
    linear b;
    /// Periods per revolution (rad per m for a prismatic joint).
    shape k in 2 .. 60 step 0.25;
    torque(j) = a * cos(k * q(j)) + b * sin(k * q(j));
}
