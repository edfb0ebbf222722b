// A constant is a number; `g` would be a gram.
robot Weight {
    coordinates x: m;
    parameters m: kg, M = 2*m;
    constants g = 9.81 m/s^2, twice = 2*g, k = 5 N/m;
    kinetic = (m + M)/2*dot(x)^2;
    potential = m*twice*x + k/2*x^2;
}
