robot Link {
    parameters J: kg*m^2;
    kinetic = 0;
    potential = 0;
}
