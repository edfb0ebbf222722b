// A planar arm whose effects remember, or read more of a log than positions: the standard ones, and one of its own.
robot Memory {
    gravity = [0, -9.81, 0];
    convention = standard_dh;

    joint shoulder: revolute { a = 0.4; alpha = 0; d = 0; actuator_gain = 1.5; }
    joint elbow:    revolute { a = 0.3; alpha = 0; d = 0; }

    effects {
        lugre_presliding(d = 0.01, vs = 0.1, rise = 0.5) on shoulder;
        cable_hysteresis(width = 0.3, n = 1.5) on shoulder;
        dahl(d = 0.05) on elbow;
        temperature_viscous(beta = 0.03) on all;
        torque_saturation(limit = 3, v0 = 4) on elbow;
        damper on elbow;
        copper_loss on all;
    }
}

/// A Maxwell element: a spring in series with a damper, between the link and the one before it.
///
/// `k z` with `dz/dt = dq - z / relaxation`.
effect damper(j) {
    /// Stiffness, N m/rad.
    linear k >= 0;
    /// Time in which the spring comes to rest, s.
    shape relaxation in 0.01 .. 10;
    /// Angle of the spring, rad.
    state z;
    dot(z) = dq(j) - z / relaxation;
    torque(j) = k * z;
}

/// Torque that is lost as the motor warms up: the magnet weakens with the power in the winding.
effect copper_loss(j) {
    /// Current of the joint's motor, A.
    input current(j);
    /// Loss, N m/A^2.
    linear loss;
    torque(j) = loss * current(j) * abs(current(j));
}
