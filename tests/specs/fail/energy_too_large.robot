// Numbers that are fine one by one.
robot Spring {
    coordinates th;
    parameters J: kg*m^2, k: N*m;
    constants a = 1e20;
    kinetic = J/2*dot(th)^2;
    potential = k*a*a*cos(th);
}
