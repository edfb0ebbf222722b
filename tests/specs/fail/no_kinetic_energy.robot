robot Link {
    coordinates th;
    parameters J: kg*m^2, mr: kg*m;
    constants g = 9.81 m/s^2;
    potential = mr*g*cos(th);
}
