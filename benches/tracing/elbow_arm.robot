// Base, shoulder and elbow.
robot ElbowArm {
    gravity = [0, 0, -9.81];
    convention = standard_dh;

    joint base:     revolute { a = 0;      alpha = 90 deg; d = 0.30 m; position = -170 deg .. 170 deg; velocity = 2.5; }
    joint shoulder: revolute { a = 0.45 m; alpha = 0;      d = 0;      position = -60 deg .. 120 deg;  velocity = 2.5; }
    joint elbow:    revolute { a = 0.40 m; alpha = 0;      d = 0;      position = -130 deg .. 130 deg; velocity = 3.0; }

    link base     { mass = 9.0 kg; com = [0.00, -0.08, 0.01]; inertia = [0.11, 0, 0, 0.06, 0, 0.10]; }
    link shoulder { mass = 7.5 kg; com = [-0.22, 0.01, 0.04]; inertia = [0.02, 0.003, 0, 0.16, 0, 0.15]; }
    link elbow    { mass = 3.8 kg; com = [-0.17, 0.00, 0.02]; inertia = [0.008, 0, 0.002, 0.05, 0, 0.05]; }
}
