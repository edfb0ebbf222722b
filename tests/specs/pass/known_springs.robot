// Nothing is unknown, nothing needs a function, and names are words of Rust or not in its case.
robot KnownSprings {
    coordinates match: m, my__Z: m, q;
    constants m = 2 kg, k = 30 N/m^2, s = 1 m, J = 0.1 kg*m^2;
    kinetic = m/2*(dot(match)^2 + dot(my__Z)^2) + J/2*dot(q)^2;
    potential = k/4*match^2*my__Z^2/s + k/2*match*my__Z*(match - my__Z);
}
