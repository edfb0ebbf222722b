//! The three laws of friction, named in the spec's text and compiled while the program runs.

use robot_model_codegen::Compiled;
use robot_model_spec::amend::{Amendment, amend};

use super::words::{InWords, in_words};
use crate::paper::{Error, compiled};

/// The rigid arm and the three laws, none of which it declares.
pub const SHOULDER: &str = include_str!("shoulder.robot");

/// A law of friction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Law {
    /// (6.1): `c x`
    Linear,
    /// (6.2): `c1 x + c2 x |x|`
    Quadratic,
    /// (6.3): `c1 x` forward, `c2 x` backward.
    Directional,
}

/// All of them, as the tables have them.
pub const LAWS: [Law; 3] = [Law::Linear, Law::Quadratic, Law::Directional];

impl Law {
    /// What the paper calls it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Linear => "linear (6.1)",
            Self::Quadratic => "quadratic (6.2)",
            Self::Directional => "directional (6.3)",
        }
    }

    fn effect(self) -> &'static str {
        match self {
            Self::Linear => "linear_law",
            Self::Quadratic => "quadratic_law",
            Self::Directional => "direction_law",
        }
    }

    /// `alpha`, `beta` and its own constants.
    #[must_use]
    pub fn parameters(self) -> &'static [&'static str] {
        match self {
            Self::Linear => &["alpha", "beta", "c"],
            Self::Quadratic | Self::Directional => &["alpha", "beta", "c1", "c2"],
        }
    }

    /// The arm with this law.
    ///
    /// # Errors
    /// Mistakes in the spec.
    pub fn compiled(self) -> Result<Compiled, Error> {
        let amendment = Amendment {
            effect: self.effect().to_owned(),
            joints: vec!["th".to_owned()],
            shapes: Vec::new(),
        };
        let text = amend("shoulder.robot", SHOULDER, &[amendment])?;
        compiled("shoulder.robot", &text)
    }

    /// The same as a plant, with `[alpha, beta, c..]`.
    ///
    /// # Errors
    /// As [`Self::compiled`].
    pub fn plant(self, values: &[f64]) -> Result<InWords, Error> {
        in_words(self.compiled()?, values)
    }
}
