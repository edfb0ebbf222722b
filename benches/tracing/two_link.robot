// Two links in a vertical plane.
robot TwoLink {
    gravity = [0, -9.81, 0];
    convention = standard_dh;

    joint shoulder: revolute { a = 0.50 m; alpha = 0; d = 0; position = -120 deg .. 120 deg; velocity = 2.5; }
    joint elbow:    revolute { a = 0.40 m; alpha = 0; d = 0; position = -130 deg .. 130 deg; velocity = 3.5; }

    link shoulder { mass = 6.0 kg; com = [-0.22, 0.01, 0]; inertia = [0.02, 0, 0, 0.14, 0, 0.15]; }
    link elbow    { mass = 3.2 kg; com = [-0.18, 0.02, 0]; inertia = [0.01, 0, 0, 0.04, 0, 0.05]; }
}
