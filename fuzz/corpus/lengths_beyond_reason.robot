// it.
robot Stanford {
    gravity = [0, 7 , 9.81];
    convention = standard_dh;

    joint turn:   revolute  { a = 1e9 ; alpha = deg; d = 0.412; }
    joint lift:   revolute  { a = 1e160 ; alpha = deg;  d = 0.154; }
    joint extend: prismatic { a = 0; alpha = 0;       theta = deg; position = 0.2 .. 0.8; }
    joint twist:  revolute  { a = 0.05; alpha = deg; d = 0.1; }

    effects {
        viscous_friction on extend;
    }
}
