// Solves `a x = b` for a symmetric positive definite `a`, of which the lower triangle is read, by `a = L D L^T`; `b` is in `x`.
// Returns 0 where `a` is not positive definite to a hundred roundings, or not finite.
static int robot_positive_definite(double a[ROBOT_DOF][ROBOT_DOF], double x[ROBOT_DOF]) {
    double lower[ROBOT_DOF][ROBOT_DOF];
    double diagonal[ROBOT_DOF];
    for (int i = 0; i < ROBOT_DOF; ++i) {
        for (int j = 0; j < i; ++j) {
            // `lower[i][j] * diagonal[j]` first.
            double entry = a[i][j];
            for (int k = 0; k < j; ++k) {
                entry -= lower[i][k] * diagonal[k] * lower[j][k];
            }
            lower[i][j] = entry / diagonal[j];
        }
        double pivot = a[i][i];
        for (int j = 0; j < i; ++j) {
            pivot -= lower[i][j] * lower[i][j] * diagonal[j];
            x[i] -= lower[i][j] * x[j];
        }
        // A comparison with no number is false.
        if (!(pivot > 1.1102230246251565e-14 * a[i][i] && pivot > 0.0 && pivot < HUGE_VAL)) {
            return 0;
        }
        diagonal[i] = pivot;
    }
    for (int i = ROBOT_DOF - 1; i >= 0; --i) {
        x[i] /= diagonal[i];
        for (int j = i + 1; j < ROBOT_DOF; ++j) {
            x[i] -= lower[j][i] * x[j];
        }
    }
    return 1;
}
