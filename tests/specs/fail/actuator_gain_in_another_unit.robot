robot Arm {
    gravity = [0, 0, -9.81];
    convention = standard_dh;
    joint waist: revolute { a = 0; alpha = 90 deg; d = 0; actuator_gain = 3 deg; }
    joint slide: prismatic { a = 0; alpha = 0; theta = 0; }

    effects { viscous_friction on all; }
}
