robot Arm {
    gravity = [0, 0, -9.81];
    convention = standard_dh;
}
