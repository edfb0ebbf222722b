// A pendulum on a cart: an angle and a length, a known mass beside unknown ones, and a ratio of two unknowns.
robot CartPole {
    coordinates x: m, th;
    parameters m: kg, l: m, J: kg*m^2, N;
    constants cart = 2.5 kg, g = 9.81 m/s^2, stiffness = 40 N/m;
    let px = x + l*sin(th);
    let pz = -l*cos(th);
    kinetic = cart/2*dot(x)^2 + m/2*(dot(px)^2 + dot(pz)^2) + J/N^2/2*dot(th)^2;
    potential = m*g*pz + stiffness/2*x^2 + stiffness/10*x^3/l;
    effects { viscous_friction on all; coulomb_friction on x; }
}
