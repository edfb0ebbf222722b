robot Arm {
    gravity = [0, 0, -9.81];
    convention = standard_dh;
    joint waist: revolute { a = 0; alpha = 90 deg; d = 0; }
    joint elbow: revolute { a = 0.4; alpha = 0; d = 0; }
    effects { viscous_friction on el-bow; }
}
