robot Pendulum {
    gravity = [0, 0, -9.81];
    convention = standard_dh;
    joint pivot: revolute { a = 0.5; alpha = 0; d = 0; }
}

effect push(j) {
    kind external_force;
    kind torque_offset;
    linear k;
    torque(j) = k;
}
