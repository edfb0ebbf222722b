// Logs and parameter files are in SI units.
robot Slide {
    coordinates x: mm;
    parameters m: g, k: N/mm, a: deg;
    kinetic = m/2*dot(x)^2*(1 + a);
    potential = k/2*x^2;
}
