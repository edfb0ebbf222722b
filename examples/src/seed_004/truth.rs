//! Numbers of the paper.

/// Installations of the device, in the order of tables 1 and 2.
pub const CONFIGURATIONS: [&str; 5] = ["UR", "GCW", "FS", "USD", "USD+GCW"];

/// Names of the parameters of tables 1, in the order of (10).
pub const NAMES: [&str; 14] = [
    "pi1",
    "pi2",
    "pi3",
    "pi4",
    "pi5",
    "pi6",
    "pi7",
    "pi8",
    "theta1.viscous_friction.fv",
    "theta2.viscous_friction.fv",
    "theta3.viscous_friction.fv",
    "theta1.coulomb_friction.fc",
    "theta2.coulomb_friction.fc",
    "theta3.coulomb_friction.fc",
];

/// Parameters of one installation, SI, in the order of [`NAMES`].
pub type Pi = [f64; 14];

/// Table 1 times 1000: a line a parameter, a column an installation.
const TABLE_1: [[f64; 5]; 14] = [
    [1.42, 3.40, 1.02, 1.20, 3.04],
    [1.35, 4.43, 2.16, 1.61, 3.29],
    [-0.40, -1.17, -0.76, -0.51, -0.73],
    [0.69, 9.23, 3.00, 0.65, 9.19],
    [2.08, 7.54, 3.47, 2.85, 6.37],
    [0.95, 3.55, 1.13, 1.28, 3.15],
    [-19.23, 26.92, 46.84, 21.24, -16.59],
    [-109.96, 46.52, -69.08, 108.75, -112.45],
    [-2.08, -2.71, -0.91, -1.35, -0.10],
    [-1.28, 0.10, -0.32, -0.14, 0.54],
    [-0.18, 1.13, 0.43, 0.91, 0.73],
    [25.89, 26.22, 27.06, 26.08, 24.35],
    [9.19, 8.35, 9.34, 8.24, 7.28],
    [9.08, 9.04, 10.00, 8.09, 8.71],
];

/// The column of table 1 from parts that were measured one by one and drawn, times 1000; it has no friction.
pub const PIECE_WISE: [f64; 8] = [2.78, 1.09, -0.40, 0.91, 2.41, 0.91, -16.30, -73.80];

/// Table 1 of one installation.
#[must_use]
pub fn table_1(configuration: usize) -> Pi {
    TABLE_1.map(|line| 1e-3 * line[configuration])
}

/// The piece-wise column of table 1, without friction.
#[must_use]
pub fn piece_wise() -> Pi {
    let mut pi = [0.0; 14];
    for (value, printed) in pi.iter_mut().zip(PIECE_WISE) {
        *value = 1e-3 * printed;
    }
    pi
}

/// Table 2: RMS% of (15), a line a joint, a column an installation.
pub const TABLE_2: [[f64; 5]; 3] = [
    [12.4, 19.0, 17.0, 13.7, 19.2],
    [10.7, 28.2, 10.4, 9.0, 11.3],
    [3.2, 14.6, 13.0, 4.5, 17.0],
];

/// Corner of `L(s)`, rad/s: section 3.1.
pub const CORNER: f64 = 10.0;

/// Sines of the position command of each joint, section 3.1.
pub const SINES: usize = 10;

/// Lowest and highest frequency of the sines, rad/s: section 3.1.
pub const FREQUENCIES: [f64; 2] = [0.11, 5.0];

/// Torque command per torque: section 2.
pub const COMMAND_GAIN: f64 = 2.7;

/// Least eigenvalue of the inertia over all installations, kg m^2: section 3.2.
pub const LEAST_EIGENVALUE: f64 = 1.8e-3;

/// Speeds below which dry friction is more than viscous friction, UR, deg/s: section 3.2.
pub const CROSSOVER: [f64; 3] = [710.0, 412.0, 2841.0];

/// Largest speed of the free motion of section 4.1, rad/s.
pub const FASTEST: f64 = 3.5;

/// Acceleration of gravity, m/s^2: section 4.2.
pub const GRAVITY: f64 = 9.81;

/// Lengths of the links, m: `L1` of section 4.2; `L2` of Cavusoglu, Feygin and Tendick, rounded.
pub const LINKS: [f64; 2] = [0.216, 0.170];

/// `pi7` and `pi8` of UR as section 4.2 has them, N m.
pub const TABLE_1_UR_GRAVITY: [f64; 2] = [-0.01923, -0.10996];

/// Section 4.2.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Weights {
    /// Gimbal, kg.
    pub tool: f64,
    /// Its lever on the forearm, m.
    pub tool_lever: f64,
    /// The manufacturer's counterweight on motor 2, kg.
    pub upper: f64,
    /// Lever of counterweights, m.
    pub lever: f64,
    /// `pi7'` and `pi8'`, N m.
    pub moments: [f64; 2],
    /// What is recommended for motors 2 and 3, kg.
    pub recommended: [f64; 2],
}

/// Section 4.2.
pub const WEIGHTS: Weights = Weights {
    tool: 0.09,
    tool_lever: 0.195,
    upper: 0.216,
    lever: 0.075,
    moments: [0.0223, 0.0622],
    recommended: [0.248, 0.091],
};

/// `K_P` and `K_D` of figures 14, 15 and 16.
pub const CONTROL_GAINS: [[f64; 2]; 3] = [[625.0, 35.0], [1200.0, 80.0], [100.0, 14.0]];
