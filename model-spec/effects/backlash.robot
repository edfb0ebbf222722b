/// Play between motor and link, as in gear teeth.
///
/// The encoder is on the motor's side. The load presses the link to one side, `half_gap` from the middle; the link crosses the
/// gap when the load changes sign.
///
/// Identifiable where the load changes sign often while the joint moves, and the gap is many encoder steps wide.
///
/// Confused with `encoder_offset`: a gap that is never crossed shifts the link by half its width, and so does a wrong zero.
/// Distinguished by loads of both signs.
///
/// Confused with `joint_elasticity`: in both the load displaces the link, in one by a step, in the other in proportion.
/// Distinguished by small and large loads of both signs.
///
/// Confused with `dahl`: both appear at velocity reversals. Distinguished by reversals under a load that keeps its sign: then
/// the gap is not crossed.
effect backlash(j) {
    /// Half the width of the gap, rad (m for a prismatic joint).
    shape half_gap in 0.00005 .. 0.05;
    position(j) = -half_gap * sign(rigid_torque(j));
}
