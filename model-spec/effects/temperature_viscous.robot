/// Viscous friction of a lubricant that thins as it warms up.
///
/// `fv exp(-beta (T - 20)) dq`, with the temperature `T` from the log's column `temperature` in degrees Celsius: `fv` is the
/// coefficient at 20 degrees. It is the whole viscous friction; together with `viscous_friction` it is the part that changes.
///
/// Identifiable where the temperature changes by some degrees while the joint moves.
///
/// Confused with `viscous_friction`: at one temperature it is the same. Distinguished by the same motion of a cold and of a
/// warm arm.
effect temperature_viscous(j) {
    /// Temperature of the gear or its oil, degrees Celsius.
    input temperature;
    /// Viscous coefficient at 20 degrees Celsius, N m s/rad (N s/m for a prismatic joint).
    linear fv >= 0;
    /// Relative fall per degree, 1/K.
    shape beta in 0.005 .. 0.2;
    torque(j) = fv * exp(-beta * (temperature - 20)) * dq(j);
}
