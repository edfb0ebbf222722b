// Two numbers that a robot may have, with a product that it has not.
robot Arm {
    gravity = [0, 0, -9.81];
    convention = standard_dh;
    joint pivot: revolute { a = 1e-20 * 1e-20; alpha = 0; d = 0; }
}
