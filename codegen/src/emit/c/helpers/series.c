// `(exp(x) - 1) / x` near 0 by Horner's rule, `1 + x/2 (1 + x/3 (1 + ..))`, where the quotient would cancel.
static double robot_series(double x) {
    double sum = 1.0;
    for (int k = 15; k >= 2; --k) {
        sum = 1.0 + x * (1.0 / k) * sum;
    }
    return sum;
}
