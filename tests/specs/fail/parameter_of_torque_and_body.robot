robot Pendulum {
    gravity = [0, 0, -9.81];
    convention = standard_dh;
    joint pivot: revolute { a = 0.5; alpha = 0; d = 0; }
}

effect load(j) {
    linear m;
    body(j) = [m, 0, 0, 0, 0, 0, 0, 0, 0, 0];
    torque(j) = m * sign(dq(j));
}
