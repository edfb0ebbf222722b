// The same arm as a chain: links along x from joints about z, the first one hanging where q1 = 0. The frame of the first link is at its
// end, so its center of mass lies c1 - l1 from there. Values are those of Table 2.
robot PneumaticArmDh {
    gravity = [0, -9.81, 0];
    convention = standard_dh;
    joint q1: revolute { a = 0.615; alpha = 0; d = 0; offset = -90 deg; }
    joint q2: revolute { a = 0; alpha = 0; d = 0; }
    link q1 { mass = 5.914; com = [-0.322, 0, 0]; inertia = [0, 0, 0, 0, 0, 0.357]; }
    link q2 { mass = 3.437; com = [0.19, 0, 0]; inertia = [0, 0, 0, 0, 0, 0.013]; }
    effects { viscous_friction on all; coulomb_friction on all; }
}
