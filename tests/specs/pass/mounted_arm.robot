// An arm as it was mounted and is used: on a base that leans, with a tool in its hand that is touched for a while, an encoder that was put on badly, and a
// log whose torques come late. What effects say of these is in the equations, but for the delay, which is the log's.
robot MountedArm {
    gravity = [0, 0, -9.81];
    convention = modified_dh;
    joint turn: revolute { alpha = 0; a = 0; d = 0.4; }
    joint lift: revolute { alpha = 90 deg; a = 0.1; d = 0; }
    joint reach: prismatic { alpha = 90 deg; a = 0; theta = 0; position = 0.2 .. 0.8; }
    link reach: fixed { mass = 2.1; com = [0, 0.02, -0.1]; inertia = [0.02, 0.02, 0.01, 0, 0, 0]; }
    effects {
        base_tilt;
        time_delay(delay = 0.004);
        encoder_offset(offset = 0.05) on lift;
        payload on reach;
        external_force(start = 2, end = 8) on reach;
        viscous_friction on all;
    }
}
