//! What a log may hold. A file may hold, unpack to, or claim more than any arm says; what does not fit is refused before memory ends, and
//! what no arm does is refused by its numbers.

use super::{Log, LogError};

/// Rates at which arms are sampled, Hz: others come from time that is not in seconds.
const RATES_HZ: std::ops::RangeInclusive<f64> = 10.0..=100e3;

/// Largest position (rad, m) or torque (N m, N) of an arm: others come from other units, or from a broken record.
const MOST: f64 = 1e6;

/// Fewest samples that a log may have.
const FEWEST_SAMPLES: usize = 16;

/// Columns of a log. An arm of forty joints with ten channels each has four hundred.
pub(super) const MOST_COLUMNS: usize = 10_000;

/// Bytes of a row of text, a hundred for each of the columns that a log may have.
pub(super) const LONGEST_ROW: u64 = 100 * MOST_COLUMNS as u64;

/// Numbers in memory at a time, 2 GiB of them. A log of fifty columns at 1 kHz comes to that in an hour and a half.
pub(crate) const MOST_NUMBERS: usize = 1 << 28;

/// The longest unit of time in which a rate would be one of an arm.
fn unit(rate_hz: f64) -> Option<&'static str> {
    let units = [("ms", 1e3), ("us", 1e6), ("ns", 1e9)];
    let mut fitting = units.iter();
    let fits = fitting.find(|(_, scale)| RATES_HZ.contains(&(rate_hz * scale)));
    fits.map(|(unit, _)| *unit)
}

/// Refuses rates that are those of an arm in another unit of time.
pub(super) fn check_unit(source: &str, rate_hz: f64) -> Result<(), LogError> {
    if RATES_HZ.contains(&rate_hz) || unit(rate_hz).is_none() {
        return Ok(());
    }
    Err(rate(source, rate_hz))
}

fn rate(source: &str, rate_hz: f64) -> LogError {
    LogError::Rate {
        source_name: source.to_owned(),
        rate_hz,
        slowest: *RATES_HZ.start(),
        fastest: *RATES_HZ.end(),
        unit: unit(rate_hz),
    }
}

/// Refuses files with more columns than a log has.
///
/// # Errors
/// [`LogError::TooManyColumns`]
pub(super) fn check_columns(source: &str, line: u64, found: usize) -> Result<(), LogError> {
    if found <= MOST_COLUMNS {
        return Ok(());
    }
    Err(LogError::TooManyColumns {
        source_name: source.to_owned(),
        line,
        found,
        most: MOST_COLUMNS,
    })
}

/// What is said of rows that do not fit into memory.
pub(super) fn too_large(source: &str, rows: u64, columns: usize) -> LogError {
    LogError::TooLarge {
        source_name: source.to_owned(),
        rows,
        columns,
    }
}

impl Log {
    /// Refuses logs of a few samples.
    pub(super) fn check_length(&self) -> Result<(), LogError> {
        let found = self.time.len();
        if found >= FEWEST_SAMPLES {
            return Ok(());
        }
        Err(LogError::TooFewSamples {
            source_name: self.source.clone(),
            found,
            fewest: FEWEST_SAMPLES,
        })
    }

    /// Refuses positions and torques that no arm has.
    pub(super) fn check_plausible(&self, lines: Option<&[u64]>) -> Result<(), LogError> {
        for (family, channels) in [("q", &self.q), ("tau", &self.tau)] {
            for (joint, values) in channels.iter().enumerate() {
                if let Some(sample) = values.iter().position(|value| value.abs() > MOST) {
                    return Err(LogError::Implausible {
                        place: self.place(sample, lines),
                        column: format!("{family}{}", joint + 1),
                        value: values[sample],
                        most: MOST,
                    });
                }
            }
        }
        Ok(())
    }

    /// Refuses rates that no arm is sampled with.
    pub(super) fn check_rate(&self) -> Result<(), LogError> {
        let rate_hz = self.rate_hz();
        if RATES_HZ.contains(&rate_hz) {
            return Ok(());
        }
        Err(rate(&self.source, rate_hz))
    }
}
