// Universal Robots UR10. Frames and nominal inertials: `ur10_robot.urdf` of ROS-Industrial's universal_robot, as distributed in
// the example-robot-data package (BSD); the tool flange is part of the last link.
robot Ur10 {
    gravity = [0, 0, -9.81];
    convention = origin;

    joint shoulder_pan_joint: revolute { xyz = [0, 0, 0.1273]; axis = [0, 0, 1]; position = -2*pi .. 2*pi; velocity = 2.16; torque = 330; }
    joint shoulder_lift_joint: revolute { xyz = [0, 0.220941, 0]; rpy = [0, 90 deg, 0]; axis = [0, 1, 0]; position = -2*pi .. 2*pi; velocity = 2.16; torque = 330; }
    joint elbow_joint: revolute { xyz = [0, -0.1719, 0.612]; axis = [0, 1, 0]; position = -2*pi .. 2*pi; velocity = 3.15; torque = 150; }
    joint wrist_1_joint: revolute { xyz = [0, 0, 0.5723]; rpy = [0, 90 deg, 0]; axis = [0, 1, 0]; position = -2*pi .. 2*pi; velocity = 3.2; torque = 56; }
    joint wrist_2_joint: revolute { xyz = [0, 0.1149, 0]; axis = [0, 0, 1]; position = -2*pi .. 2*pi; velocity = 3.2; torque = 56; }
    joint wrist_3_joint: revolute { xyz = [0, 0, 0.1157]; axis = [0, 1, 0]; position = -2*pi .. 2*pi; velocity = 3.2; torque = 56; }

    link shoulder_pan_joint { mass = 7.778; com = [0, 0, 0]; inertia = [0.0314743125769, 0, 0, 0.0314743125769, 0, 0.021875625]; }
    link shoulder_lift_joint { mass = 12.93; com = [0, 0, 0.306]; inertia = [0.421753803798, 0, 0, 0.421753803798, 0, 0.036365625]; }
    link elbow_joint { mass = 3.87; com = [0, 0, 0.28615]; inertia = [0.111069694097, 0, 0, 0.111069694097, 0, 0.010884375]; }
    link wrist_1_joint { mass = 1.96; com = [0, 0, 0]; inertia = [0.0051082479567, 0, 0, 0.0051082479567, 0, 0.0055125]; }
    link wrist_2_joint { mass = 1.96; com = [0, 0, 0]; inertia = [0.0051082479567, 0, 0, 0.0051082479567, 0, 0.0055125]; }
    link wrist_3_joint { mass = 0.202; com = [0, 0, 0]; inertia = [0.000526462289415, 0, 0, 0.000526462289415, 0, 0.000568125]; }

    effects {
        viscous_friction on all;
        coulomb_friction on all;
        motor_inertia on all;
    }
}
