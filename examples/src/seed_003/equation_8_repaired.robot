// Equation (8) with a stiffness in N m/rad.
robot Bristles {
    coordinates th;
    parameters J: kg*m^2;
    constants s0 = 2.15 kg*m^2/s^2, s1 = 1.34 kg*m^2/s, s2 = 0.1328 kg*m^2/s, z = 0.1 rad, rate = 1 rad/s, speed = 1 rad/s;
    let friction = s0*z + s1*rate + s2*speed;
    kinetic = J/2*dot(th)^2;
    potential = 0;
}
