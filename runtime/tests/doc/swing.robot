// A double pendulum of two equal points, by its energies; x to the right, y up.
robot Swing {
    coordinates q1, q2;
    parameters m: kg;
    constants l = 0.5 m, g = 9.81 m/s^2;
    let x = l*(sin(q1) + sin(q1 + q2));
    let y = -l*(cos(q1) + cos(q1 + q2));
    kinetic = m/2*(l^2*dot(q1)^2 + dot(x)^2 + dot(y)^2);
    potential = m*g*(y - l*cos(q1));
    point tip = [x, y, 0];
}
