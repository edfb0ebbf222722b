robot Bob {
    coordinates th;
    parameters J: kg*m^2, k;
    constants g = 9.81 m s^-2;
    constants w = 1 1/s^2;
    constants t = 3 N m;
    kinetic = J/2*dot(th)^2;
    potential = 0;
}
