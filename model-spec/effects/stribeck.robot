/// Friction that falls with speed as lubricant is drawn between the surfaces (Stribeck).
///
/// `fs * exp(-(dq/vs)^2) * sign(dq)` on top of Coulomb friction: `fc + fs` at breakaway, `fc` at several times `vs`.
///
/// Identifiable from slow reversals, with many samples below two times `vs`.
///
/// Confused with `coulomb_friction`: in motion that is slower than `vs` all along both are a constant against the motion. Parted
/// by speeds from slow ones to several times `vs`.
///
/// Confused with `dahl`: both are felt next to reversals, the one over a range of speeds, the other over a way. Parted by slow
/// motion over long ways, and by reversals of several accelerations.
effect stribeck(j) {
    /// Breakaway minus Coulomb torque, N m (N for a prismatic joint).
    linear fs >= 0;
    /// Stribeck speed, rad/s (m/s for a prismatic joint).
    shape vs in 0.005 .. 0.5;
    torque(j) = fs * exp(-(dq(j)/vs)^2) * sign(dq(j));
}
