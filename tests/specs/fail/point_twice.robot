robot Link {
    coordinates th;
    parameters J: kg*m^2, mr: kg*m;
    constants g = 9.81 m/s^2, l = 0.3 m;
    kinetic = J/2*dot(th)^2;
    potential = mr*g*cos(th);
    point tip = [l*cos(th), l*sin(th), 0];
    point tip = [l*sin(th), l*cos(th), 0];
}
