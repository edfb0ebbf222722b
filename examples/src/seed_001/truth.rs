//! Numbers of the paper, each with the table that it is from.

/// Gravity, m/s^2; the paper gives none.
pub const G: f64 = 9.81;

/// Seconds between samples (section 4).
pub const STEP: f64 = 0.005;

/// Releases from each height (section 4).
pub const RELEASES: usize = 20;

/// Degrees from one pulse of the encoder to the next: 2500 a turn (Table 1). All angles of section 4 are whole multiples of it.
pub const PULSE: f64 = 360.0 / 2500.0;

/// Names of the parameters in the order of Table 2. `f_c` is viscous and `f_d` dry friction, as its units say.
pub const NAMES: [&str; 11] = [
    "m1", "m2", "l1", "c1", "c2", "I1", "I2", "f_c1", "f_c2", "f_d1", "f_d2",
];

/// Parameters of the arm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Physical {
    /// Masses, kg.
    pub m: [f64; 2],
    /// Length of the first link, m.
    pub l1: f64,
    /// From the joints to the centers of mass, m.
    pub c: [f64; 2],
    /// Inertia about the centers of mass, kg m^2.
    pub inertia: [f64; 2],
    /// Viscous friction, N m s/rad: `f_c`.
    pub viscous: [f64; 2],
    /// Dry friction, N m: `f_d`.
    pub dry: [f64; 2],
}

impl Physical {
    /// From values in the order of [`NAMES`].
    #[must_use]
    pub const fn new(values: [f64; 11]) -> Self {
        let [m1, m2, l1, c1, c2, i1, i2, v1, v2, d1, d2] = values;
        Self {
            m: [m1, m2],
            l1,
            c: [c1, c2],
            inertia: [i1, i2],
            viscous: [v1, v2],
            dry: [d1, d2],
        }
    }

    /// In the order of [`NAMES`].
    #[must_use]
    pub const fn values(&self) -> [f64; 11] {
        let Self {
            m: [m1, m2],
            l1,
            c: [c1, c2],
            inertia: [i1, i2],
            viscous: [v1, v2],
            dry: [d1, d2],
        } = *self;
        [m1, m2, l1, c1, c2, i1, i2, v1, v2, d1, d2]
    }
}

/// Table 2: from CAD, with friction that the paper says was measured.
pub const CAD: Physical = Physical::new([
    5.914, 3.437, 0.615, 0.293, 0.19, 0.357, 0.013, 0.35, 0.35, 0.35, 0.35,
]);

/// Table 6: what the paper estimates; here the arm that is measured.
pub const ESTIMATED: Physical = Physical::new([
    6.813, 3.361, 0.552, 0.346, 0.212, 0.264, 0.012, 0.335, 0.279, 0.203, 0.076,
]);

/// Table 5: least and largest values.
pub const BOUNDS: [[f64; 2]; 11] = [
    [5.0, 7.0],
    [3.0, 5.0],
    [0.5, 0.7],
    [0.2, 0.4],
    [0.13, 0.25],
    [0.25, 0.45],
    [0.009, 0.017],
    [1e-5, 20.0],
    [1e-5, 20.0],
    [1e-5, 20.0],
    [1e-5, 20.0],
];

/// What the text says the bounds of Table 5 are: so much less and more than CAD, of all but friction.
pub const SHARE: f64 = 0.3;

/// A height from which links are let go.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Height {
    /// Degrees.
    pub angle: f64,
    /// Samples (Table 5).
    pub samples: usize,
    /// Initial angles of each link (sections 4.1, 4.2), degrees, sides taken away.
    pub starts: [Starts; 2],
    /// Before estimation, each link (Tables 3, 4).
    pub before: [Printed; 2],
    /// After estimation, each link (Tables 7, 8).
    pub after: [Printed; 2],
}

/// Initial angles of twenty releases, degrees.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Starts {
    /// Least.
    pub least: f64,
    /// Largest.
    pub most: f64,
    /// The one that came most often.
    pub mode: f64,
    /// How many of twenty had it; a quarter where the paper does not say.
    pub often: usize,
}

/// Errors of a model, as printed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Printed {
    /// Equation (7), degrees.
    pub mae: f64,
    /// Equation (8), percent.
    pub nrmse: f64,
}

const fn starts(least: f64, most: f64, mode: f64, often: usize) -> Starts {
    Starts {
        least,
        most,
        mode,
        often,
    }
}

const fn printed(mae: f64, nrmse: f64) -> Printed {
    Printed { mae, nrmse }
}

/// All four heights.
pub const HEIGHTS: [Height; 4] = [
    Height {
        angle: 10.0,
        samples: 2100,
        starts: [
            starts(9.216, 10.08, 10.08, 5),
            starts(7.92, 10.08, 8.928, 5),
        ],
        before: [printed(1.0932, 35.47), printed(0.5655, 14.94)],
        after: [printed(0.6076, 63.96), printed(0.2407, 79.64)],
    },
    Height {
        angle: 20.0,
        samples: 3182,
        starts: [
            starts(19.872, 20.016, 20.016, 19),
            starts(14.832, 21.888, 20.736, 5),
        ],
        before: [printed(2.9180, 20.29), printed(1.1078, 16.36)],
        after: [printed(0.9420, 75.27), printed(0.3401, 82.82)],
    },
    Height {
        angle: 30.0,
        samples: 4546,
        starts: [
            starts(29.808, 30.24, 30.096, 11),
            starts(23.904, 31.248, 24.048, 5),
        ],
        before: [printed(3.2550, 34.37), printed(1.7524, 18.14)],
        after: [printed(1.0382, 81.61), printed(0.5159, 81.98)],
    },
    Height {
        angle: 40.0,
        samples: 5028,
        starts: [
            starts(39.888, 40.464, 40.032, 10),
            starts(32.976, 42.192, 38.736, 5),
        ],
        before: [printed(6.1717, 16.69), printed(2.8270, 16.88)],
        after: [printed(1.1045, 84.62), printed(0.7207, 82.69)],
    },
];
