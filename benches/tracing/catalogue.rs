//! What is put into an arm: every effect of the library with a law of its size, faults of logs, and laws that no library has.

use std::f64::consts::TAU;

use crate::noise::{DRIVE, FAR, Noise, SLOW, WANDERING};

/// A shape parameter by the size of its effect.
pub type OfSize = fn(f64) -> f64;

/// What is put into an arm.
#[derive(Debug)]
pub struct Injection {
    /// Its name, as `trace` gives it.
    pub kind: &'static str,
    /// Names that mean the same in the logs.
    pub same: &'static [&'static str],
    /// Neighbors: laws that logs as these hardly tell apart, so that their names are nearly right.
    pub near: &'static [&'static str],
    /// Where it is.
    pub place: Place,
    /// Linear parameters, in units of its size.
    pub linear: &'static [(&'static str, f64)],
    /// Shape parameters.
    pub shapes: &'static [(&'static str, f64)],
    /// The shape parameters that are its size, where no linear ones are.
    pub scaled: &'static [(&'static str, OfSize)],
    /// The declared effect that it stands for.
    pub replaces: Option<&'static str>,
    /// Whether inertials have to be known for it to be told.
    pub is_of_known_links: bool,
    /// What part of the wanted size it has.
    pub part: f64,
    /// The effect of the language, where that has another name.
    pub effect: Option<&'static str>,
    /// Its law, where the library does not have it.
    pub law: Option<&'static str>,
    /// Bits a turn of the encoders, where they are coarser than [`ENCODER_STEP`].
    pub encoder_bits: Option<u8>,
    /// Of its torques.
    pub noise: Noise,
}

/// Steps of the encoders, rad: between 18 and 19 bits a turn.
const ENCODER_STEP: f64 = 2e-5;

/// What an injection is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// One joint.
    Joint,
    /// A joint and the one before it.
    Pair,
    /// The last joint.
    Last,
    /// The arm.
    Arm,
    /// The log, not the arm.
    Log,
    /// Nothing: a clean arm.
    Nowhere,
}

const NONE: Injection = Injection {
    kind: "",
    same: &[],
    near: &[],
    place: Place::Joint,
    linear: &[],
    shapes: &[],
    scaled: &[],
    replaces: None,
    is_of_known_links: false,
    part: 1.0,
    effect: None,
    law: None,
    encoder_bits: None,
    noise: DRIVE,
};

/// An arm that lacks nothing.
const fn complete(noise: Noise, encoder_bits: Option<u8>) -> Injection {
    Injection {
        kind: "nothing",
        place: Place::Nowhere,
        encoder_bits,
        noise,
        ..NONE
    }
}

/// Everything that is tried.
pub static ALL: &[Injection] = &[
    complete(DRIVE, None),
    complete(DRIVE, Some(16)),
    complete(DRIVE, Some(14)),
    Injection {
        kind: "coulomb-friction",
        linear: &[("fc", 1.0)],
        replaces: Some("coulomb_friction"),
        near: &["dahl", "lugre-presliding"],
        ..NONE
    },
    Injection {
        kind: "viscous-friction",
        linear: &[("fv", 1.0)],
        replaces: Some("viscous_friction"),
        near: &["quadratic-viscous", "temperature-viscous"],
        ..NONE
    },
    Injection {
        kind: "quadratic-viscous",
        linear: &[("c", 1.0)],
        near: &["cubic-viscous"],
        ..NONE
    },
    Injection {
        kind: "cubic-viscous",
        linear: &[("c", 1.0)],
        near: &["quadratic-viscous"],
        ..NONE
    },
    Injection {
        kind: "asymmetric-coulomb",
        linear: &[("delta", 1.0)],
        same: &["torque-offset"],
        ..NONE
    },
    Injection {
        kind: "asymmetric-viscous",
        linear: &[("delta", 1.0)],
        near: &["asymmetric-coulomb", "torque-offset"],
        ..NONE
    },
    Injection {
        kind: "stribeck",
        linear: &[("fs", 1.0)],
        shapes: &[("vs", 0.12)],
        near: &["lugre-presliding"],
        ..NONE
    },
    Injection {
        kind: "lugre-presliding",
        linear: &[("fc", 1.0), ("s1", 0.0)],
        shapes: &[("d", 0.02), ("vs", 0.1), ("rise", 0.4)],
        replaces: Some("coulomb_friction"),
        near: &["dahl", "stribeck", "cable-hysteresis", "backlash"],
        ..NONE
    },
    Injection {
        kind: "load-dependent-friction",
        linear: &[("mu", 1.0)],
        near: &["torque-gain", "transmission-efficiency"],
        ..NONE
    },
    Injection {
        kind: "position-dependent-friction",
        linear: &[("a", 0.6), ("b", 0.8)],
        shapes: &[("k", 3.0)],
        near: &["torque-ripple"],
        ..NONE
    },
    Injection {
        kind: "temperature-viscous",
        linear: &[("fv", 1.0)],
        shapes: &[("beta", 0.04)],
        near: &["parameter-drift"],
        ..NONE
    },
    Injection {
        kind: "parameter-drift",
        linear: &[("fv", 1.0)],
        shapes: &[("settle", 8.0)],
        near: &["temperature-viscous"],
        ..NONE
    },
    Injection {
        kind: "transmission-efficiency",
        linear: &[("driving", 1.0), ("driven", 0.8)],
        near: &["load-dependent-friction", "torque-gain"],
        ..NONE
    },
    Injection {
        kind: "motor-inertia",
        linear: &[("ia", 1.0)],
        replaces: Some("motor_inertia"),
        ..NONE
    },
    Injection {
        kind: "gear-coupling",
        place: Place::Pair,
        linear: &[("ia", 0.05), ("fv", 0.4), ("fc", 1.0)],
        ..NONE
    },
    Injection {
        kind: "payload",
        same: &["link-inertial-error"],
        place: Place::Last,
        is_of_known_links: true,
        linear: &[
            ("m", 1.0),
            ("mx", 0.02),
            ("my", 0.01),
            ("mz", 0.05),
            ("ixx", 0.004),
            ("iyy", 0.004),
            ("izz", 0.002),
        ],
        ..NONE
    },
    Injection {
        kind: "link-inertial-error",
        near: &["payload"],
        is_of_known_links: true,
        linear: &[
            ("m", 1.0),
            ("mx", 0.05),
            ("my", 0.03),
            ("mz", 0.02),
            ("ixx", 0.01),
            ("iyy", 0.01),
            ("izz", 0.01),
        ],
        ..NONE
    },
    Injection {
        kind: "joint-spring",
        linear: &[("k", 1.0), ("t0", -0.3)],
        near: &["gravity-compensation-spring", "base-tilt"],
        ..NONE
    },
    Injection {
        kind: "gravity-compensation-spring",
        linear: &[("s", 1.0), ("p", 1.2)],
        shapes: &[("apart", 0.3), ("q0", 0.4)],
        near: &["joint-spring"],
        ..NONE
    },
    Injection {
        kind: "base-tilt",
        place: Place::Arm,
        scaled: &[("first", |x| 0.7 * x), ("second", |x| -x)],
        near: &["encoder-offset", "joint-spring"],
        ..NONE
    },
    Injection {
        kind: "torque-gain",
        linear: &[("excess", 1.0)],
        is_of_known_links: true,
        near: &["load-dependent-friction"],
        ..NONE
    },
    Injection {
        kind: "torque-offset",
        linear: &[("offset", 1.0)],
        same: &["asymmetric-coulomb"],
        ..NONE
    },
    Injection {
        kind: "encoder-offset",
        scaled: &[("offset", |x| x)],
        near: &["base-tilt", "torque-offset"],
        ..NONE
    },
    Injection {
        kind: "time-delay",
        place: Place::Log,
        scaled: &[("delay", |x| x)],
        ..NONE
    },
    Injection {
        kind: "corrupt-samples",
        place: Place::Log,
        ..NONE
    },
    Injection {
        kind: "torque-ripple",
        linear: &[("a", 0.6), ("b", 0.8)],
        shapes: &[("k", 9.0)],
        near: &["position-dependent-friction"],
        ..NONE
    },
    Injection {
        kind: "joint-elasticity",
        scaled: &[("stiffness", |x| 1.0 / x)],
        near: &["backlash"],
        // A spring that gives way by more swings with the motion.
        part: 0.1,
        ..NONE
    },
    Injection {
        kind: "backlash",
        scaled: &[("half_gap", |x| x)],
        near: &["joint-elasticity", "cable-hysteresis", "lugre-presliding"],
        ..NONE
    },
    Injection {
        kind: "cable-hysteresis",
        linear: &[("f", 1.0)],
        shapes: &[("width", 0.15), ("beta", 0.7), ("n", 1.0)],
        near: &["dahl", "lugre-presliding", "backlash"],
        ..NONE
    },
    Injection {
        kind: "external-force",
        place: Place::Last,
        linear: &[("fx", 0.4), ("fy", 0.5), ("fz", 1.0)],
        shapes: &[("start", 6.0), ("end", 9.0)],
        ..NONE
    },
    Injection {
        kind: "external-force",
        effect: Some("recurring_force"),
        place: Place::Last,
        linear: &[("fx", 0.4), ("fy", 0.5), ("fz", 1.0)],
        shapes: &[("start", 0.55), ("end", 0.75)],
        ..NONE
    },
    Injection {
        kind: "torque-saturation",
        linear: &[("share", 1.0)],
        scaled: &[("limit", |x| 1.0 / x)],
        shapes: &[("v0", 1e5)],
        ..NONE
    },
    Injection {
        kind: "unknown",
        linear: &[("c", 1.0)],
        ..NONE
    }
    .of(
        "effect unknown(j) { linear c; torque(j) = c * sin(2.3 * q(j) + 0.4) * cos(1.9 * dq(j)); }",
    ),
    Injection {
        kind: "unknown",
        place: Place::Pair,
        linear: &[("c", 1.0)],
        ..NONE
    }
    .of("effect unknown(j, k) { linear c; torque(j) = c * sin(3 * q(j) - 2 * q(k)) * dq(k); }"),
    Injection {
        kind: "unknown",
        linear: &[("c", 1.0)],
        ..NONE
    }
    .of(
        "effect unknown(j) { linear c; torque(j) = c * sin(2.36 * time + 0.3 * sin(0.7 * time)); }",
    ),
    Injection {
        kind: "unknown",
        linear: &[("c", 1.0)],
        ..NONE
    }
    .of("effect unknown(j) { linear c; torque(j) = c * sin(5 * dq(j)); }"),
    Injection {
        kind: "unknown",
        linear: &[("c", 1.0)],
        ..NONE
    }
    .of("effect unknown(j) { linear c; torque(j) = c * sin(2 * q(j)) * dq(j) * abs(dq(j)); }"),
    // Behind the others, whose joints, motions and noise are drawn by their places.
    complete(SLOW, None),
    complete(WANDERING, None),
    complete(FAR, None),
];

impl Injection {
    const fn of(self, law: &'static str) -> Self {
        Self {
            law: Some(law),
            ..self
        }
    }

    /// Its name in the language.
    pub fn effect(&self) -> String {
        self.effect
            .map_or_else(|| self.kind.replace('-', "_"), str::to_owned)
    }

    /// Whether something is there that `trace` may name.
    pub fn is_named(&self) -> bool {
        self.place != Place::Nowhere && self.law.is_none()
    }

    /// Steps of the encoders, rad.
    pub fn encoder_step(&self) -> f64 {
        self.encoder_bits
            .map_or(ENCODER_STEP, |bits| TAU / f64::from(bits).exp2())
    }
}
