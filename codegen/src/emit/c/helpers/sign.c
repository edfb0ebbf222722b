// -1, 0 or 1; 0 at 0, no number at none.
static double robot_sign(double x) {
    return x > 0.0 ? 1.0 : x < 0.0 ? -1.0 : x;
}
