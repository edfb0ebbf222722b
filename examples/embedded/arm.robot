// Two links in a vertical plane: y points up, angles count from the horizontal.
robot TwoLinkArm {
    gravity = [0, -9.81, 0];
    convention = standard_dh;

    joint shoulder: revolute { a = 0.50 m; alpha = 0; d = 0; position = -150 deg .. 150 deg; torque = 90; }
    joint elbow:    revolute { a = 0.40 m; alpha = 0; d = 0; position = -140 deg .. 140 deg; torque = 40; }

    effects {
        viscous_friction on all; // gearboxes, warm
    }
}
