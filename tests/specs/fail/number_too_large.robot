// A quantity that no robot has.
robot Arm {
    gravity = [0, 0, -9.81];
    convention = standard_dh;
    joint pivot: revolute { a = 1e160; alpha = 0; d = 0; }
}
