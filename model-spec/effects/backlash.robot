/// Play between motor and link: teeth that do not touch on both sides.
///
/// The encoder is on the motor's side. The link leans on the side to which its load presses it, `half_gap` from the middle, and crosses
/// the gap when the load changes sign. Identifiable where the load changes sign often while the joint moves, and the gap is many
/// encoder steps wide.
effect backlash(j) {
    /// Half the width of the gap, rad (m for a prismatic joint).
    shape half_gap in 0.00005 .. 0.05;
    position(j) = -half_gap * sign(rigid_torque(j));
}
