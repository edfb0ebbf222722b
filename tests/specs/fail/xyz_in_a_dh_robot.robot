robot Arm {
    gravity = [0, 0, -9.81];
    convention = standard_dh;
    joint waist: revolute { a = 0; alpha = 90 deg; d = 0; }
    joint elbow: revolute { xyz = [0, 0, 0.4]; axis = [0, 0, 1]; }
}
