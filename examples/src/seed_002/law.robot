// One joint about a vertical axis, so that friction is all that it has beside its inertia, with the law as it is printed.
robot Law {
    gravity = [0, 0, -9.81];
    convention = standard_dh;
    joint j: revolute { a = 0; alpha = 0; d = 0; velocity = 180 deg/s; }
    effects { rokae(eps = 0.01) on j; }
}
