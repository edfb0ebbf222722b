/// Torque of a hose or a cable bundle that is bent back and forth (Bouc-Wen model).
///
/// `dz/dt = dq / width (1 - abs(z)^n (beta sign(dq z) + 1 - beta))`, `torque = f z`, with `abs(z) <= 1`. In the usual form,
/// `dw/dt = dq (1 - abs(w)^n (B sign(dq w) + C))` and `torque = D w`, it is `w = width z`, `D = f / width`, `B = beta /
/// width^n`, `C = (1 - beta) / width^n`. Loops of torque over position, wider than those of dry friction, that lose energy for
/// `beta >= 0.5`. Sources: Bouc 1967, Wen 1976.
///
/// Identifiable from reversals at several amplitudes.
///
/// Confused with `dahl`: with `beta = 1` and `n = 1` it is the same law; with others its loops bend otherwise. Distinguished by
/// reversals at several amplitudes, small ones among them.
///
/// Confused with `coulomb_friction`: over travels much longer than `width` it is a constant against the motion. Distinguished
/// by reversals after a short travel.
///
/// Confused with `joint_spring`: in motion much smaller than `width` the torque follows the position. Distinguished by motion
/// over several times `width`.
effect cable_hysteresis(j) {
    /// Torque on the far sides of the loop, N m (N for a prismatic joint).
    linear f >= 0;
    /// Travel over which the torque builds up, rad (m for a prismatic joint).
    shape width in 0.005 .. 1;
    /// How much the way back differs from the way there: 0.5 goes back along a straight line.
    shape beta in 0.2 .. 1.1 step 0.45;
    /// How sharply the loop bends into its far sides.
    shape n in 0.5 .. 2.5 step 1;
    /// Torque over that on the far sides.
    state z;
    dot(z) = dq(j) / width * (1 - abs(z)^n * (beta * sign(dq(j) * z) + 1 - beta));
    torque(j) = f * z;
}
