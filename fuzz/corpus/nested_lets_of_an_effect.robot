// Written out, the torque would be 2^18 long.
effect nest(j) {
    /// Torque, N m.
    linear k;
    let n0 = q(j);
    let n1 = sin(n0) + cos(n0);
    let n2 = sin(n1) + cos(n1);
    let n3 = sin(n2) + cos(n2);
    let n4 = sin(n3) + cos(n3);
    let n5 = sin(n4) + cos(n4);
    let n6 = sin(n5) + cos(n5);
    let n7 = sin(n6) + cos(n6);
    let n8 = sin(n7) + cos(n7);
    let n9 = sin(n8) + cos(n8);
    let n10 = sin(n9) + cos(n9);
    let n11 = sin(n10) + cos(n10);
    let n12 = sin(n11) + cos(n11);
    let n13 = sin(n12) + cos(n12);
    let n14 = sin(n13) + cos(n13);
    let n15 = sin(n14) + cos(n14);
    let n16 = sin(n15) + cos(n15);
    let n17 = sin(n16) + cos(n16);
    let n18 = sin(n17) + cos(n17);
    torque(j) = k * n18;
}

robot Arm {
    gravity = [0, -9.81, 0];
    convention = standard_dh;
    joint one: revolute { a = 0.4; alpha = 0; d = 0; }
    effects { nest on one; }
}
