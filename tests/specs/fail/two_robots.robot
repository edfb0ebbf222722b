robot Arm {
    gravity = [0, 0, -9.81];
    convention = standard_dh;
    joint waist: revolute { a = 0; alpha = 90 deg; d = 0; }
    joint elbow: revolute { a = 0.4; alpha = 0; d = 0; }
}
robot Other { gravity = [0, 0, 0]; convention = origin; joint j: revolute { xyz = [0, 0, 0]; axis = [0, 0, 1]; } }
