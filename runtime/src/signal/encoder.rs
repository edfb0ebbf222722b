//! What an encoder resolves, read from the positions that it gave.

/// Changes of no more than so many steps are looked at: the step itself is known to the digits of a log only.
const MOST_STEPS: f64 = 20.0;

/// Changes are whole numbers of steps if they are this close to them, in steps, in at least this share of the samples.
const CLOSE: f64 = 0.2;
const SHARE: f64 = 0.95;

/// Single steps are at least this share of all small changes: a smaller change comes of a straight line through a gap.
const SINGLE: f64 = 0.01;

/// With fewer changes of so few steps nothing is said.
const LEAST_CHANGES: usize = 10;

/// Largest speed without direction, as a share of a joint's root-mean-square speed.
const MOST_TURN_SHARE: f64 = 0.01;

/// The step of an encoder: a smallest change of a position from sample to sample of which nearly all small changes are whole numbers.
/// `None` for positions in between, that were filtered or computed.
///
/// # Examples
/// ```
/// use robot_model::signal::encoder_step;
/// let position = |k: i32| 0.7 * (0.01 * f64::from(k)).sin();
/// let read: Vec<f64> = (0..2000).map(|k| 1e-3 * (1e3 * position(k)).floor()).collect();
/// let step = encoder_step(&read).expect("an encoder");
/// assert!((step - 1e-3).abs() < 1e-9);
/// assert_eq!(encoder_step(&(0..2000).map(position).collect::<Vec<_>>()), None);
/// ```
#[must_use]
pub fn encoder_step(positions: &[f64]) -> Option<f64> {
    let size = positions.iter().fold(0.0_f64, |most, q| most.max(q.abs()));
    let rounding = 1e-12 * size;
    let changes = positions.windows(2).map(|pair| (pair[1] - pair[0]).abs());
    let mut changes: Vec<f64> = changes.filter(|change| *change > rounding).collect();
    changes.sort_unstable_by(f64::total_cmp);
    // The next change that is not about the same.
    let mut from = 0;
    while let Some(&least) = changes.get(from) {
        let single = &changes[from..changes.partition_point(|change| *change < 1.5 * least)];
        let few = &changes[from..changes.partition_point(|change| *change < MOST_STEPS * least)];
        if from > changes.len() / 20 {
            return None;
        }
        // Digits of a log cut a step now up, now down.
        let step = single.iter().sum::<f64>() / single.len() as f64;
        let whole = few.iter().map(|change| change / step);
        let whole = whole
            .filter(|count| (count - count.round()).abs() < CLOSE)
            .count();
        let of = few.len() as f64;
        if few.len() >= LEAST_CHANGES
            && single.len() as f64 >= SINGLE * of
            && whole as f64 >= SHARE * of
        {
            return Some(step);
        }
        from += single.len();
    }
    None
}

/// One encoder step in half a period of the wide band, as slower motion has no direction there that the log could tell; but not more
/// than a small share of the joint's own speed, so that a coarse encoder does not take dry friction away from slow motion.
pub(super) fn turn_speed(positions: &[f64], velocity: &[f64], wide_hz: f64) -> f64 {
    let Some(step) = encoder_step(positions) else {
        return 0.0;
    };
    let squares = velocity.iter().map(|dq| dq * dq).sum::<f64>();
    let speed = (squares / velocity.len().max(1) as f64).sqrt();
    (2.0 * wide_hz * step).min(MOST_TURN_SHARE * speed)
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
    fn a_bridge_and_few_digits_hide_no_step() {
        let mut bridged = turning(|q| (q / 2e-5).round() * 2e-5);
        bridged[2000] = 0.5 * (bridged[1999] + bridged[2001]) + 7e-6;
        let coarse = turning(|q| ((q / 95.87e-6).round() * 95.87).round() * 1e-6);
        for (positions, step) in [(bridged, 2e-5), (coarse, 95.87e-6)] {
            let found = encoder_step(&positions);
            assert!(
                (found.expect("an encoder") / step - 1.0).abs() < 5e-3,
                "{found:?}"
            );
        }
    }

    #[test]
    fn a_coarse_encoder_takes_little_of_a_motion() {
        let read = |step: f64| turning(|q| (q / step).round() * step);
        let of = |step: f64| turn_speed(&read(step), &[0.3, -0.3], 90.0);
        assert!((of(1e-6) / 180e-6 - 1.0).abs() < 1e-6, "{}", of(1e-6));
        assert!((of(1e-3) - 0.003).abs() < 1e-12, "{}", of(1e-3));
        assert!(turn_speed(&turning(|q| q), &[0.3], 90.0) == 0.0);
    }

    #[test]
    fn positions_in_between_have_none() {
        assert_eq!(encoder_step(&turning(|q| q)), None);
        assert_eq!(encoder_step(&[0.5; 100]), None);
        assert_eq!(encoder_step(&[]), None);
    }
}
