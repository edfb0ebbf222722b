/// A joint whose zero differs from that of the spec.
///
/// The logged position is `offset` more than that of the link. It is visible in gravity and in the inertia of bent arms.
///
/// Identifiable in poses over a good part of a turn. It cannot be separated from first moments if the joint's axis is the first
/// horizontal one and links are unknown: an offset of that joint rotates these too.
///
/// Confused with `torque_offset`: in similar poses gravity changes by a constant. Distinguished by poses over a good part of a
/// turn.
effect encoder_offset(j) {
    /// Logged position less the true one, rad (m for a prismatic joint).
    shape offset in -0.3 .. 0.3 step 0.05;
    position(j) = -offset;
}
