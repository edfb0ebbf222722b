/// Inertia of the rotor and of the fast gear stages, seen at the joint.
///
/// `ia * ddq`, with `ia` the rotor's inertia times the square of the gear ratio.
///
/// Identifiable from accelerations of joints further out. On the first joint it adds to the link's `izz` and cannot be
/// separated from it.
///
/// Confused with `link_inertial_error`: at its own joint a rotor acts like a moment of inertia about the axis. Distinguished by
/// motion of the joints before it, which the link loads and the rotor does not; on the first joint by none.
effect motor_inertia(j) {
    /// Reflected inertia, kg m^2 (kg for a prismatic joint).
    linear ia >= 0;
    torque(j) = ia * ddq(j);
}
