effect sag(kg) {
    linear m;
    shape s in 0.1 .. 1;
    input J;
    state z;
    let rev = tanh(q(kg)/s);
    dot(z) = dq(kg) - 2 s*z;
    torque(kg) = 2 m*z + m*(3 J + 4 z + 0.5 rev);
}

robot Arm {
    gravity = [0, 0, -9.81];
    convention = standard_dh;
    joint waist: revolute { a = 0; alpha = 90 deg; d = 0; }
    effects { sag on waist; }
}
