// Rotors in one sum with links of nominal inertia, and friction of the load that links have alone.
robot SharedRotors {
    gravity = [0, -9.81, 0];
    convention = standard_dh;
    joint a: revolute { a = 0.3; alpha = 0; d = 0; }
    joint b: revolute { a = 0.25; alpha = 0; d = 0; }
    link a: nominal { mass = 2; com = [-0.15, 0, 0]; inertia = [0.002, 0, 0, 0.02, 0, 0.02]; }
    link b: nominal { mass = 1.2; com = [-0.1, 0.02, 0]; inertia = [0.001, 0, 0, 0.01, 0, 0.01]; }
    effects {
        motor_inertia on all;
        viscous_friction on all;
        load_dependent_friction on all;
    }
}
