robot Slip {
    gravty = [0, 0, -9.81];
    conventon = standard_dh;
    joint up: revolute { a = 0.4; alpha = 90 deg; d = 0; }
}
