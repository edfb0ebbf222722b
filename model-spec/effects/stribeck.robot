/// Friction that falls with speed as lubricant is drawn between the surfaces (Stribeck).
///
/// `fs * exp(-(dq/vs)^2) * sign(dq)` on top of Coulomb friction: `fc + fs` at breakaway, `fc` at several times `vs`.
///
/// Identifiable from slow reversals, with many samples below two times `vs`.
///
/// Confused with `coulomb_friction`: in motion that is always slower than `vs` both are a constant against the motion.
/// Distinguished by speeds from slow ones to several times `vs`.
///
/// Confused with `dahl`: both appear near reversals, one over a range of speeds, the other over a travel. Distinguished by slow
/// motion over long travels, and by reversals of several accelerations.
effect stribeck(j) {
    /// Breakaway minus Coulomb torque, N m (N for a prismatic joint).
    linear fs >= 0;
    /// Stribeck speed, rad/s (m/s for a prismatic joint).
    shape vs in 0.005 .. 0.5;
    torque(j) = fs * exp(-(dq(j)/vs)^2) * sign(dq(j));
}
