robot Link {
    coordinates th;
    parameters J: kg*m^2;
    constants w = 3 rad/s;
    kinetic = J/2*dot(th)^2 + J*w*dot(th);
    potential = 0;
}
