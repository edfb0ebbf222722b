// Franka Emika Panda. Frames and nominal inertials: `panda.urdf` as distributed in the example-robot-data package (BSD); hand and
// fingers, locked at zero, are part of the last link.
robot Panda {
    gravity = [0, 0, -9.81];
    convention = origin;

    joint panda_joint1: revolute { xyz = [0, 0, 0.333]; axis = [0, 0, 1]; position = -2.8973 .. 2.8973; velocity = 2.175; torque = 87; }
    joint panda_joint2: revolute { xyz = [0, 0, 0]; rpy = [-90 deg, 0, 0]; axis = [0, 0, 1]; position = -1.7628 .. 1.7628; velocity = 2.175; torque = 87; }
    joint panda_joint3: revolute { xyz = [0, -0.316, 0]; rpy = [90 deg, 0, 0]; axis = [0, 0, 1]; position = -2.8973 .. 2.8973; velocity = 2.175; torque = 87; }
    joint panda_joint4: revolute { xyz = [0.0825, 0, 0]; rpy = [90 deg, 0, 0]; axis = [0, 0, 1]; position = -3.0718 .. -0.0698; velocity = 2.175; torque = 87; }
    joint panda_joint5: revolute { xyz = [-0.0825, 0.384, 0]; rpy = [-90 deg, 0, 0]; axis = [0, 0, 1]; position = -2.8973 .. 2.8973; velocity = 2.61; torque = 12; }
    joint panda_joint6: revolute { xyz = [0, 0, 0]; rpy = [90 deg, 0, 0]; axis = [0, 0, 1]; position = -0.0175 .. 3.7525; velocity = 2.61; torque = 12; }
    joint panda_joint7: revolute { xyz = [0.088, 0, 0]; rpy = [90 deg, 0, 0]; axis = [0, 0, 1]; position = -2.8973 .. 2.8973; velocity = 2.61; torque = 12; }

    link panda_joint1 { mass = 4.970684; com = [0.003875, 0.002081, -0.04762]; inertia = [0.70337, -0.000139, 0.006772, 0.70661, 0.019169, 0.009117]; }
    link panda_joint2 { mass = 0.646926; com = [-0.003141, -0.02872, 0.003495]; inertia = [0.007962, -0.003925, 0.010254, 0.02811, 0.000704, 0.025995]; }
    link panda_joint3 { mass = 3.228604; com = [0.027518, 0.039252, -0.066502]; inertia = [0.037242, -0.004761, -0.011396, 0.036155, -0.012805, 0.01083]; }
    link panda_joint4 { mass = 3.587895; com = [-0.05317, 0.104419, 0.027454]; inertia = [0.025853, 0.007796, -0.001332, 0.019552, 0.008641, 0.028323]; }
    link panda_joint5 { mass = 1.225946; com = [-0.011953, 0.041065, -0.038437]; inertia = [0.035549, -0.002117, -0.004037, 0.029474, 0.000229, 0.008627]; }
    link panda_joint6 { mass = 1.666555; com = [0.060149, -0.014117, -0.010517]; inertia = [0.001964, 0.000109, -0.001158, 0.004354, 0.000341, 0.005433]; }
    link panda_joint7 { mass = 1.495522; com = [0.00172087429763, 0.00136035441716, 0.100485281149]; inertia = [0.0165298537126, 0.000394892297119, -0.000706695710615, 0.0141072486422, -0.00105110532705, 0.00667695555664]; }

    effects {
        viscous_friction on all;
        coulomb_friction on all;
        torque_offset on all;
    }
}
