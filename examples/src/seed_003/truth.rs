//! Numbers of the paper. It has no tables: they stand in its section 2.5 (the rig) and section 3 (results).

/// The friction of the results: the text prints `F_c` twice, and the larger one is `F_s`.
pub const COULOMB: f64 = 0.5843;
/// N m.
pub const BREAKAWAY: f64 = 2.002;
/// N m s/rad.
pub const VISCOUS: f64 = 0.1328;
/// rad/s.
pub const STRIBECK: f64 = 0.8379;
/// `s0` after the fit, with the unit that makes (8) a torque, N m/rad.
pub const STIFFNESS: f64 = 2.15;
/// `s1` after the fit, N m s/rad.
pub const DAMPING: f64 = 1.34;

/// First values of `s0` and `s1`, of equations (18) and (22).
pub const FIRST: [f64; 2] = [1.937, 1.401];

/// The link: its length, m, and its mass, kg.
pub const LENGTH: f64 = 0.21;
/// kg.
pub const MASS: f64 = 0.045;
/// m/s^2.
pub const GRAVITY: f64 = 9.81;
/// What stands for a third in equation (7).
pub const PRINTED_THIRD: f64 = 0.3;

/// Largest torque of the motor, kgf cm, and its largest speed, turns a minute.
pub const STALL_KGF_CM: f64 = 11.1;
/// Turns a minute.
pub const LARGEST_SPEED: f64 = 83.0;
/// N m of a kgf cm.
pub const KGF_CM: f64 = 0.098_066_5;

/// How far the link may go, degrees.
pub const RANGE_DEG: [f64; 2] = [30.0, 310.0];
/// Speeds of the curve.
pub const SPEEDS: usize = 20;

/// Gains of the speed loop: proportional, integral, derivative.
pub const PID: [f64; 3] = [1.25, 3.15, 0.55];
/// Its samples, Hz.
pub const LOOP_HZ: f64 = 1000.0;
/// Samples of the sensors, Hz.
pub const SENSOR_HZ: f64 = 10_000.0;

/// Bits of the encoder, and the step that the text gives it, degrees.
pub const BITS: i32 = 12;
/// Degrees.
pub const PRINTED_STEP_DEG: f64 = 0.008;
/// The resolution of the conclusion, rad.
pub const RESOLUTION: f64 = 0.002;

/// The current transducer: primary over secondary turns, its resistor, ohm, and the largest current, A.
pub const TURNS: f64 = 5.0 / 1000.0;
/// Ohm.
pub const RESISTOR: f64 = 670.0;
/// A.
pub const LARGEST_CURRENT: f64 = 0.8;

/// The converter, an ADS1256: it counts so many bits over twice this voltage.
pub const CONVERTER_VOLTS: f64 = 5.0;
/// Bits.
pub const CONVERTER_BITS: i32 = 24;

/// Torque of a current, N m/A: the paper has none, and this one makes of the largest current the largest torque.
pub const TORQUE_CONSTANT: f64 = 1.3607;
