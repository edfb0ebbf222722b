robot Arm {
    gravity = [0, 0, -9.81];
    convention = standard_dh;
    joint pivot: revolute { a = exp(3 m); alpha = 0; d = 0; }
}
