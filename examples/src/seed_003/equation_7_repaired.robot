// Equation (7) as the rod has it: a third in the inertia, and one length in the gravity torque.
robot Link {
    coordinates th;
    parameters m: kg;
    constants l = 210 mm, a = 210 mm, g = 9.81 m/s^2;
    kinetic = m*(l^2/3 - a*l + a^2)/2*dot(th)^2;
    potential = (g*m*a - g/2*m*l)*sin(th);
}
