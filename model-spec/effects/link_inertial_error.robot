/// A link whose `fixed` inertial is wrong: what it has more, or less, than the spec says.
///
/// A body fixed to the link of joint `j` whose mass may be negative: the true inertial parameters less those of the spec, about
/// the origin of the link's frame.
///
/// Identifiable in the combinations that base parameters have; of the last link this is what a payload looks like.
///
/// Confused with `payload`: on the same link both are a body, of which one may have a negative mass. Parted by no motion, but by
/// the sign of the mass, and by a log without the load.
///
/// Confused with `torque_gain`: at the link's own joint both are in proportion to inertia and gravity. Parted by motion in which
/// the joints before it carry the link as well: they feel a body and no gain.
effect link_inertial_error(j) {
    /// Mass, kg.
    linear m;
    /// First moment, kg m.
    linear mx, my, mz;
    /// Inertia about the frame's origin, kg m^2.
    linear ixx, ixy, ixz, iyy, iyz, izz;
    body(j) = [m, mx, my, mz, ixx, ixy, ixz, iyy, iyz, izz];
}
