/// Drag that grows with the square of the speed.
effect drag(j) {
    linear c >= 0;
    shape w in 0.1 .. 10;
    torque(j) = c * dq(j) * abs(dq(j) / w);
}
