// The first link of the arm as it hangs: a printed bar, taken for a uniform rod of 45 g and 21 cm, on a joint about a horizontal axis.
// Its angle is 0 where it hangs; the rig lets it go over 280 degrees of a turn. Logs have the motor's current: the paper has no torque
// constant, and the one here makes of its largest current, 0.8 A, its stall torque, 11.1 kgf cm.
robot Link {
    gravity = [0, -9.81, 0];
    convention = standard_dh;
    joint th: revolute {
        a = 210 mm; alpha = 0; d = 0;
        offset = -90 deg;
        position = -150 deg .. 130 deg;
        velocity = 498 deg/s;
        torque = 1.0885 Nm;
        actuator_gain = 1.3607 Nm/A;
    }
    link th: fixed { mass = 45 g; com = [-105 mm, 0, 0]; inertia = [0, 0, 0, 1.65375e-4, 0, 1.65375e-4]; }
    effects { viscous_friction on th; }
}
