//! What an encoder resolves, read from the positions that it gave.

/// Changes of no more than so many steps are looked at: the step itself is known to the digits of a log only.
const MOST_STEPS: f64 = 20.0;

/// Changes are whole numbers of steps if they are this close to them, in steps, in at least this share of the samples.
const CLOSE: f64 = 0.1;
const SHARE: f64 = 0.95;

/// With fewer changes of so few steps nothing is said.
const LEAST_CHANGES: usize = 10;

/// The step of an encoder: the smallest change of a position from sample to sample, where all small changes are whole numbers of it.
/// `None` for positions in between, that were filtered or computed.
pub(super) fn encoder_step(positions: &[f64]) -> Option<f64> {
    let size = positions.iter().fold(0.0_f64, |most, q| most.max(q.abs()));
    let rounding = 1e-12 * size;
    let changes = positions.windows(2).map(|pair| (pair[1] - pair[0]).abs());
    let changes: Vec<f64> = changes.filter(|change| *change > rounding).collect();
    let step = changes.iter().copied().reduce(f64::min)?;
    let counts = changes.iter().map(|change| change / step);
    let few: Vec<f64> = counts.filter(|count| *count < MOST_STEPS).collect();
    let whole = few
        .iter()
        .filter(|count| (*count - count.round()).abs() < CLOSE);
    let is_encoder = few.len() >= LEAST_CHANGES && whole.count() as f64 >= SHARE * few.len() as f64;
    is_encoder.then_some(step)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn turning(read: impl Fn(f64) -> f64) -> Vec<f64> {
        let at =
            |k: i32| read(0.7 * (0.004 * f64::from(k)).sin() + 0.2 * (0.0171 * f64::from(k)).cos());
        (0..5000).map(at).collect()
    }

    #[test]
    fn steps_are_read_through_the_digits_of_a_log() {
        let step = std::f64::consts::TAU / f64::from(1 << 17);
        let found = encoder_step(&turning(|q| {
            ((q / step).round() * step * 1e8).round() / 1e8
        }));
        assert!(
            (found.expect("an encoder") / step - 1.0).abs() < 1e-3,
            "{found:?}"
        );
    }

    #[test]
    fn positions_in_between_have_none() {
        assert_eq!(encoder_step(&turning(|q| q)), None);
        assert_eq!(encoder_step(&[0.5; 100]), None);
        assert_eq!(encoder_step(&[]), None);
    }
}
