// Six axes with a wrist whose axes meet, of a payload of some kilograms.
robot SixAxes {
    gravity = [0, 0, -9.81];
    convention = standard_dh;

    joint j1: revolute { a = 30 mm;  alpha = -90 deg; d = 380 mm; position = -170 deg .. 170 deg; velocity = 2.2; }
    joint j2: revolute { a = 440 mm; alpha = 0;       d = 0;      position = -150 deg .. -30 deg; velocity = 2.0; }
    joint j3: revolute { a = 35 mm;  alpha = -90 deg; d = 0;      position = -70 deg .. 70 deg;   velocity = 2.4; }
    joint j4: revolute { a = 0;      alpha = 90 deg;  d = 420 mm; position = -170 deg .. 170 deg; velocity = 3.5; }
    joint j5: revolute { a = 0;      alpha = -90 deg; d = 0;      position = -110 deg .. 110 deg; velocity = 3.5; }
    joint j6: revolute { a = 0;      alpha = 0;       d = 83 mm;  position = -200 deg .. 200 deg; velocity = 4.5; }

    link j1 { mass = 18 kg;  com = [-0.01, 0.06, -0.02];  inertia = [0.18, 0.01, 0, 0.14, 0.01, 0.17]; }
    link j2 { mass = 14 kg;  com = [-0.20, 0.01, 0.06];   inertia = [0.05, 0.01, 0.01, 0.34, 0, 0.33]; }
    link j3 { mass = 8 kg;   com = [-0.01, 0.02, 0.05];   inertia = [0.06, 0, 0.005, 0.05, 0, 0.04]; }
    link j4 { mass = 3.4 kg; com = [0.00, 0.09, 0.01];    inertia = [0.025, 0, 0, 0.006, 0, 0.024]; }
    link j5 { mass = 2.1 kg; com = [0.00, -0.01, 0.04];   inertia = [0.006, 0, 0, 0.006, 0, 0.003]; }
    link j6 { mass = 1.1 kg; com = [0.01, 0.005, 0.02];   inertia = [0.0016, 0, 0, 0.0016, 0, 0.0010]; }
}
