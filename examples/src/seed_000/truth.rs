//! Numbers of the paper, each with the place that it is from.

/// Samples of the dynamic experiment, section 4b.
pub const SAMPLES: u32 = 512;

/// Their rate, Hz, equation (2.2).
pub const RATE: f64 = 30.0;

/// What is fitted, s, section 6.
pub const WINDOW: [f64; 2] = [1.67, 15.0];

/// Voltage of the motor over its velocity, V s/rad, section 4c.
pub const BACK_EMF: f64 = 1.5;

/// One line of Table 1 or 2: `alpha`, `beta`, the constants of friction, and the cost.
#[derive(Debug, Clone, Copy)]
pub struct Line {
    /// Number of the iterate.
    pub iterate: u32,
    /// `[alpha, beta, c..]`
    pub values: &'static [f64],
    /// `J`, equation (3.1).
    pub cost: f64,
}

const fn line(iterate: u32, values: &'static [f64], cost: f64) -> Line {
    Line {
        iterate,
        values,
        cost,
    }
}

/// Table 1, model (5.1): laws (6.1), (6.2), (6.3).
pub const TABLE_1: [&[Line]; 3] = [
    &[
        line(0, &[13.39, 21.00, 1.17], 82300.0),
        line(1, &[16.33, 24.07, 1.08], 65600.0),
        line(2, &[15.51, 22.64, 1.12], 137_000.0),
        line(3, &[11.72, 13.64, 1.18], 6110.0),
        line(4, &[13.18, 11.58, 3.23], 5410.0),
        line(5, &[14.14, 10.31, 4.03], 5240.0),
    ],
    &[
        line(0, &[13.39, 21.00, 1.17, 0.00], 82300.0),
        line(1, &[31.55, 38.38, 3.13, 0.55], 152_000.0),
        line(2, &[26.72, 23.31, 5.47, 0.58], 103_000.0),
        line(3, &[180.4, 130.5, 27.2, 2.96], 56800.0),
    ],
    &[
        line(0, &[12.05, 21.42, 2.59, 4.87], 450.0),
        line(1, &[11.23, 20.73, 3.49, 4.67], 848.0),
        line(2, &[10.65, 21.26, 4.22, 5.50], 720.0),
        line(3, &[10.94, 21.40, 4.08, 8.79], 734.0),
        line(4, &[10.40, 20.98, 4.09, 1.86], 25000.0),
        line(5, &[11.28, 20.66, 3.64, 4.07], 15300.0),
        line(6, &[12.26, 19.70, 1.65, 6.52], 14400.0),
    ],
];

/// Table 2, model (5.2): laws (6.1), (6.2), (6.3).
pub const TABLE_2: [&[Line]; 3] = [
    &[
        line(0, &[12.00, 20.00, 35.00], 301.0),
        line(1, &[10.91, 20.99, 34.04], 25.2),
        line(2, &[11.09, 21.44, 33.55], 5.14),
        line(3, &[13.25, 21.41, 33.42], 2.85),
        line(4, &[13.57, 21.44, 33.34], 2.60),
        line(5, &[13.39, 21.01, 32.67], 2.59),
    ],
    &[
        line(0, &[12.00, 20.00, 35.00, 0.00], 301.0),
        line(1, &[11.01, 20.85, 34.19, -0.72], 14.8),
        line(4, &[14.19, 21.93, 32.87, 1.08], 2.26),
        line(7, &[18.74, 25.20, 27.19, 10.59], 0.89),
        line(14, &[20.23, 26.17, 24.07, 14.81], 0.66),
    ],
    &[
        line(0, &[12.00, 20.00, 35.00, 35.00], 301.0),
        line(1, &[11.27, 20.70, 34.30, 35.70], 5.00),
        line(2, &[11.31, 20.91, 34.20, 35.68], 0.21),
        line(3, &[11.81, 21.09, 34.21, 35.49], 0.116),
        line(4, &[12.05, 21.42, 34.72, 36.00], 0.112),
    ],
];

/// Last line of Table 2 for law (6.3): `alpha`, `beta`, `c1`, `c2`. The arm that is simulated here has these.
pub const ARM: [f64; 4] = [12.05, 21.42, 34.72, 36.00];

/// Figures 7 and 8, model (5.1): `alpha`, `beta`, `c1`, `c2`.
pub const FIGURE_7: [f64; 4] = [12.74, 21.209, 2.296, 4.301];
/// The other `c1` of Figure 7.
pub const FIGURE_7_C1: f64 = 2.306;
/// Initial velocities of Figure 8, rad/s.
pub const FIGURE_8: [f64; 2] = [0.63, 0.64];
/// The other `c1` of Figure 9, model (5.2); all else is [`ARM`].
pub const FIGURE_9_C1: f64 = 33.72;
/// Initial velocities of Figure 10, rad/s.
pub const FIGURE_10: [f64; 2] = [0.76, 1.76];

/// Correlation of the static experiment, Figure 2.
pub const STATIC_R: f64 = 0.999;
