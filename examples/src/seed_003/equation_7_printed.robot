// Equation (7) as it is printed: a length too many in the gravity torque.
robot Link {
    coordinates th;
    parameters m: kg;
    constants l = 210 mm, a = 210 mm, g = 9.8 m/s^2;
    kinetic = m*(0.3*l^2 - a*l + a^2)/2*dot(th)^2;
    potential = (g*m*l*a - g/2*m*l)*sin(th);
}
