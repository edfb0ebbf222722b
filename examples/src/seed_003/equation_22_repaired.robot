// Equation (22) as equation (21) has it.
robot Bristles {
    coordinates th;
    parameters J: kg*m^2;
    constants s0 = 2.15 kg*m^2/s^2, s2 = 0.1328 kg*m^2/s, m = 6.615e-4 kg*m^2, xi = 20;
    let s1 = 2*xi*sqrt(s0*m) - s2;
    kinetic = J/2*dot(th)^2;
    potential = 0;
}
