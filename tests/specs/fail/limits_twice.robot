robot Link {
    coordinates th;
    parameters J: kg*m^2, mr: kg*m;
    constants g = 9.81 m/s^2;
    kinetic = J/2*dot(th)^2;
    potential = mr*g*cos(th);
    limits th { position = -1 .. 1; }
    limits th { position = -2 .. 2; }
}
