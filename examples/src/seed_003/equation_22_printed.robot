// Equation (22) as it is printed; its m is the inertia of equation (21).
robot Bristles {
    coordinates th;
    parameters J: kg*m^2;
    constants s0 = 2.15 kg*m^2/s^2, s2 = 0.1328 kg*m^2/s, m = 6.615e-4 kg*m^2, xi = 20;
    let s1 = 2*xi*m*sqrt(s0/m - s2);
    kinetic = J/2*dot(th)^2;
    potential = 0;
}
