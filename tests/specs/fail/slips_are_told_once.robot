robot Slip {
    gravity = [0, 0, -9.81];
    convention = standard_dh;
    joint up: revolute { a = 0.4; alpah = 90 deg; d = 0; }
    joint lo: revolute { a = 0.3; alpha = 0; d = 0; }
    link up { mass = 2; com = [0, 0, 0]; inertai = [0.1, 0, 0, 0.1, 0, 0.1]; }
    effects { saturating(limt = 3) on lo; }
}

effect saturating(j) {
    /// Torque beyond the limit, none.
    linear share;
    /// The limit, N m.
    shape limit in 1 .. 100;
    torque(j) = share * max(0, abs(measured_torque(j)) - limit);
}
