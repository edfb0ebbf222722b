robot Link {
    coordinates x: m;
    parameters m: kg;
    constants k = 3 kg*m^2/s^2;
    kinetic = m/2*dot(x)^2;
    potential = k*cos(x);
}
