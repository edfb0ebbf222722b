robot Arm {
    gravity = [0, 0, -9.81];
    convention = standard_dh;
    joint pivot: revolute { a = sin(1, 2); alpha = 0; d = 0; }
}
