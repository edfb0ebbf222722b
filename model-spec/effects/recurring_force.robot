/// A force of the world on the arm that comes back in every period of the motion: a part that is touched on the way, a guide, a
/// press.
///
/// As `external_force`, from `start` to `end` of the period of a motion that repeats, both as shares of it; from an end before
/// its start it goes on into the next period. `motion_phase` is 0 at the start of the log and of every period, and 1 before the
/// next; `identify` and `trace` find the period in the positions.
///
/// Identifiable where the force is there in some of the poses only, as what follows from the pose alone may be taken for springs
/// and gravity.
///
/// Confused with `joint_spring`: where the force is there in most of the poses it may be a function of them. Parted by motion
/// that passes the same poses with the force and without it.
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
