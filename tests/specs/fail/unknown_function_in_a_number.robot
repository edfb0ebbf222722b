robot Arm {
    gravity = [0, 0, -9.81];
    convention = standard_dh;
    joint pivot: revolute { a = root(2); alpha = 0; d = 0; }
}
