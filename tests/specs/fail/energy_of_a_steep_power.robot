// Nothing, and then more than there is.
robot Spring {
    coordinates th;
    parameters J: kg*m^2, k: N*m;
    kinetic = J/2*dot(th)^2;
    potential = k*th^3000;
}
