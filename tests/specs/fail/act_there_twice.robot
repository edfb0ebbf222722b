robot Pendulum {
    gravity = [0, 0, -9.81];
    convention = standard_dh;
    joint pivot: revolute { a = 0.5; alpha = 0; d = 0; }
}

effect play(j) {
    shape b in 0.001 .. 0.1;
    position(j) = -b * sign(rigid_torque(j));
    position(j) = -b;
}
