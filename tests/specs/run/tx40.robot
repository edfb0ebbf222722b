// Staubli TX40, six axes. Frames: the modified DH table of M. Gautier's group (LS2N Nantes), as published with the logs in the
// examples of FIGAROH. Torques are motor currents on the joints' side of the gears.
//
// The gears couple the motors of joints 5 and 6: motor 6 turns with q5 + q6. Published for it: inertia 0.00964 kg m^2, viscous
// friction 0.616 N m s/rad, dry friction 1.95 N m. This model leaves it out: it is for the trace to find.
robot Tx40 {
    gravity = [0, 0, -9.81];
    convention = modified_dh;

    joint joint1: revolute { alpha = 0;       a = 0;     d = 0.320; link = link1; }
    joint joint2: revolute { alpha = -90 deg; a = 0;     d = 0;     link = link2; }
    joint joint3: revolute { alpha = 0;       a = 0.225; d = 0.035; link = link3; }
    joint joint4: revolute { alpha = 90 deg;  a = 0;     d = 0.225; link = link4; }
    joint joint5: revolute { alpha = -90 deg; a = 0;     d = 0;     link = link5; }
    joint joint6: revolute { alpha = 90 deg;  a = 0;     d = 0;     offset = 180 deg; link = link6; }

    effects {
        motor_inertia on all;
        viscous_friction on all;
        coulomb_friction on all;
        // Of the current measurement.
        torque_offset on all;
    }
}
