// One printed link, a uniform rod of length l that turns about a point at the distance a from its end, with LuGre friction.
// Its inertia is m (l^2/3 - a l + a^2) and its gravity torque m g (a - l/2) cos(th): the paper's equation (7) rounds 1/3 to
// 0.3 and has a length too many.
robot LugreLink {
    coordinates th;
    parameters m = 45 g;
    constants l = 210 mm, a = 5 mm, g = 9.81 m/s^2;
    kinetic = m*(l^2/3 - a*l + a^2)/2*dot(th)^2;
    potential = m*g*(a - l/2)*sin(th);
    effects { lugre_presliding on th; viscous_friction on th; }
}
