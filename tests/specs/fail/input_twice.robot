robot Pendulum {
    gravity = [0, 0, -9.81];
    convention = standard_dh;
    joint pivot: revolute { a = 0.5; alpha = 0; d = 0; }
}

effect heat(j) {
    input current(j);
    input current(j);
    linear k;
    torque(j) = k * current(j);
}
