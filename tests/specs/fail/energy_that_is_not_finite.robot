// An inertia over nothing is none.
robot Wheel {
    coordinates th;
    parameters J: kg*m^2, k: N*m;
    constants a = 2, b = 2;
    let nothing = a - b;
    kinetic = J/nothing*dot(th)^2;
    potential = k*exp(1000)*cos(th);
}
