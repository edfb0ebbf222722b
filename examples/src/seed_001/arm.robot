// Two links that swing in a vertical plane, by their energies: q1 from the vertical that hangs down, q2 relative to the first link.
// Values are those of Table 2; the seven unknowns show in five sums of products.
robot PneumaticArm {
    coordinates q1, q2;
    /// Mass.
    parameters m1 = 5.914 kg, m2 = 3.437 kg;
    /// Length of the first link.
    parameters l1 = 0.615 m;
    /// From the joint to the center of mass.
    parameters c1 = 0.293 m, c2 = 0.19 m;
    /// Inertia about the center of mass.
    parameters I1 = 0.357 kg*m^2, I2 = 0.013 kg*m^2;
    constants g = 9.81 m/s^2;

    let x1 = c1*sin(q1);
    let y1 = -c1*cos(q1);
    let x2 = l1*sin(q1) + c2*sin(q1 + q2);
    let y2 = -l1*cos(q1) - c2*cos(q1 + q2);
    kinetic = m1/2*(dot(x1)^2 + dot(y1)^2) + I1/2*dot(q1)^2 + m2/2*(dot(x2)^2 + dot(y2)^2) + I2/2*(dot(q1) + dot(q2))^2;
    potential = g*(m1*y1 + m2*y2);
    effects { viscous_friction on all; coulomb_friction on all; }
}
