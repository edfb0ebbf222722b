/// A rigid body that the arm carries and its spec does not: a tool, a load in the gripper.
///
/// A body fixed to the link of joint `j`, as a rule the last one: mass, first moments and inertia about the origin of that
/// link's frame. Rigid-body torque is linear in them, so they are identified as the columns of the link.
///
/// Identifiable where the link's own inertial is `fixed`, so that what is more can be told from it; else it is in the base
/// parameters of the link already.
effect payload(j) {
    /// Mass, kg.
    linear m >= 0;
    /// First moment, kg m.
    linear mx, my, mz;
    /// Inertia about the frame's origin, kg m^2.
    linear ixx, ixy, ixz, iyy, iyz, izz;
    body(j) = [m, mx, my, mz, ixx, ixy, ixz, iyy, iyz, izz];
}
