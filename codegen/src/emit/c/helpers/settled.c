// Adds a step of Newton's method. Returns whether it was no larger than ten thousand roundings of the largest entry.
static int robot_settled(double x[ROBOT_DOF], const double change[ROBOT_DOF]) {
    double largest = 0.0;
    double moved = 0.0;
    for (int k = 0; k < ROBOT_DOF; ++k) {
        x[k] += change[k];
        // What is no number settles nowhere.
        if (!(fabs(x[k]) < HUGE_VAL)) {
            return 0;
        }
        largest = fmax(largest, fabs(x[k]));
        moved = fmax(moved, fabs(change[k]));
    }
    return moved <= 1.1102230246251565e-12 * largest;
}
