// The law without its jump: the viscous part begins at rest, not at `eps`.
effect rokae_continuous(j) {
    /// Dry friction forward, N m.
    linear fc1 >= 0;
    /// Dry friction backward, N m.
    linear fc2 >= 0;
    /// Viscous coefficient, N m s/rad.
    linear fv1;
    /// Coefficient of the square, N m s^2/rad^2.
    linear fv2;
    /// Coefficient of the cube, N m s^3/rad^3.
    linear fv3;
    /// Speed below which dry friction falls to zero, rad/s.
    shape eps in 0.001 .. 0.1;
    let v = dq(j);
    let dry = if v > 0 { fc1 } else { fc2 };
    torque(j) = dry * max(-1, min(1, v / eps)) + fv1 * v + fv2 * v^2 + fv3 * v^3;
}

robot Continuous {
    gravity = [0, 0, -9.81];
    convention = standard_dh;
    joint j: revolute { a = 0; alpha = 0; d = 0; velocity = 180 deg/s; }
    effects { rokae_continuous(eps = 0.01) on j; }
}
