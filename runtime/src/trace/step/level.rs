//! The level of a series: where it steps, and where it comes back.
//!
//! Means of a second before and after every sample differ by what noise leaves in a mean, of whatever color it is; a step stands far out of all
//! these differences, and the means of all that is on its two sides differ as well.

use crate::signal::MEDIAN_OF_NORMAL;
use crate::signal::resample::whole_steps;

/// Means are of so long a time on either side, s.
const SIDE_S: f64 = 1.0;

/// Of what a second differs by, this share has to be there between the means of all that is at one level and at the other.
const STAYS: f64 = 0.5;

/// A step that comes back does so after this time at the earliest, s: what is shorter is a pulse, of which a mean of a second says little.
const LEAST_STAY_S: f64 = 2.0;

/// Differences of means that are told apart: fewer know nothing of their deviation.
const LEAST_APART: usize = 10;

/// Samples of a series that are at another level than the others.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Level {
    /// The first of them, and the first behind them; none where they last to the end.
    pub(super) from: usize,
    pub(super) to: Option<usize>,
    /// Difference of the means of these and of all others.
    size: f64,
    /// Squares that it takes off the series.
    taken: f64,
}

/// Sums of values and counts up to each sample; those of a sample that says nothing, which is zero, do not count.
struct Sums(Vec<(f64, usize)>);

impl Sums {
    fn of(values: &[f64]) -> Self {
        let mut sums = vec![(0.0, 0)];
        let (mut sum, mut count) = (0.0, 0);
        for value in values {
            sum += value;
            count += usize::from(*value != 0.0);
            sums.push((sum, count));
        }
        Self(sums)
    }

    /// The mean between two samples, and of how many it is; none where fewer than these say something.
    fn mean(&self, from: usize, to: usize, least: usize) -> Option<(f64, usize)> {
        let (first, last) = (self.0[from], self.0[to]);
        let count = last.1 - first.1;
        (count >= least.max(1)).then(|| ((last.0 - first.0) / count as f64, count))
    }

    /// The level of the samples from one on, up to another or the end; none where fewer than these say something on either side of its edges.
    fn level(&self, from: usize, to: Option<usize>, least: usize) -> Option<Level> {
        let samples = self.0.len() - 1;
        let (mean, count) = self.mean(from, to.unwrap_or(samples), least)?;
        let (all, of_all) = self.mean(0, samples, least)?;
        let others = of_all - count;
        if others < least {
            return None;
        }
        // The mean of the others follows from that of all.
        let size = (mean - all) * of_all as f64 / others as f64;
        let taken = size.powi(2) * (count * others) as f64 / of_all as f64;
        Some(Level {
            from,
            to,
            size,
            taken,
        })
    }
}

/// The step of a series whose samples are zero where they say nothing, as far as it stands out by so many deviations. A second to either side
/// of edges is not asked: there a column of the model begins or ends, which takes the level of its own part in.
pub(super) fn level(
    values: &[f64],
    rate_hz: f64,
    edges: &[usize],
    stands_out: f64,
) -> Option<Level> {
    let side = whole_steps((SIDE_S * rate_hz).round()).max(2);
    if values.len() < side * LEAST_APART {
        return None;
    }
    let sums = Sums::of(values);
    let difference = |at: usize| {
        if edges.iter().any(|edge| edge.abs_diff(at) < side) {
            return None;
        }
        let before = sums.mean(at - side, at, side.div_ceil(2))?.0;
        let behind = sums.mean(at, at + side, side.div_ceil(2))?.0;
        Some((at, behind - before))
    };
    let all: Vec<(usize, f64)> = (side..=values.len() - side)
        .filter_map(difference)
        .collect();
    if all.len() < side * LEAST_APART {
        return None;
    }
    let mut sizes: Vec<f64> = all.iter().map(|(_, size)| size.abs()).collect();
    let middle = sizes.len() / 2;
    let deviation = *sizes.select_nth_unstable_by(middle, f64::total_cmp).1 / MEDIAN_OF_NORMAL;
    let sharpest = |is_asked: &dyn Fn(usize, f64) -> bool| {
        let asked = all.iter().filter(|(at, sharp)| is_asked(*at, *sharp));
        let largest = asked.max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))?;
        (largest.1.abs() > stands_out * deviation).then_some(*largest)
    };
    let (at, sharp) = sharpest(&|_, _| true)?;
    let stay = whole_steps((LEAST_STAY_S * rate_hz).round()).max(side);
    let is_back = |other: usize, back: f64| other.abs_diff(at) >= stay && back * sharp < 0.0;
    let pair = sharpest(&is_back).and_then(|(other, _)| {
        let (from, to) = (at.min(other), at.max(other));
        sums.level(from, Some(to), side)
    });
    // Of the level that begins with the other edge.
    let of_pair = |level: &Level| if level.from == at { sharp } else { -sharp };
    let pair = pair.filter(|level| stays(level, of_pair(level)));
    let lone = sums.level(at, None, side);
    let lone = lone.filter(|level| stays(level, sharp));
    let found = [lone, pair].into_iter().flatten();
    found.max_by(|one, other| one.taken.total_cmp(&other.taken))
}

/// Whether a level is as different from the others as the second around its first sample says.
fn stays(level: &Level, sharp: f64) -> bool {
    level.size * sharp > STAYS * sharp * sharp
}

#[cfg(test)]
mod tests {
    use super::super::STANDS_OUT;
    use super::Level;

    const HZ: f64 = 50.0;

    fn level(values: &[f64]) -> Option<Level> {
        super::level(values, HZ, &[], STANDS_OUT)
    }

    /// Noise that remembers `kept` of itself from one sample to the next, of about a deviation of one.
    fn noise(samples: u32, kept: f64, seed: u32) -> Vec<f64> {
        let mut value = 0.0;
        let next = |k: u32| {
            let random =
                (12.9898 * f64::from(k + 1) + 78.233 * f64::from(seed)).sin() * 43_758.545_3;
            let white = (random.rem_euclid(1.0) - 0.5) * 12.0_f64.sqrt();
            value = kept * value + (1.0 - kept * kept).sqrt() * white;
            value
        };
        (0..samples).map(next).collect()
    }

    #[test]
    fn noise_of_any_color_has_no_step() {
        for kept in [0.0, 0.9, 0.98, 0.998, 1.0 - 1e-6] {
            for samples in [700, 1500, 5000] {
                let is_found = |seed: &u32| level(&noise(samples, kept, *seed)).is_some();
                let found = (0..200).filter(is_found).count();
                assert!(found <= 1, "{found} of 200, {kept}, {samples}");
            }
        }
    }

    #[test]
    fn a_step_is_found_where_it_is_and_a_pulse_of_a_second_is_none() {
        for seed in 0..20 {
            let mut values = noise(1500, 0.2, seed);
            for value in &mut values[900..] {
                *value += 3.0;
            }
            let found = level(&values).expect("a step");
            assert!(found.from.abs_diff(900) <= 10, "{found:?}");
            assert!((found.size - 3.0).abs() < 0.3, "{found:?}");
            assert_eq!(found.to, None);
            for value in &mut values[960..] {
                *value -= 3.0;
            }
            assert_eq!(level(&values), None);
        }
    }

    /// Up and back, wherever in the log, and down and back.
    #[test]
    fn a_step_that_comes_back_is_found_with_both_of_its_times() {
        for (from, to) in [(450, 750), (100, 900), (700, 1400), (900, 1010)] {
            for (seed, size) in [(1, 3.0), (2, -3.0), (3, 3.0), (4, -3.0)] {
                let mut values = noise(1500, 0.2, seed);
                for value in &mut values[from..to] {
                    *value += size;
                }
                let found = level(&values).expect("a step");
                let until = found.to.expect("an end");
                assert!(found.from.abs_diff(from) <= 10, "{from} {to} {found:?}");
                assert!(until.abs_diff(to) <= 10, "{from} {to} {found:?}");
                assert!((found.size - size).abs() < 0.5, "{from} {to} {found:?}");
            }
        }
    }

    /// A contact that the model has takes in what wanders while it lasts; further away steps are found.
    #[test]
    fn a_level_between_edges_of_a_column_is_none() {
        for seed in 0..20 {
            let mut values = noise(1500, 0.2, seed);
            for value in &mut values[900..1050] {
                *value += 3.0;
            }
            let found = super::level(&values, HZ, &[900, 1050], STANDS_OUT);
            assert_eq!(found, None);
            for value in &mut values[400..] {
                *value += 3.0;
            }
            let found = super::level(&values, HZ, &[900, 1050], STANDS_OUT).expect("a step");
            assert!(found.from.abs_diff(400) <= 10, "{found:?}");
        }
    }

    /// A joint that stands at first: its rows say nothing, and are no level.
    #[test]
    fn samples_that_say_nothing_are_no_level() {
        for seed in 0..20 {
            let mut values = noise(1500, 0.5, seed);
            for value in &mut values {
                *value += 5.0;
            }
            values[..800].fill(0.0);
            assert_eq!(level(&values), None);
        }
    }

    /// Dry friction that no law has: a level for every stroke, none of which stands out.
    #[test]
    fn a_wave_of_squares_is_no_step() {
        let mut values = noise(3000, 0.5, 1);
        for (k, value) in values.iter_mut().enumerate() {
            *value += 4.0 * (k as f64 / 40.0).sin().signum();
        }
        assert_eq!(level(&values), None);
    }
}
