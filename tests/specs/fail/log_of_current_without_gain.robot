robot Arm {
    gravity = [0, 0, -9.81];
    convention = standard_dh;
    joint waist: revolute { a = 0; alpha = 90 deg; d = 0; actuator_gain = 0.3 Nm/A; }
    joint slide: prismatic { a = 0; alpha = 0; theta = 0; }
    log { tau = "i1": A, "i2": mA; }
    effects { viscous_friction on all; }
}
