robot Pendulum {
    gravity = [0, 0, -9.81];
    convention = standard_dh;
    joint pivot: revolute { a = 0.5; alpha = 0; d = 0; }
    effects { pivot; }
}

effect pivot() {
    shape lag in 0.001 .. 0.1;
    delay = lag;
}
