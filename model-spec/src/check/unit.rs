//! Units and dimensions: the table of units, and what a quantity is called in messages.

/// Exponents of kg, m, s, rad and A. An angle is a dimension of its own: `alpha = 3 mm` and `a = 3 deg` are mistakes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Dimension {
    pub(super) mass: i32,
    pub(super) length: i32,
    pub(super) time: i32,
    pub(super) angle: i32,
    pub(super) current: i32,
}

impl Dimension {
    pub(super) const NONE: Self = Self::of(0, 0, 0, 0);
    pub(crate) const ANGLE: Self = Self::of(0, 0, 0, 1);
    pub(crate) const LENGTH: Self = Self::of(0, 1, 0, 0);
    pub(crate) const MASS: Self = Self::of(1, 0, 0, 0);
    pub(crate) const INERTIA: Self = Self::of(1, 2, 0, 0);
    pub(crate) const ACCELERATION: Self = Self::of(0, 1, -2, 0);
    pub(crate) const SPEED: Self = Self::of(0, 1, -1, 0);
    pub(crate) const ANGULAR_SPEED: Self = Self::of(0, 0, -1, 1);
    pub(super) const ANGULAR_ACCELERATION: Self = Self::of(0, 0, -2, 1);
    pub(crate) const FORCE: Self = Self::of(1, 1, -2, 0);
    pub(crate) const TORQUE: Self = Self::of(1, 2, -2, 0);
    pub(super) const TIME: Self = Self::of(0, 0, 1, 0);
    pub(super) const CURRENT: Self = Self {
        current: 1,
        ..Self::NONE
    };

    const fn of(mass: i32, length: i32, time: i32, angle: i32) -> Self {
        Self {
            mass,
            length,
            time,
            angle,
            current: 0,
        }
    }

    /// The product of two quantities; `sign` is -1 for a quotient.
    pub(super) fn times(self, other: Self, sign: i32) -> Self {
        let add = |x: i32, y: i32| x.saturating_add(y.saturating_mul(sign));
        Self {
            mass: add(self.mass, other.mass),
            length: add(self.length, other.length),
            time: add(self.time, other.time),
            angle: add(self.angle, other.angle),
            current: add(self.current, other.current),
        }
    }

    /// The quantity to an integer power.
    pub(super) fn power(self, exponent: i32) -> Self {
        Self::NONE.times(self, exponent)
    }

    /// "an angle", "kg m^-3"
    pub(super) fn describe(self) -> String {
        NAMES
            .iter()
            .find(|(dimension, ..)| *dimension == self)
            .map_or_else(
                || format!("a quantity in {}", self.factors(" ")),
                |(_, name, _)| (*name).to_owned(),
            )
    }

    /// The SI unit, as it is written behind a name: `kg*m^2`.
    pub(super) fn in_si(self) -> String {
        self.factors("*")
    }

    fn factors(self, between: &str) -> String {
        let factors = [
            ("kg", self.mass),
            ("m", self.length),
            ("s", self.time),
            ("rad", self.angle),
            ("A", self.current),
        ];
        let text: Vec<String> = factors
            .into_iter()
            .filter(|(_, exponent)| *exponent != 0)
            .map(|(unit, exponent)| {
                if exponent == 1 {
                    unit.to_owned()
                } else {
                    format!("{unit}^{exponent}")
                }
            })
            .collect();
        text.join(between)
    }

    /// Words of its units, as the log of an arm may have them.
    pub(super) fn unit_words(self) -> impl Iterator<Item = &'static str> {
        let words = UNITS.iter().filter(move |(.., of)| *of == self);
        let quotients: &[&str] = match self {
            Self::SPEED => &["m/s", "mm/s"],
            Self::ANGULAR_SPEED => &["rad/s", "deg/s"],
            _ => &[],
        };
        let words = words.map(|(word, ..)| *word);
        words.chain(quotients.iter().copied())
    }

    /// Units to write it in.
    pub(super) fn units(self) -> &'static str {
        NAMES
            .iter()
            .find(|(dimension, ..)| *dimension == self)
            .map_or("SI units", |(_, _, units)| units)
    }
}

/// Dimension, name, how to write it.
const NAMES: [(Dimension, &str, &str); 13] = [
    (Dimension::NONE, "a plain number", "no unit"),
    (Dimension::ANGLE, "an angle", "`rad` or `deg`"),
    (Dimension::LENGTH, "a length", "`m`, `cm` or `mm`"),
    (Dimension::MASS, "a mass", "`kg` or `g`"),
    (Dimension::TIME, "a time", "`s` or `ms`"),
    (Dimension::INERTIA, "an inertia", "`kg*m^2`"),
    (Dimension::ACCELERATION, "an acceleration", "`m/s^2`"),
    (Dimension::SPEED, "a speed", "`m/s`"),
    (
        Dimension::ANGULAR_SPEED,
        "an angular speed",
        "`rad/s` or `deg/s`",
    ),
    (
        Dimension::ANGULAR_ACCELERATION,
        "an angular acceleration",
        "`rad/s^2` or `deg/s^2`",
    ),
    (Dimension::FORCE, "a force", "`N`"),
    (Dimension::TORQUE, "a torque", "`Nm`"),
    (Dimension::CURRENT, "a current", "`A` or `mA`"),
];

/// Name, factor to SI, dimension.
pub(super) const UNITS: [(&str, f64, Dimension); 21] = [
    ("rad", 1.0, Dimension::ANGLE),
    ("deg", std::f64::consts::PI / 180.0, Dimension::ANGLE),
    ("rev", std::f64::consts::TAU, Dimension::ANGLE),
    ("m", 1.0, Dimension::LENGTH),
    ("cm", 1e-2, Dimension::LENGTH),
    ("mm", 1e-3, Dimension::LENGTH),
    ("um", 1e-6, Dimension::LENGTH),
    ("kg", 1.0, Dimension::MASS),
    ("g", 1e-3, Dimension::MASS),
    ("s", 1.0, Dimension::TIME),
    ("ms", 1e-3, Dimension::TIME),
    ("us", 1e-6, Dimension::TIME),
    ("ns", 1e-9, Dimension::TIME),
    ("min", 60.0, Dimension::TIME),
    ("N", 1.0, Dimension::FORCE),
    ("kN", 1e3, Dimension::FORCE),
    ("Nm", 1.0, Dimension::TORQUE),
    ("J", 1.0, Dimension::TORQUE),
    (
        "rpm",
        std::f64::consts::TAU / 60.0,
        Dimension::ANGULAR_SPEED,
    ),
    ("A", 1.0, Dimension::CURRENT),
    ("mA", 1e-3, Dimension::CURRENT),
];

/// The unit of that name.
pub(super) fn find(name: &str) -> Option<(f64, Dimension)> {
    UNITS
        .iter()
        .find(|(unit, ..)| *unit == name)
        .map(|(_, factor, dimension)| (*factor, *dimension))
}
