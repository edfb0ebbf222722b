/// Inertia of the rotor and of the fast gear stages, seen at the joint.
///
/// `ia * ddq`, with `ia` the rotor's inertia times the square of the gear ratio. On the first joint it adds to the link's
/// `izz` and cannot be told from it; further out it can.
effect motor_inertia(j) {
    /// Reflected inertia, kg m^2 (kg for a prismatic joint).
    linear ia >= 0;
    torque(j) = ia * ddq(j);
}
