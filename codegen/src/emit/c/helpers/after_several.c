// `robot_after` for the states of one effect, which depend on each other: `slopes[i * count + j]` is the slope of rate `i` by
// state `j`. `phi` of the matrix is its series where the matrix is small, and `phi(2 A) = phi(A) + phi(A) A phi(A) / 2` from
// there.
static void robot_after_several(int count, double seconds, const double *rates, const double *slopes, double *z) {
    double a[ROBOT_STATES * ROBOT_STATES];
    double phi[ROBOT_STATES * ROBOT_STATES];
    double product[ROBOT_STATES * ROBOT_STATES];
    int is_smooth = 1;
    for (int k = 0; k < count * count; ++k) {
        is_smooth = is_smooth && fabs(slopes[k]) < HUGE_VAL;
    }
    double norm = 0.0;
    for (int i = 0; i < count; ++i) {
        double row = 0.0;
        for (int j = 0; j < count; ++j) {
            a[i * count + j] = is_smooth ? slopes[i * count + j] * seconds : 0.0;
            phi[i * count + j] = i == j ? 1.0 : 0.0;
            row += fabs(a[i * count + j]);
        }
        norm = fmax(norm, row);
    }
    int halvings = 0;
    double scale = 1.0;
    // What overflows is infinite however often it is halved: no number comes out, and the states stay.
    while (norm * scale > 0.5 && norm < HUGE_VAL) {
        scale *= 0.5;
        ++halvings;
    }
    for (int k = 0; k < count * count; ++k) {
        a[k] *= scale;
    }
    for (int k = 15; k >= 2; --k) {
        robot_product(count, a, phi, product);
        for (int i = 0; i < count * count; ++i) {
            phi[i] = product[i] / k + (i % (count + 1) == 0 ? 1.0 : 0.0);
        }
    }
    for (int step = 0; step < halvings; ++step) {
        double half[ROBOT_STATES * ROBOT_STATES];
        robot_product(count, phi, a, product);
        robot_product(count, product, phi, half);
        for (int k = 0; k < count * count; ++k) {
            phi[k] += half[k] * 0.5;
            a[k] *= 2.0;
        }
    }
    int is_finite = 1;
    for (int k = 0; k < count; ++k) {
        is_finite = is_finite && fabs(rates[k]) < HUGE_VAL;
    }
    for (int i = 0; i < count; ++i) {
        double increment = 0.0;
        for (int j = 0; j < count; ++j) {
            increment += phi[i * count + j] * rates[j];
        }
        const double next = z[i] + increment * seconds;
        z[i] = is_finite && fabs(next) < HUGE_VAL ? next : z[i];
    }
}
