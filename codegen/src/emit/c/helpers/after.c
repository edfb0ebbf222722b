// `z + h phi(h J) f` with `phi(x) = (exp(x) - 1) / x`, the exponential step of one state whose rate is `f` and whose slope is
// `J`: exact where the rate is affine in the state, stable however stiff (Hochbruck & Ostermann 2010, Exponential integrators).
// Where the rate is no number the state stays; where only the slope is none the step is one of Euler.
static double robot_after(double z, double seconds, double rate, double slope) {
    const double x = fabs(slope) < HUGE_VAL ? slope * seconds : 0.0;
    const double phi = fabs(x) > 0.5 ? expm1(x) / x : robot_series(x);
    const double next = z + rate * (phi * seconds);
    return fabs(next) < HUGE_VAL ? next : z;
}
