// Powers behind a unit are the unit's: 2 m^2 are two square meters. Exponents may be made of numbers.
robot Units {
    coordinates x: m, th;
    parameters m: kg, J: kg*m^2, c: N*m;
    constants A = 3 m^2, k = 5 N/m^3, inch = 25.4 mm, side = 20 mm^2, slow = 4 s^-2;
    let half = 1/2;
    kinetic = m/2*dot(x)^(4/2) + J/2*dot(th)^(1/half);
    potential = k*A/2*x^2 + k*side*inch^-1*x^(3/1) + slow*J*th + c*cos(th);
    effects { patch on x; }
}

/// Friction of a wetted patch of 2 mm^2.
effect patch(j) {
    /// Drag of an area, N s/m^3.
    linear c >= 0;
    torque(j) = c * 2 mm^2 * dq(j);
}
