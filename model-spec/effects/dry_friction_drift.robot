/// Dry friction that changes while the log runs, without a logged column that explains it: seals that wear in, grease that
/// warms up.
///
/// `fc (1 - exp(-t / settle)) / (1 - exp(-60 s / settle)) sign(dq)` on top of `coulomb_friction`: zero at the start of the log,
/// `fc` a minute later, for any settling time. Negative if friction falls.
///
/// Identifiable from logs not much shorter than the settling time, with similar motions early and late.
///
/// Confused with `parameter_drift`: at one speed both are a constant against the motion that changes with time. Distinguished
/// by several speeds, early and late.
///
/// Confused with `coulomb_friction`: if it settles soon after the start, only a constant remains. Distinguished by a log that
/// begins before the change does.
effect dry_friction_drift(j) {
    kind parameter_drift;
    /// Change of the dry friction in the first minute, N m (N for a prismatic joint).
    linear fc;
    /// Time in which most of it happens, s.
    shape settle in 2 .. 500;
    torque(j) = fc * (1 - exp(-time / settle)) / (1 - exp(-60 / settle)) * sign(dq(j));
}
