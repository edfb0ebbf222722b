// Equation (20): while bristles stick, the link on them is a spring and a damper.
robot Link {
    gravity = [0, -9.81, 0];
    convention = standard_dh;
    joint th: revolute { a = 210 mm; alpha = 0; d = 0; offset = -90 deg; actuator_gain = 1.3607 Nm/A; }
    link th: fixed { mass = 45 g; com = [-105 mm, 0, 0]; inertia = [0, 0, 0, 1.65375e-4, 0, 1.65375e-4]; }
    effects { joint_spring on th; viscous_friction on th; }
}
