/// A force of the world on the arm: contact with a table, a hand that leans on it, a cable that pulls.
///
/// The force is on the origin of the link of joint `j`, as a rule the last one, constant in the axes of the base from `start` to
/// `end` of the log; the motors hold against it with `-J^T F`. What comes back in every period of the motion is
/// `recurring_force`.
///
/// Identifiable where the arm moves on while it is touched, in other poses too.
///
/// Confused with `torque_offset`: in one pose a force is an offset of the torques. Parted by many poses while it is there, and
/// by a log in which it comes or goes.
///
/// Confused with `payload`: a force along gravity that is there all the time is the weight of a mass. Parted by accelerations,
/// which a mass resists and a force does not, and by a log in which the force comes or goes.
///
/// Confused with `recurring_force`: in a log of one period both are there once. Parted by several periods.
effect external_force(j) {
    /// Force along the axes of the base, N.
    linear fx, fy, fz;
    /// When it begins, s since the start of the log.
    shape start in 0 .. 60 step 2;
    /// When it ends, s since the start of the log.
    shape end in 0 .. 60 step 2;
    let touched = if time < start { 0 } else if time < end { 1 } else { 0 };
    force(j) = [fx * touched, fy * touched, fz * touched];
}
