// No mass makes it positive.
robot Wheel {
    coordinates th, ph;
    parameters J: kg*m^2, I: kg*m^2;
    kinetic = -J/2*dot(th)^2*cos(ph)^2 + I/2*dot(ph)^2;
    potential = 0;
}
