/// Viscous friction that changes while the log runs, without a logged column that explains it: an arm that warms up.
///
/// `fv (1 - exp(-t / settle)) / (1 - exp(-60 s / settle)) dq` on top of `viscous_friction`: zero at the start of the log, `fv`
/// a minute later, for any settling time. Negative if friction falls.
///
/// Identifiable from logs not much shorter than the settling time, with similar motions early and late.
///
/// Confused with `viscous_friction`: if it settles soon after the start, only viscous friction remains. Distinguished by a log
/// that begins before the change does.
///
/// Confused with `temperature_viscous`: a temperature that rises steadily acts like time. Distinguished by a pause in which the
/// arm cools, or by a log of a cold and one of a warm arm.
effect parameter_drift(j) {
    /// Change of the viscous coefficient in the first minute, N m s/rad (N s/m for a prismatic joint).
    linear fv;
    /// Time in which most of it happens, s.
    shape settle in 2 .. 500;
    torque(j) = fv * (1 - exp(-time / settle)) / (1 - exp(-60 / settle)) * dq(j);
}
