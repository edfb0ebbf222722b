/// An external force on the arm: contact with a table, a hand that leans on it, a cable that pulls.
///
/// The force is on the origin of the link of joint `j`, as a rule the last one, constant in the axes of the base from `start`
/// to `end` of the log; the motors hold against it with `-J^T F`. A force that repeats in every period of the motion is
/// `recurring_force`.
///
/// Identifiable if the arm keeps moving during the contact, also through other poses.
///
/// Confused with `torque_offset`: in one pose a force is an offset of the torques. Distinguished by many poses while it acts,
/// and by a log in which it begins or ends.
///
/// Confused with `payload`: a permanent force along gravity looks like the weight of a mass. Distinguished by accelerations,
/// which a mass resists and a force does not, and by a log in which the force begins or ends.
///
/// Confused with `recurring_force`: in a log of one period both occur once. Distinguished by several periods.
effect external_force(j) {
    /// Force along the axes of the base, N.
    linear fx, fy, fz;
    /// When it begins after the start of the log, s.
    shape start in 0 .. 60 step 2;
    /// When it ends after the start of the log, s.
    shape end in 0 .. 60 step 2;
    let touched = if time < start { 0 } else if time < end { 1 } else { 0 };
    force(j) = [fx * touched, fy * touched, fz * touched];
}
