// A 6R arm of 7 kg payload with a friction law of five parameters a joint and rotor inertias: 96 standard parameters, of
// which 70 base parameters can be told. Rotors of the first two joints regroup into their links; the lengths are those of an
// arm of that size, the friction law that of the paper.
robot RokaeLike {
    gravity = [0, 0, -9.81];
    convention = standard_dh;
    joint j1: revolute { a = 30 mm; alpha = -90 deg; d = 380 mm; velocity = 180 deg/s; torque = 300; }
    joint j2: revolute { a = 440 mm; alpha = 0; d = 0; velocity = 180 deg/s; torque = 300; }
    joint j3: revolute { a = 35 mm; alpha = -90 deg; d = 0; velocity = 180 deg/s; torque = 130; }
    joint j4: revolute { a = 0; alpha = 90 deg; d = 420 mm; velocity = 260 deg/s; torque = 30; }
    joint j5: revolute { a = 0; alpha = -90 deg; d = 0; velocity = 260 deg/s; torque = 30; }
    joint j6: revolute { a = 0; alpha = 0; d = 83 mm; velocity = 360 deg/s; torque = 20; }
    effects {
        rokae(eps = 0.01) on all;
        motor_inertia on all;
    }
}
