/// Dry friction that changes while the log runs, with no logged column to account for it: seals that wear in, grease that warms up.
///
/// `fc (1 - exp(-t / settle)) sign(dq)` on top of `coulomb_friction`: nothing at the start of the log, `fc` at its end. Negative where
/// friction falls. Identifiable as `parameter_drift` is, and told from it where speeds differ.
effect dry_friction_drift(j) {
    kind parameter_drift;
    /// Change of the dry friction, N m (N for a prismatic joint).
    linear fc;
    /// Time in which most of it happens, s.
    shape settle in 2 .. 500;
    torque(j) = fc * (1 - exp(-time / settle)) * sign(dq(j));
}
