robot Cart {
    coordinates x: m, dx: m;
    parameters m1: kg, m2: kg;
    kinetic = m1/2*dot(x)^2 + m2/2*dot(dx)^2;
    potential = 0 J;
}
