effect comb(j) {
    linear c;
    /// Teeth per turn.
    shape teeth in 1 .. 20;
    torque(j) = c * sin(teeth * q(j));
}

robot Arm {
    gravity = [0, 0, -9.81];
    convention = standard_dh;
    joint waist: revolute { a = 0; alpha = 90 deg; d = 0; }
    joint rail: prismatic { a = 0.4; alpha = 0; theta = 0; }
    effects {
        stribeck(vs = 5 kg) on waist;
        dahl(d = 0.1 Nm) on waist;
        stribeck(vs = 0.1 rad/s) on rail;
        time_delay(delay = 3 mm);
        comb(teeth = 3 rad) on waist;
        lugre_presliding(d = 2 deg, vs = 3 deg/s) on waist;
        cable_hysteresis(width = 2 mm) on rail;
        joint_elasticity(stiffness = 2000 N*m/rad) on waist;
    }
}
