/// Viscous friction that changes while the log runs, with no logged column to account for it: an arm that warms up.
///
/// `fv (1 - exp(-t / settle)) / (1 - exp(-60 s / settle)) dq` on top of `viscous_friction`: nothing at the start of
/// the log, `fv` a minute later, however long it takes to settle. Negative where friction falls.
///
/// Identifiable from logs that are not much shorter than the time it takes, where similar motions come early and late.
///
/// Confused with `viscous_friction`: where it has settled soon after the start, nothing but viscous friction is left. Parted by
/// a log that begins before the change does.
///
/// Confused with `temperature_viscous`: a temperature that rises all along is a clock. Parted by a pause in which the arm cools,
/// or by a log of a cold and one of a warm arm.
effect parameter_drift(j) {
    /// Change of the viscous coefficient in the first minute, N m s/rad (N s/m for a prismatic joint).
    linear fv;
    /// Time in which most of it happens, s.
    shape settle in 2 .. 500;
    torque(j) = fv * (1 - exp(-time / settle)) / (1 - exp(-60 / settle)) * dq(j);
}
