/// Dry friction that changes while the log runs, with no logged column to account for it: seals that wear in, grease that warms
/// up.
///
/// `fc (1 - exp(-t / settle)) / (1 - exp(-60 s / settle)) sign(dq)` on top of `coulomb_friction`: nothing at the start of
/// the log, `fc` a minute later, however long it takes to settle. Negative where friction falls.
///
/// Identifiable from logs that are not much shorter than the time it takes, where similar motions come early and late.
///
/// Confused with `parameter_drift`: at one speed both are a constant against the motion that changes with time. Parted by
/// several speeds, early and late.
///
/// Confused with `coulomb_friction`: where it has settled soon after the start, nothing but a constant is left. Parted by a log
/// that begins before the change does.
effect dry_friction_drift(j) {
    kind parameter_drift;
    /// Change of the dry friction in the first minute, N m (N for a prismatic joint).
    linear fc;
    /// Time in which most of it happens, s.
    shape settle in 2 .. 500;
    torque(j) = fc * (1 - exp(-time / settle)) / (1 - exp(-60 / settle)) * sign(dq(j));
}
