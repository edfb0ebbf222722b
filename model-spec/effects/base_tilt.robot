/// A base with another orientation than in the spec: gravity comes from another direction.
///
/// The base is rotated by two angles about the axes of its frame that are not along gravity: for gravity along z first about x,
/// then about y. A rotation about gravity has no effect.
///
/// Identifiable if a joint that the tilt loads moves through a large part of a turn; with unknown inertials, by the axes that
/// gravity did not load before.
///
/// Confused with `encoder_offset`: for an arm in a vertical plane a tilt in that plane equals an offset of the first joint
/// exactly. Distinguished by no motion there; in other arms by motion of the joints whose axes are not parallel to the first.
///
/// Confused with `torque_offset`: in similar poses the torque of gravity changes by a constant. Distinguished by poses over a
/// good part of a turn.
effect base_tilt() {
    /// Angle about the first axis, rad.
    shape first in -0.3 .. 0.3 step 0.05;
    /// Angle about the second axis, rad.
    shape second in -0.3 .. 0.3 step 0.05;
    tilt = [first, second];
}
