/// Viscous friction that changes while the log runs, with no logged column to account for it: an arm that warms up.
///
/// `fv (1 - exp(-t / settle)) dq` on top of `viscous_friction`: nothing at the start of the log, `fv` at its end. Negative
/// where friction falls. Identifiable from logs that are not much shorter than the time it takes, where similar motions come
/// early and late.
effect parameter_drift(j) {
    /// Change of the viscous coefficient, N m s/rad (N s/m for a prismatic joint).
    linear fv;
    /// Time in which most of it happens, s.
    shape settle in 2 .. 500;
    torque(j) = fv * (1 - exp(-time / settle)) * dq(j);
}
