//! How far a shape may move before that shows.
//!
//! A deviation is of the torque as it is next to the value that was found. Where a contact's force is next to nothing as it begins, the squared error
//! hardly rises for the half second before, however steep it is behind. So the error is followed along each shape, all linear parameters fitted
//! anew and the other shapes held, to where it is as large as the deviation with those held promises it at the ends of its interval. With the
//! others fitted anew as well it would be a profile of the likelihood (Venzon & Moolgavkar 1988).

use std::ops::Range;

use crate::identify::Z_95;

use super::gram::Gram;
use super::rows::Rows;
use super::score::Present;
use super::search::{Accepted, Search, State};
use super::small::solve_symmetric;
use super::trial::Trial;

/// The error is asked at these multiples of the half-width, each so many times the one before.
const FURTHER: f64 = 1.25;
const STEPS: i32 = 16;

impl Search<'_> {
    /// Widens deviations of an accepted effect's shapes, which are at these places of them, to those of its profiles.
    pub(super) fn widen_by_profiles(
        &self,
        state: &State,
        effect: &Accepted,
        linear: &Range<usize>,
        std: &mut [Option<f64>],
    ) {
        let trial = &effect.trial;
        if std.iter().all(Option::is_none) {
            return;
        }
        let sigma = &state.solution.sigma;
        let gram = Gram::new(&state.stack, &[]);
        let with = Present::new(&state.stack, &gram, sigma, &state.residuals);
        let mut stack = state.stack.clone();
        stack.silence(&linear.clone().collect::<Vec<_>>());
        let gram = Gram::new(&stack, &[]);
        let residuals = stack.residuals(&gram.normal(sigma).solve());
        let without = Present::new(&stack, &gram, sigma, &residuals);
        let rows = Rows::new(&self.prepared, &stack);
        let explained = |number: usize, value: f64| {
            let mut shapes = trial.shapes.clone();
            shapes[number] = value;
            let trial = Trial::new(trial.candidate, shapes, rows);
            let projected = trial.project(&without);
            projected.map_or(0.0, |p| p.admissible_drop(trial.candidate))
        };
        let gain = &state.solution.estimate[linear.clone()];
        let slopes = rows.slopes(trial.candidate, &trial.shapes, gain);
        let Some(open) = with.project(&slopes, trial.shapes.len()) else {
            return;
        };
        for (number, std) in std.iter_mut().enumerate() {
            let Some(told) = *std else { continue };
            // Variance that white noise makes of the shape with the others open, and what one unit of it adds to the squared error with them held.
            let mut unit = vec![0.0; trial.shapes.len()];
            unit[number] = 1.0;
            let white = solve_symmetric(&open.information, &unit)[number];
            let steep = open.information[number][number];
            if !(white > 0.0 && steep > 0.0) {
                continue;
            }
            let held = told / (white * steep).sqrt().max(1.0);
            let value = trial.shapes[number];
            let best = explained(number, value);
            let grid = &trial.candidate.shapes()[number].grid;
            let range = (grid[0], grid[grid.len() - 1]);
            let rise = |to: f64| best - explained(number, to);
            *std = Some(told.max(reach(&rise, value, range, (held, steep))));
        }
    }
}

/// The deviation whose interval reaches, to either side inside the range, as far as the error rises by no more than a parabola of this steepness
/// does at the ends of that of the deviation `held`; noise that is not correlated makes them no nearer than where it rises by `Z_95^2`.
fn reach(
    rise: &dyn Fn(f64) -> f64,
    value: f64,
    (low, high): (f64, f64),
    (held, steep): (f64, f64),
) -> f64 {
    let half = Z_95 * held;
    let allowed = (steep * half.powi(2)).max(Z_95.powi(2));
    let is_inside = |to: f64| (low..=high).contains(&to) && rise(to) < allowed;
    let steps = (0..STEPS).map(|step| half * FURTHER.powi(step));
    let inside = steps.take_while(|far| is_inside(value - far) || is_inside(value + far));
    inside.last().unwrap_or(half) / Z_95
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: (f64, f64) = (0.0, 60.0);

    #[test]
    fn a_parabola_has_the_deviation_that_it_had() {
        let rise = |to: f64| 25.0 * (to - 3.0).powi(2);
        // Not correlated, and with ten times the variance.
        for told in [0.2, 0.2 * 10.0_f64.sqrt()] {
            let found = reach(&rise, 3.0, ALL, (told, 25.0));
            assert!((found - told).abs() < 1e-9, "{told} {found}");
        }
    }

    /// A force that sets in with nothing at 8 s and was found to at 8.2 s: behind that the error rises by what the force is, before by next to
    /// nothing until 8 s.
    #[test]
    fn what_is_flat_on_one_side_reaches_as_far_as_it_is_flat() {
        let rise = |to: f64| {
            if to > 8.2 {
                1e4 * (to - 8.2).powi(2)
            } else {
                1e3 * (8.2 - to).powi(4)
            }
        };
        let found = reach(&rise, 8.2, ALL, (0.01, 1e4));
        // Where it rises by 1.96^2.
        let wanted = (Z_95.powi(2) / 1e3).powf(0.25) / Z_95;
        assert!(
            found > wanted / FURTHER && found <= wanted,
            "{found} {wanted}"
        );
    }

    /// A range ends before the error has risen.
    #[test]
    fn nothing_beyond_a_range_is_inside() {
        let found = reach(&|_| 0.0, 0.9, (0.2, 1.1), (0.05, 1.0));
        assert!(0.9 - Z_95 * found >= 0.2, "{found}");
        assert!(0.9 - FURTHER * Z_95 * found < 0.2, "{found}");
    }
}
