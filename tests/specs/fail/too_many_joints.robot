// A snake.
robot Snake {
    gravity = [0, 0, -9.81];
    convention = standard_dh;
    joint j0_: revolute { a = 0.1; alpha = 90 deg; d = 0; }
    joint j1_: revolute { a = 0.1; alpha = 90 deg; d = 0; }
    joint j2_: revolute { a = 0.1; alpha = 90 deg; d = 0; }
    joint j3_: revolute { a = 0.1; alpha = 90 deg; d = 0; }
    joint j4_: revolute { a = 0.1; alpha = 90 deg; d = 0; }
    joint j5_: revolute { a = 0.1; alpha = 90 deg; d = 0; }
    joint j6_: revolute { a = 0.1; alpha = 90 deg; d = 0; }
    joint j7_: revolute { a = 0.1; alpha = 90 deg; d = 0; }
    joint j8_: revolute { a = 0.1; alpha = 90 deg; d = 0; }
    joint j9_: revolute { a = 0.1; alpha = 90 deg; d = 0; }
    joint j10_: revolute { a = 0.1; alpha = 90 deg; d = 0; }
    joint j11_: revolute { a = 0.1; alpha = 90 deg; d = 0; }
    joint j12_: revolute { a = 0.1; alpha = 90 deg; d = 0; }
    joint j13_: revolute { a = 0.1; alpha = 90 deg; d = 0; }
    joint j14_: revolute { a = 0.1; alpha = 90 deg; d = 0; }
    joint j15_: revolute { a = 0.1; alpha = 90 deg; d = 0; }
    joint j16_: revolute { a = 0.1; alpha = 90 deg; d = 0; }
    joint j17_: revolute { a = 0.1; alpha = 90 deg; d = 0; }
    joint j18_: revolute { a = 0.1; alpha = 90 deg; d = 0; }
    joint j19_: revolute { a = 0.1; alpha = 90 deg; d = 0; }
    joint j20_: revolute { a = 0.1; alpha = 90 deg; d = 0; }
    joint j21_: revolute { a = 0.1; alpha = 90 deg; d = 0; }
    joint j22_: revolute { a = 0.1; alpha = 90 deg; d = 0; }
    joint j23_: revolute { a = 0.1; alpha = 90 deg; d = 0; }
    joint j24_: revolute { a = 0.1; alpha = 90 deg; d = 0; }
    joint j25_: revolute { a = 0.1; alpha = 90 deg; d = 0; }
    joint j26_: revolute { a = 0.1; alpha = 90 deg; d = 0; }
    joint j27_: revolute { a = 0.1; alpha = 90 deg; d = 0; }
    joint j28_: revolute { a = 0.1; alpha = 90 deg; d = 0; }
    joint j29_: revolute { a = 0.1; alpha = 90 deg; d = 0; }
    joint j30_: revolute { a = 0.1; alpha = 90 deg; d = 0; }
    joint j31_: revolute { a = 0.1; alpha = 90 deg; d = 0; }
    joint j32_: revolute { a = 0.1; alpha = 90 deg; d = 0; }
    joint j33_: revolute { a = 0.1; alpha = 90 deg; d = 0; }
    joint j34_: revolute { a = 0.1; alpha = 90 deg; d = 0; }
    joint j35_: revolute { a = 0.1; alpha = 90 deg; d = 0; }
    joint j36_: revolute { a = 0.1; alpha = 90 deg; d = 0; }
    joint j37_: revolute { a = 0.1; alpha = 90 deg; d = 0; }
    joint j38_: revolute { a = 0.1; alpha = 90 deg; d = 0; }
    joint j39_: revolute { a = 0.1; alpha = 90 deg; d = 0; }
    joint j40_: revolute { a = 0.1; alpha = 90 deg; d = 0; }
}
