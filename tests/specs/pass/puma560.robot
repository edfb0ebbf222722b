// Unimation PUMA 560. Frames: standard DH. Inertials: P. I. Corke and B. Armstrong-Helouvry, "A search for consensus among
// model parameters reported for the PUMA 560 robot", ICRA 1994; rotor inertias and friction are left out.
robot Puma560 {
    gravity = [0, 0, -9.81];
    convention = standard_dh;

    joint waist:       revolute { a = 0;      alpha = 90 deg;  d = 0;       position = -160 deg .. 160 deg; velocity = 8.2;  torque = 97.6; }
    joint shoulder:    revolute { a = 0.4318; alpha = 0;       d = 0;       position = -225 deg .. 45 deg; }
    joint elbow:       revolute { a = 0.0203; alpha = -90 deg; d = 0.15005; position = -45 deg .. 225 deg; }
    joint wrist_roll:  revolute { a = 0;      alpha = 90 deg;  d = 0.4318;  position = -110 deg .. 170 deg; }
    joint wrist_pitch: revolute { a = 0;      alpha = -90 deg; d = 0;       position = -100 deg .. 100 deg; }
    joint wrist_yaw:   revolute { a = 0;      alpha = 0;       d = 0;       position = -266 deg .. 266 deg; }

    link waist       { mass = 0;    com = [0, 0, 0];               inertia = [0, 0, 0, 0.35, 0, 0]; }
    link shoulder    { mass = 17.4; com = [-0.3638, 0.006, 0.2275]; inertia = [0.13, 0, 0, 0.524, 0, 0.539]; }
    link elbow       { mass = 4.8;  com = [-0.0203, -0.0141, 0.070]; inertia = [0.066, 0, 0, 0.086, 0, 0.0125]; }
    link wrist_roll  { mass = 0.82; com = [0, 0.019, 0];           inertia = [1.8e-3, 0, 0, 1.3e-3, 0, 1.8e-3]; }
    link wrist_pitch { mass = 0.34; com = [0, 0, 0];               inertia = [0.3e-3, 0, 0, 0.4e-3, 0, 0.3e-3]; }
    link wrist_yaw   { mass = 0.09; com = [0, 0, 0.032];           inertia = [0.15e-3, 0, 0, 0.15e-3, 0, 0.04e-3]; }

    effects {
        viscous_friction on all;
        coulomb_friction on all;
        motor_inertia on all;
        gear_coupling on (wrist_pitch, wrist_yaw);
    }
}
