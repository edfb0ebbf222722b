// A pendulum on a cart: the cart runs along x on a rail, the pendulum turns about the horizontal y.
robot Slider {
    gravity = [0, 0, -9.81];
    convention = origin;

    joint rail: prismatic {
        xyz = [0, 0, 0.8];
        axis = [1, 0, 0];
        position = -600 mm .. 600 mm;
        velocity = 1.5 m/s;
        torque = 200 N;
        actuator_gain = 35.15;     // N per V of the drive's set point
        link = cart;
    }
    joint pivot: revolute {
        xyz = [0, 0, 120 mm];
        axis = [0, -2, 0];         // any length: only the direction counts
        position = -pi .. pi;
        link = pendulum;
    }

    link cart: fixed { mass = 4.2; com = [0, 0, 40 mm]; inertia = [0.02, 0, 0, 0.03, 0, 0.03]; }
    link pendulum { mass = 350 g; com = [0, 0, -0.3]; inertia = [0.01, 0, 0, 0.01, 0, 1e-4]; }

    effects {
        viscous_friction on all;
        coulomb_friction on rail;
        asymmetric_coulomb on rail;
        stribeck(vs = 20 mm/s) on rail;
        cable_drag(q0 = -0.1) on rail;
    }
}

/// The cable of the cart is dragged along the rail behind `q0`.
///
/// `c * (q - q0) * abs(dq)`
effect cable_drag(j) {
    /// Drag, N s/m^2.
    linear c;
    /// Where the cable begins, m.
    shape q0 in -0.5 .. 0.5 step 0.1;
    torque(j) = c * (q(j) - q0) * abs(dq(j));
}
