//! Why a calibration was refused.

/// Why a calibration was refused. Samples count from 0.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CalibrateError {
    /// Channels of different lengths.
    #[error("the channels differ in length; give each one value per sample")]
    Lengths,
    /// NaN or infinity.
    #[error("a value is not finite; remove or repair the sample")]
    NotFinite {
        /// The sample.
        sample: usize,
    },
    /// Too few samples.
    #[error("{samples} samples are too few; give at least {least}")]
    TooFew {
        /// How many there are.
        samples: usize,
        /// How many it takes.
        least: usize,
    },
    /// A channel that does not vary.
    #[error("the {what} is constant, so it determines nothing; {mend}")]
    Stands {
        /// What it is.
        what: &'static str,
        /// What to do.
        mend: &'static str,
    },
    /// Current and velocity in proportion.
    #[error(
        "current and velocity are proportional, so resistance and back-EMF cannot be separated; let the motor speed up and slow down, or load it"
    )]
    NotApart,
    /// Time that does not rise.
    #[error(
        "time does not increase from the sample before; sort the samples, or remove duplicates"
    )]
    TimeOrder {
        /// The later sample.
        sample: usize,
    },
    /// A gap in time.
    #[error("a gap of {steps:.1} usual steps in time; cut the log there")]
    Gap {
        /// The later sample.
        sample: usize,
        /// Its length in median steps.
        steps: f64,
    },
    /// No switch of the voltage.
    #[error(
        "the voltage never switches: with one constant voltage, viscous friction looks like back-EMF; log a square wave, or the voltage"
    )]
    NoSwitch,
    /// A voltage that is not constant in pieces.
    #[error(
        "no factor makes `u + k w` piecewise constant: the best one, {back_emf:.4}, has constants in {held:.0} % of the samples (needs 50), \
         which explain {explained:.1} % of the variance there (needs 90), and jumps are {by_jumps:.0} % of all change (needs 75); log the \
         voltage, or command a square wave whose levels last at least {shortest} samples"
    )]
    NotInPieces {
        /// The best factor.
        back_emf: f64,
        /// Percent of the samples that are in pieces.
        held: f64,
        /// Percent of the variance that constants explain.
        explained: f64,
        /// Percent of all change that is in jumps.
        by_jumps: f64,
        /// Fewest samples of a piece.
        shortest: usize,
    },
}

impl CalibrateError {
    /// The sample that is at fault, where it is one.
    ///
    /// # Examples
    /// ```
    /// use robot_model::calibrate::{CalibrateError, StaticGain};
    /// let error = StaticGain::fit(&[0.0, 1.0, 2.0], &[0.0, f64::NAN, 2.0]).unwrap_err();
    /// assert_eq!(error.sample(), Some(1));
    /// ```
    #[must_use]
    pub fn sample(&self) -> Option<usize> {
        match self {
            Self::NotFinite { sample } | Self::TimeOrder { sample } | Self::Gap { sample, .. } => {
                Some(*sample)
            }
            _ => None,
        }
    }
}
