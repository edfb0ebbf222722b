/// A rigid body that the arm carries but its spec lacks: a tool, a load in the gripper.
///
/// A body fixed to the link of joint `j`, as a rule the last one: mass, first moments and inertia about the origin of that
/// link's frame. Rigid-body torque is linear in them, so they are identified as the columns of the link.
///
/// Identifiable if the link's own inertial is `fixed`; else it is part of the link's base parameters.
effect payload(j) {
    /// Mass, kg.
    linear m >= 0;
    /// First moment, kg m.
    linear mx, my, mz;
    /// Inertia about the frame's origin, kg m^2.
    linear ixx, ixy, ixz, iyy, iyz, izz;
    body(j) = [m, mx, my, mz, ixx, ixy, ixz, iyy, iyz, izz];
}
