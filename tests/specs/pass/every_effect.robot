// A planar arm on a turntable that declares every standard effect once, but for those with a memory and those that read a
// log (memory.robot): what an effect means is tested on it.
robot EveryEffect {
    gravity = [0, 0, -9.81];
    convention = modified_dh;

    joint turntable: revolute { alpha = 0;      a = 0;   d = 0.4; }
    joint shoulder:  revolute { alpha = 90 deg; a = 0.1; d = 0;   offset = 30 deg; }
    joint elbow:     revolute { alpha = 0;      a = 0.5; d = 0.05; }

    effects {
        viscous_friction on all;
        coulomb_friction on all;
        motor_inertia on elbow;
        torque_offset on turntable;
        asymmetric_coulomb on shoulder;
        asymmetric_viscous on shoulder;
        quadratic_viscous on turntable;
        cubic_viscous on elbow;
        stribeck(vs = 0.1) on turntable;
        joint_spring on elbow;
        gear_coupling on (turntable, elbow);
        // No rotor's inertia of the shoulder: it would regroup into the link's, and count as load.
        load_dependent_friction on shoulder;
        torque_ripple(k = 12) on turntable;
        position_dependent_friction(k = 3) on elbow;
        parameter_drift(settle = 5) on elbow;
        transmission_efficiency on elbow;
        torque_gain on turntable;
        gravity_compensation_spring(apart = 1, q0 = 0.4) on shoulder;
        rokae(eps = 0.05) on turntable;
        rokae_continuous(eps = 0.05) on shoulder;
    }
}
