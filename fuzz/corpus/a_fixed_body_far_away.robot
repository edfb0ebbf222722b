// s.
robot MountedArm {
    gravity = [0, 0, 9.81];
    convention = modified_dh;
    joint lift: revolute { alpha = deg; a = 0.1; d = 16 ; }
    joint reach: prismatic { alpha = deg; a = 0; theta = 0; position = 0.2 .. 0.8; }
    link reach: fixed { mass = 2.1; com = [0, 100 , 0 ]; inertia = [1 , 0.02, 0.01, 0, 0, 0]; }
    effects {
        time_delay(delay = 0.004);
        encoder_offset(offset = 0.05) on reach;
        external_force(start = 2, end = 8) on all;
    }
}
