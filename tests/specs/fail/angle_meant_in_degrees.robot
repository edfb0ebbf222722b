robot Arm {
    gravity = [0, 0, -9.81];
    convention = standard_dh;
    joint waist: revolute { a = 0; alpha = 90; d = 0; offset = 90 rad; position = -160 .. 160 deg; }
}
