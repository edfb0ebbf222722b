/// A torque channel that comes later than the position channel: a filter in the drive, a bus, another clock.
///
/// The log has at `t` the torque of `t - delay`. A fault of the log and not of the arm: emitted equations do not know it.
///
/// Identifiable where accelerations are large, as the torque of inertia changes fastest; beside unknown viscous friction in more
/// than one pose.
///
/// Confused with `viscous_friction`: in one pose gravity grows with the position, and what is late by `delay` lags by `delay`
/// times the speed. Parted by large accelerations and more than one pose.
///
/// Confused with `encoder_offset`: at a constant speed a joint that is seen late is seen elsewhere. Parted by motion in both
/// directions.
effect time_delay() {
    /// Seconds; negative where the torque comes early.
    shape delay in -0.03 .. 0.03 step 0.005;
    delay = delay;
}
