robot Arm {
    gravity = [0, 0, -9.81];
    convention = origin;
    joint waist: revolute { xyz = [0, 0, 0.3]; axis = [0, 0, 0]; }
}
