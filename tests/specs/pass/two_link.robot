// Planar arm in a vertical plane; x to the right, y up.
robot TwoLink {
    gravity = [0, -9.81, 0];
    convention = standard_dh;

    joint shoulder: revolute { a = 0.5; alpha = 0; d = 0; position = -170 deg .. 170 deg; velocity = 3; torque = 60; }
    joint elbow: revolute { a = 0.4; alpha = 0; d = 0; position = -150 deg .. 150 deg; velocity = 4; torque = 25; }

    effects {
        viscous_friction on all;
        coulomb_friction on all;
    }
}
