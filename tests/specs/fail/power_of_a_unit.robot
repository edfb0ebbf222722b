// The power of a unit is a whole number.
robot Plate {
    coordinates x: m;
    parameters m: kg;
    constants A = 3 m^0.5, B = 2 m^2^2;
    kinetic = m/2*dot(x)^2;
    potential = 0;
}
