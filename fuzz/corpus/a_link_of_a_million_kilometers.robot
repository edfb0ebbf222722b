// it.
robot Stanford {
    gravity = [0, 0, 9.81];
    convention = standard_dh;

    joint turn:   revolute  { a = 1e9 ; alpha = 90 deg; d = 0.412; }
    joint lift:   revolute  { a = 0; alpha = deg;  d = 0.154; }
    joint extend: prismatic { a = 0; alpha = 0;       theta = deg; position = 0.2 .. 0.8; }
    joint twist:  revolute  { a = 0.05; alpha = 35 deg; d = 0.1; }

    effects {
        viscous_friction on all;
        motor_inertia on extend;
    }
}
