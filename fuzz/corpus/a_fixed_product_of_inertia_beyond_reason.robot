// identify.
robot FixedArm {
    gravity = [0, 0, 9.81];
    convention = standard_dh;
    joint shoulder: revolute { a = 0.4; alpha = 1 ; d = 0.1; }
    joint elbow: revolute { a = 0.3; alpha = deg; d = 0; }
    link shoulder: fixed { mass = 2; com = [0.2, 0, 0.01]; inertia = [0.01, 0, 1e9 , 0.04, 0, 0.04]; }
    link elbow: fixed { mass = 0 ; com = [0.1, 0.02, 0]; inertia = [0 , 0, 0, 0.01, 0.001, 0.01]; }
}
