// Equation (7) of a paper on a one-link arm, as printed: its gravity torque is 9.8 m l a cos(th) - 4.9 m l cos(th).
robot Link {
    coordinates th;
    parameters m: kg;
    constants l = 0.21 m, a = 0.105 m, g = 9.8 m/s^2;
    kinetic = (0.3*l^2*m - a*l*m + a^2*m)*dot(th)^2/2;
    potential = g*m*l*a*sin(th) - g/2*m*l*sin(th);
}
