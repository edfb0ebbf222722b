/// A joint whose zero is not where the spec has it.
///
/// The logged position is `offset` more than that of the link. Gravity and the inertia of bent arms tell it.
///
/// Identifiable in poses over a good part of a turn. It cannot be told from first moments where the joint's axis is the first
/// horizontal one and links are unknown: turning that joint turns those too.
///
/// Confused with `torque_offset`: in poses that are alike gravity changes by a constant. Parted by poses over a good part of a
/// turn.
effect encoder_offset(j) {
    /// Logged position less the true one, rad (m for a prismatic joint).
    shape offset in -0.3 .. 0.3 step 0.05;
    position(j) = -offset;
}
