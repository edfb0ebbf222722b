// Equation (17) as it is printed: what bends the bristles while the torque rises by `rate`, and equation (18), its share in the torque.
effect deflection(j) {
    /// Stiffness of the bristles, N m/rad.
    linear s0 >= 0;
    /// Breakaway torque, N m.
    shape fs in 0.1 .. 10;
    /// How fast the torque rises, N m/s.
    shape rate in 1e-4 .. 10;
    /// Integral of the position, rad s.
    state way;
    dot(way) = q(j);
    torque(j) = s0 * (q(j) + rate / (2 * fs) * (q(j) * time + way));
}

robot Link {
    gravity = [0, -9.81, 0];
    convention = standard_dh;
    joint th: revolute { a = 210 mm; alpha = 0; d = 0; offset = -90 deg; actuator_gain = 1.3607 Nm/A; }
    link th: fixed { mass = 45 g; com = [-105 mm, 0, 0]; inertia = [0, 0, 0, 1.65375e-4, 0, 1.65375e-4]; }
    effects { deflection(fs = 2.002, rate = 0.01) on th; }
}
