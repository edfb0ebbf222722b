/// The error of a link's `fixed` inertial: the difference to the spec.
///
/// A body fixed to the link of joint `j` whose mass may be negative: the true inertial parameters less those of the spec, about
/// the origin of the link's frame.
///
/// Identifiable in the combinations of the base parameters; on the last link it looks like a payload.
///
/// Confused with `payload`: on the same link both are a body, of which one may have a negative mass. Distinguished by no
/// motion, but by the sign of the mass, and by a log without the load.
///
/// Confused with `torque_gain`: at the link's own joint both are in proportion to inertia and gravity. Distinguished by motion
/// in which the joints before it also carry the link: a body loads them, a gain does not.
effect link_inertial_error(j) {
    /// Mass, kg.
    linear m;
    /// First moment, kg m.
    linear mx, my, mz;
    /// Inertia about the frame's origin, kg m^2.
    linear ixx, ixy, ixz, iyy, iyz, izz;
    body(j) = [m, mx, my, mz, ixx, ixy, ixz, iyy, iyz, izz];
}
