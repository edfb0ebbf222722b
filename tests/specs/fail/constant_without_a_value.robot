robot Link {
    coordinates th;
    parameters J: kg*m^2, mr: kg*m;
    constants g;
    kinetic = J/2*dot(th)^2;
    potential = mr*g*cos(th);
}
