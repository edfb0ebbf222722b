// Solves `a x = b` for any square `a` by elimination with row pivoting; `b` is in `x`. Returns 0 where `a` is singular to a
// hundred roundings, or not finite.
static int robot_general(double a[ROBOT_DOF][ROBOT_DOF], double x[ROBOT_DOF]) {
    double scale = 0.0;
    for (int i = 0; i < ROBOT_DOF; ++i) {
        for (int j = 0; j < ROBOT_DOF; ++j) {
            scale = fabs(a[i][j]) > scale ? fabs(a[i][j]) : scale;
        }
    }
    for (int column = 0; column < ROBOT_DOF; ++column) {
        int largest = column;
        for (int row = column + 1; row < ROBOT_DOF; ++row) {
            largest = fabs(a[row][column]) > fabs(a[largest][column]) ? row : largest;
        }
        const double size = fabs(a[largest][column]);
        if (!(size > 1.1102230246251565e-14 * scale && size < HUGE_VAL)) {
            return 0;
        }
        for (int k = 0; k < ROBOT_DOF; ++k) {
            const double upper = a[column][k];
            a[column][k] = a[largest][k];
            a[largest][k] = upper;
        }
        const double upper = x[column];
        x[column] = x[largest];
        x[largest] = upper;
        for (int row = column + 1; row < ROBOT_DOF; ++row) {
            const double factor = a[row][column] / a[column][column];
            for (int k = column; k < ROBOT_DOF; ++k) {
                a[row][k] -= factor * a[column][k];
            }
            x[row] -= factor * x[column];
        }
    }
    for (int row = ROBOT_DOF - 1; row >= 0; --row) {
        for (int k = row + 1; k < ROBOT_DOF; ++k) {
            x[row] -= a[row][k] * x[k];
        }
        x[row] /= a[row][row];
    }
    return 1;
}
