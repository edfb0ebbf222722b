robot Pendulum {
    gravity = [0, -9.81];
    convention = standard_dh;
    joint pivot: revolute { a = 0.5; alpha = 3 mm; d = 0; }
}
