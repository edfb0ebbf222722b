// The same link with the friction of equations (8) to (10). The standard effect of that name has ranges for contacts that give by less
// than a tenth of a radian; the paper's gives by 0.27 rad, with a Stribeck speed and a rise beyond those ranges too.
effect soft_bristles(j) {
    /// Torque of sliding, N m.
    linear fc >= 0;
    /// Damping of the bristles, N m s/rad.
    linear s1 >= 0;
    /// Deflection at which the bristles slide, `fc / s0`, rad.
    shape d in 1e-4 .. 2;
    /// Stribeck speed, rad/s.
    shape vs in 0.05 .. 5;
    /// Breakaway torque over that of sliding, less one.
    shape rise in 0 .. 5 step 0.5;
    /// Deflection of the bristles over that of sliding.
    state z;
    let g = 1 + rise * exp(-(dq(j)/vs)^2);
    dot(z) = (dq(j) - abs(dq(j)) * z / g) / d;
    torque(j) = fc * z + s1 * d * dot(z);
}

robot Link {
    gravity = [0, -9.81, 0];
    convention = standard_dh;
    joint th: revolute {
        a = 210 mm; alpha = 0; d = 0;
        offset = -90 deg;
        position = -150 deg .. 130 deg;
        velocity = 498 deg/s;
        torque = 1.0885 Nm;
        actuator_gain = 1.3607 Nm/A;
    }
    link th: fixed { mass = 45 g; com = [-105 mm, 0, 0]; inertia = [0, 0, 0, 1.65375e-4, 0, 1.65375e-4]; }
    effects { soft_bristles on th; viscous_friction on th; }
}
