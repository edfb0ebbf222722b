/// A torque channel that is late against the position channel: a filter in the drive, a bus, another clock.
///
/// The log has at `t` the torque of `t - delay`. A fault of the log, not of the arm: emitted equations do not include it.
///
/// Identifiable with large accelerations, as the torque of inertia changes fastest; with unknown viscous friction in more than
/// one pose.
///
/// Confused with `viscous_friction`: in one pose gravity grows with the position, and a signal that is late by `delay` lags by
/// `delay` times the speed. Distinguished by large accelerations and more than one pose.
///
/// Confused with `encoder_offset`: at a constant speed a late position is an offset position. Distinguished by motion in both
/// directions.
effect time_delay() {
    /// By how much the torque is late, s. Negative where it comes early.
    shape delay in -0.03 .. 0.03 step 0.005;
    delay = delay;
}
