robot Pendulum {
    gravity = [0, 0, -9.81];
    convention = standard_dh;
    joint pivot: revolute { a = 0.5; alpha = 0; d = 0; }
    effect creep(j) {
        linear k;
        torque(j) = k * dq(j);
    }
}
