robot Link {
    coordinates th;
    parameters J: kg*m^2, mr: kg*m;
    constants g = 9.81 m/s^2;
    point tip = [1 m, 0];
    kinetic = J/2*dot(th)^2;
    potential = mr*g*cos(th);
}
