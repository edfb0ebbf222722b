//! Numbers: what the publication prints, and those of the arm that is simulated here.

/// Rows of Table I, joint by joint, SI units: name of our parameter, values as printed.
pub const TABLE_1: [(&str, [f64; 6]); 16] = [
    ("m", [10.0; 6]),
    ("mx", [0.0, -858.2752, -76.5142, -0.2413, 0.0616, -1.5041]),
    ("my", [0.0, -5.2483, -861.6599, -3.3241, 3.8733, 1.5720]),
    ("mz", [0.0; 6]),
    ("ixx", [0.0, 3.9782, -10.8293, 0.0998, 0.0595, -0.0227]),
    ("ixy", [0.0, 0.3662, 1.1390, -0.0073, -0.0048, 0.0006]),
    ("ixz", [0.0, 0.5461, -0.2281, -0.0444, -0.0125, -0.0094]),
    ("iyy", [0.0, -7.3663, -0.0585, 0.0, 0.0, 0.0]),
    ("iyz", [0.0, 0.1911, -0.1043, 0.0458, -0.0011, 0.0098]),
    ("izz", [-2.8121, -9.3237, -9.6584, 0.0845, 0.0884, -0.012]),
    (
        "motor_inertia.ia",
        [0.0, 0.0, -2.8085, 0.1407, -0.0429, -0.0411],
    ),
    ("rokae.fv1", FRICTION.fv1),
    ("rokae.fv2", FRICTION.fv2),
    ("rokae.fv3", FRICTION.fv3),
    ("rokae.fc1", FRICTION.fc1),
    (
        "rokae.fc2",
        [-10.9926, -13.3944, -8.8085, -3.8707, -3.2091, -0.9670],
    ),
];

/// Parameters of the friction law, joint by joint.
#[derive(Debug, Clone, Copy)]
pub struct Friction {
    /// Dry friction forward, N m.
    pub fc1: [f64; 6],
    /// Dry friction backward, a magnitude, N m.
    pub fc2: [f64; 6],
    /// Viscous coefficient, N m s/rad.
    pub fv1: [f64; 6],
    /// Coefficient of the square, N m s^2/rad^2.
    pub fv2: [f64; 6],
    /// Coefficient of the cube, N m s^3/rad^3.
    pub fv3: [f64; 6],
}

impl Friction {
    /// Rows by the names of the effect `rokae`.
    #[must_use]
    pub const fn by_name(&self) -> [(&'static str, [f64; 6]); 5] {
        [
            ("fc1", self.fc1),
            ("fc2", self.fc2),
            ("fv1", self.fv1),
            ("fv2", self.fv2),
            ("fv3", self.fv3),
        ]
    }
}

/// Table I, with `fc2` as a magnitude. The arm that is simulated has it.
pub const FRICTION: Friction = Friction {
    fc1: [8.0499, 13.8660, 9.2687, 3.9203, 3.0459, 0.9669],
    fc2: [10.9926, 13.3944, 8.8085, 3.8707, 3.2091, 0.9670],
    fv1: [33.6469, 35.4598, 20.6053, 6.7420, 4.2719, 0.7638],
    fv2: [1.6392, 1.2254, 2.5514, -0.0174, 0.2154, 0.0326],
    fv3: [-4.5485, -5.5002, -10.4831, -0.3451, -0.5393, -0.0814],
};

/// Names of the columns of Table II.
pub const METHODS: [&str; 3] = ["TFLS", "MFLS", "MFWLS"];

/// Table II, N m root mean square: conventional friction and least squares, modified friction and least squares, modified friction
/// and weighted least squares.
pub const TABLE_2: [[f64; 6]; 3] = [
    [1.1591, 16.1487, 23.6079, 1.5134, 1.0070, 0.9255],
    [1.1229, 15.5289, 13.9014, 1.6229, 0.9462, 0.7810],
    [0.4874, 14.9412, 4.0292, 0.2823, 0.3320, 0.2702],
];

/// Speed below which the law is a straight line, rad/s. The publication gives none: this is its threshold of low speed (section 5.4).
pub const EPS: f64 = 0.01;

/// Fundamental frequency of the excitation: a period of 20 s, and waves a joint.
pub const PERIOD: f64 = 20.0;
/// Harmonics of it.
pub const HARMONICS: usize = 5;
/// Samples of one period at 1 kHz.
pub const SAMPLES: usize = 20_000;

/// A link of the simulated arm: its frame is that of the spec, its body is ours.
#[derive(Debug, Clone, Copy)]
pub struct Link {
    /// `a, alpha, d, offset` of standard DH; m, rad.
    pub frame: [f64; 4],
    /// kg.
    pub mass: f64,
    /// Center of mass in the link's frame, m.
    pub com: [f64; 3],
    /// Principal moments about it along the axes of the frame, kg m^2.
    pub inertia: [f64; 3],
    /// Inertia of the rotor, on the side of the joint, kg m^2.
    pub rotor: f64,
}

/// A quarter turn.
const QUARTER: f64 = std::f64::consts::FRAC_PI_2;

/// 47 kg with the base, which does not move.
pub const LINKS: [Link; 6] = [
    Link {
        frame: [0.03, -QUARTER, 0.38, 0.0],
        mass: 10.0,
        com: [-0.02, 0.12, 0.01],
        inertia: [0.11, 0.07, 0.10],
        rotor: 1.6,
    },
    Link {
        frame: [0.44, 0.0, 0.0, -QUARTER],
        mass: 9.0,
        com: [-0.24, 0.01, 0.05],
        inertia: [0.04, 0.22, 0.21],
        rotor: 1.8,
    },
    Link {
        frame: [0.035, -QUARTER, 0.0, 0.0],
        mass: 6.5,
        com: [-0.03, 0.02, 0.06],
        inertia: [0.05, 0.05, 0.04],
        rotor: 0.9,
    },
    Link {
        frame: [0.0, QUARTER, 0.42, 0.0],
        mass: 4.0,
        com: [0.005, -0.14, 0.01],
        inertia: [0.05, 0.012, 0.05],
        rotor: 0.30,
    },
    Link {
        frame: [0.0, -QUARTER, 0.0, 0.0],
        mass: 2.2,
        com: [0.002, 0.03, 0.01],
        inertia: [0.006, 0.004, 0.005],
        rotor: 0.25,
    },
    Link {
        frame: [0.0, 0.0, 0.083, 0.0],
        mass: 1.0,
        com: [0.012, -0.008, -0.02],
        inertia: [0.0012, 0.0011, 0.0016],
        rotor: 0.12,
    },
];
