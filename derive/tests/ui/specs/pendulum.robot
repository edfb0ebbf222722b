robot Pendulum {
    gravity = [0, -9.81, 0];
    convention = standard_dh;
    joint pivot: revolute { a = 0.5; alpha = 0; d = 0; }
    joint tip: revolute { a = 0.2; alpha = 0; d = 0; }
    link tip: fixed { mass = 1; com = [0, 0, 0]; inertia = [0, 0, 0, 0, 0, 0.01]; }
    effects { viscous_friction on pivot; gear_coupling on (pivot, tip); }
}
