effect hard(j) {
    /// Torque, N m.
    linear f;
    torque(j) = f * dq(j) / (2 - 1 - 1) + f * dq(j)^3000 + f * exp(1000);
}

robot Fan {
    gravity = [0, 0, 0];
    convention = standard_dh;
    joint rotor: revolute { a = 0; alpha = 0; d = 0; }
    effects { hard on rotor; }
}
