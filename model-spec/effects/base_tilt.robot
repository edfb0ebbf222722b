/// A base that does not stand as the spec says: gravity comes from another direction.
///
/// The base is turned by two angles about the axes of its frame that are not along gravity: for gravity along z first about x,
/// then about y. Turning it about gravity itself changes nothing.
///
/// Identifiable where a joint that the tilt loads moves through a good part of a turn; where all inertials are unknown, through
/// the axes that gravity did not load before.
///
/// Confused with `encoder_offset`: of an arm in a vertical plane a tilt in that plane is the offset of the first joint, to the
/// last digit. Parted by no motion there; in other arms by motion of the joints whose axes are not parallel to the first.
///
/// Confused with `torque_offset`: in poses that are alike the torque of gravity changes by a constant. Parted by poses over a
/// good part of a turn.
effect base_tilt() {
    /// Angle about the first axis, rad.
    shape first in -0.3 .. 0.3 step 0.05;
    /// Angle about the second axis, rad.
    shape second in -0.3 .. 0.3 step 0.05;
    tilt = [first, second];
}
