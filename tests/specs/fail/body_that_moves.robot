robot Pendulum {
    gravity = [0, 0, -9.81];
    convention = standard_dh;
    joint pivot: revolute { a = 0.5; alpha = 0; d = 0; }
}

effect load(j) {
    linear m;
    let reach = 0.1 * q(j);
    body(j) = [m, m * reach, 0, 0, 0, 0, 0, 0, 0, 0];
}
