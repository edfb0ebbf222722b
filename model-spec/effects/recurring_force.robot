/// An external force on the arm that repeats in every period of the motion: a part that is touched, a guide, a press.
///
/// As `external_force`, from `start` to `end` of the period of a repeating motion, both as shares of it; with an end before its
/// start it continues into the next period. `motion_phase` is 0 at the start of the log and of every period, and 1 before the
/// next; `identify` and `trace` find the period from the positions.
///
/// Identifiable if the force acts in only some of the poses, as a function of the pose alone looks like springs and gravity.
///
/// Confused with `joint_spring`: if the force acts in most of the poses, it may be a function of them. Distinguished by motion
/// through the same poses with and without the force.
effect recurring_force(j) {
    kind external_force;
    /// Force along the axes of the base, N.
    linear fx, fy, fz;
    /// Where in the period it begins.
    shape start in 0 .. 1 step 0.05;
    /// Where in the period it ends.
    shape end in 0 .. 1 step 0.05;
    input motion_phase;
    let begun = if motion_phase < start { 0 } else { 1 };
    let over = if motion_phase < end { 0 } else { 1 };
    let touched = begun - over + if start <= end { 0 } else { 1 };
    force(j) = [fx * touched, fy * touched, fz * touched];
}
