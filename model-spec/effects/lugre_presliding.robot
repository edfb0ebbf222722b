/// Friction of bristles that deflect before they slide (the `LuGre` model), instead of Coulomb friction.
///
/// With the bristles' deflection in units of that at which they slide, `z = s0 deflection / fc`: `dz/dt = (dq - abs(dq) z / g)
/// / d`, `g = 1 + rise exp(-(dq/vs)^2)`, `torque = fc z + s1 d dz/dt`. The stiffness of the bristles is `s0 = fc / d`. At
/// constant speed `z = g`: the torque is `fc + (fs - fc) exp(-(dq/vs)^2)`, with `fs = (1 + rise) fc`. Declare viscous friction
/// separately. Source: Canudas de Wit, Olsson, Astrom, Lischinsky 1995.
///
/// Identifiable in `fc` and `rise` like Coulomb friction and Stribeck's; in `d` and `s1` from reversals that an encoder
/// resolves into some ten steps per `d`.
///
/// Confused with `dahl`: with `rise = 0` and without `s1` it is the same. Distinguished by slow motion over longer travels,
/// where friction falls with speed, and by fast reversals.
///
/// Confused with `cable_hysteresis`: after a reversal both build up over a travel, and loops differ in how they bend. Distinguished
/// by reversals at several amplitudes, and by slow motion over longer travels, where friction of bristles falls with speed.
///
/// Confused with `stribeck`, `coulomb_friction`: over distances much longer than `d` bristles slide, and friction only depends
/// on the speed. Distinguished by reversals after a short travel.
effect lugre_presliding(j) {
    /// Torque of sliding, N m (N for a prismatic joint).
    linear fc >= 0;
    /// Damping of the bristles, N m s/rad (N s/m for a prismatic joint).
    linear s1 >= 0;
    /// Deflection at which the bristles slide, rad (m for a prismatic joint).
    shape d in 1e-4 .. 0.5;
    /// Stribeck speed, rad/s (m/s for a prismatic joint).
    shape vs in 0.005 .. 1.5;
    /// Breakaway torque over that of sliding, less one.
    shape rise in 0 .. 3 step 1.5;
    /// Deflection of the bristles over that of sliding.
    state z;
    let g = 1 + rise * exp(-(dq(j)/vs)^2);
    dot(z) = (dq(j) - abs(dq(j)) * z / g) / d;
    torque(j) = fc * z + s1 * d * dot(z);
}
