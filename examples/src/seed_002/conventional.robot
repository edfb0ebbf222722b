// The same arm with what the publication calls conventional friction: Coulomb and viscous, alike both ways.
// Lengths and limits are those of rokae.robot.
robot RokaeConventional {
    gravity = [0, 0, -9.81];
    convention = standard_dh;
    joint j1: revolute { a = 30 mm; alpha = -90 deg; d = 380 mm; position = -170 deg .. 170 deg; velocity = 180 deg/s; }
    joint j2: revolute { a = 440 mm; alpha = 0; d = 0; offset = -90 deg; position = -90 deg .. 90 deg; velocity = 180 deg/s; }
    joint j3: revolute { a = 35 mm; alpha = -90 deg; d = 0; position = -120 deg .. 70 deg; velocity = 180 deg/s; }
    joint j4: revolute { a = 0; alpha = 90 deg; d = 420 mm; position = -170 deg .. 170 deg; velocity = 300 deg/s; }
    joint j5: revolute { a = 0; alpha = -90 deg; d = 0; position = -120 deg .. 120 deg; velocity = 260 deg/s; }
    joint j6: revolute { a = 0; alpha = 0; d = 83 mm; position = -360 deg .. 360 deg; velocity = 360 deg/s; }
    effects {
        coulomb_friction on all;
        viscous_friction on all;
        motor_inertia on all;
    }
}
