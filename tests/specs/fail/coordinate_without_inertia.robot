// The mass matrix would have a row of zeros, and no torque an acceleration.
robot Wagon {
    coordinates x: m, y: m;
    parameters m: kg, k: N/m;
    kinetic = m/2*dot(x)^2 + m*dot(x)*dot(y);
    potential = k/2*y^2;
}
