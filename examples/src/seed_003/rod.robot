// Equations (2) to (6): a chain of one link, whose pseudo-inertia is that of a uniform rod from the end of the link backward.
robot Rod {
    gravity = [0, -9.81, 0];
    convention = standard_dh;
    joint th: revolute { a = 210 mm; alpha = 0; d = 0; }
    link th: fixed { mass = 45 g; com = [-105 mm, 0, 0]; inertia = [0, 0, 0, 1.65375e-4, 0, 1.65375e-4]; }
    effects { viscous_friction on th; }
}
