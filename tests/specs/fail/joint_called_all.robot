robot Arm {
    gravity = [0, 0, -9.81];
    convention = standard_dh;
    joint all: revolute { a = 0.5; alpha = 0; d = 0; }
}
