/// Play between motor and link: teeth that do not touch on both sides.
///
/// The encoder is on the motor's side. The link leans on the side to which its load presses it, `half_gap` from the middle, and
/// crosses the gap when the load changes sign.
///
/// Identifiable where the load changes sign often while the joint moves, and the gap is many encoder steps wide.
///
/// Confused with `encoder_offset`: a gap that is never crossed shifts the link by half its width, and so does a wrong zero.
/// Parted by loads of both signs.
///
/// Confused with `joint_elasticity`: both leave the link behind by its load, the one by a step, the other in proportion. Parted
/// by small and large loads of both signs.
///
/// Confused with `dahl`: both are felt where the motion turns round. Parted by motion that turns round under a load that keeps
/// its sign: then the gap is not crossed.
effect backlash(j) {
    /// Half the width of the gap, rad (m for a prismatic joint).
    shape half_gap in 0.00005 .. 0.05;
    position(j) = -half_gap * sign(rigid_torque(j));
}
