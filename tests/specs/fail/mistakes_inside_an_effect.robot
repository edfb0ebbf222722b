// The declaration of a faulty effect is no mistake of its own.
effect bumps(j) {
    /// Torque, N m.
    linear k;
    /// Speed, rad/s.
    shape w in 0.1 .. 10;
    torque(j) = k * dq(i) * exp(-w * dq(j)) + k * w * k;
}

robot Arm {
    gravity = [0, 0, -9.81];
    convention = standard_dh;
    joint waist: revolute { a = 0; alpha = 90 deg; d = 0; }
    effects { bumps(w = 2) on waist; bump on waist; }
}
