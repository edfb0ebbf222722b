robot Bob {
    coordinates th;
    parameters J: kg*m^2;
    kinetic = J/2*dot(th)^2;
    potential = 0;
    point tip = [0.4*cos(th), 0, 0];
}
