robot Link {
    coordinates th;
    parameters J: kg*m^2, mr: kg*m, l: m;
    constants g = 9.81 m/s^2;
    point tip = [l*cos(th), l*sin(th), 0];
    kinetic = J/2*dot(th)^2;
    potential = mr*g*cos(th);
}
