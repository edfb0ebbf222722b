/// Dry friction that builds up over a displacement (Dahl's model), in place of Coulomb friction.
///
/// `dz/dt = (dq - abs(dq) z) / d`, `torque = fc z`: after a reversal the torque goes from one side to the other like `1 - 2
/// exp(-distance / d)`, at any speed. The loops of torque over position lose energy. It is `cable_hysteresis` with `beta = 1`
/// and `n = 1`. Source: Dahl 1968.
///
/// Identifiable from reversals that an encoder resolves into some ten steps per `d`; over much longer distances it is Coulomb
/// friction.
///
/// Confused with `coulomb_friction`: over distances much longer than `d` it is the same. Distinguished by reversals after a
/// short travel.
effect dahl(j) {
    /// Torque of sliding, N m (N for a prismatic joint).
    linear fc >= 0;
    /// Distance over which friction builds up, rad (m for a prismatic joint).
    shape d in 1e-4 .. 0.3;
    /// Torque over that of sliding.
    state z;
    dot(z) = (dq(j) - abs(dq(j)) * z) / d;
    torque(j) = fc * z;
}
