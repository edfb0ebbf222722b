//! Axes of drawings: their ticks are round numbers, and as many as one reads.

use std::ops::Range;

use plotters::coord::ranged1d::{DefaultFormatting, KeyPointHint, Ranged};

/// Ticks at an axis, about.
const TICKS: f64 = 5.0;

/// Powers of ten that an axis spans at least where no numbers between them have ticks, and where few have.
const WIDE: f64 = 2.0;
const NARROW: f64 = 0.8;

/// Numbers from one end to the other, with ticks.
pub(super) struct Axis {
    range: Range<f64>,
    ticks: Vec<f64>,
}

impl Axis {
    /// With ticks at these numbers.
    pub fn at(range: Range<f64>, ticks: Vec<f64>) -> Self {
        Self { range, ticks }
    }

    /// With steps of 1, 2 or 5 times a power of ten.
    pub fn linear(range: Range<f64>) -> Self {
        let rough = (range.end - range.start) / TICKS;
        let power = 10.0_f64.powf(rough.log10().floor());
        let steps = [1.0, 2.0, 5.0, 10.0].map(|times| times * power);
        let step = steps.into_iter().find(|step| *step >= rough);
        let step = step.unwrap_or(rough);
        let first = (range.start / step).ceil();
        let ticks = (0..).map(|k| (first + f64::from(k)) * step);
        let ticks = ticks.take_while(|at| *at <= range.end).collect();
        Self { range, ticks }
    }

    /// Of powers of ten, whose exponents the range has: a tick at each, on a short axis at multiples of each, too.
    pub fn of_powers(range: Range<f64>) -> Self {
        let between: &[f64] = match range.end - range.start {
            span if span < NARROW => &[1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0],
            span if span < WIDE => &[1.0, 2.0, 5.0],
            _ => &[1.0],
        };
        let first = range.start.floor();
        let powers = (0..).map(|k| first + f64::from(k));
        let powers = powers.take_while(|power| *power <= range.end);
        let ticks = powers.flat_map(|power| between.iter().map(move |one| power + one.log10()));
        let ticks = ticks.filter(|at| range.contains(at)).collect();
        Self { range, ticks }
    }
}

impl Ranged for Axis {
    type FormatOption = DefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, (low, high): (i32, i32)) -> i32 {
        let share = (value - self.range.start) / (self.range.end - self.range.start);
        pixel(f64::from(low) + share * f64::from(high - low))
    }

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        if hint.weight().allow_light_points() {
            Vec::new()
        } else {
            self.ticks.clone()
        }
    }

    fn range(&self) -> Range<f64> {
        self.range.clone()
    }
}

/// A place in a drawing, which has some hundred.
#[expect(clippy::cast_possible_truncation)]
fn pixel(place: f64) -> i32 {
    place.round() as i32
}

#[cfg(test)]
mod tests {
    use super::Axis;

    #[test]
    fn ticks_are_round_numbers_within_the_range() {
        let near = |axis: Axis, wanted: &[f64]| {
            let pairs = axis.ticks.iter().zip(wanted);
            let is_near = pairs
                .into_iter()
                .all(|(at, wanted)| (at - wanted).abs() < 1e-12);
            assert!(
                is_near && axis.ticks.len() == wanted.len(),
                "{:?}",
                axis.ticks
            );
        };
        near(Axis::linear(-0.33..0.33), &[-0.2, 0.0, 0.2]);
        near(Axis::linear(0.0..11.2), &[0.0, 5.0, 10.0]);
        near(Axis::linear(1e-7..5.2e-7), &[1e-7, 2e-7, 3e-7, 4e-7, 5e-7]);
        near(Axis::of_powers(-0.7..2.3), &[0.0, 1.0, 2.0]);
        near(Axis::of_powers(0.1..0.5), &[1.5, 2.0, 3.0].map(f64::log10));
        near(
            Axis::of_powers(0.1..1.1),
            &[2.0_f64.log10(), 5.0_f64.log10(), 1.0],
        );
    }
}
