robot Cases {
    coordinates x;
    parameters M, m, X;
    kinetic = (M + m)/2*dot(x)^2;
    potential = X*x;
    effects { viscous_friction on x; }
}
