robot Arm {
    gravity = [0, 0, -9.81];
    convention = standard_dh;
    joint waist: revolute { a = 0; alpha = 90 deg; d = 0; }
    joint elbow: revolute { a = 0.4; position = 90 deg .. 0.5*180 deg; alpha = 0; d = 0; }
}
