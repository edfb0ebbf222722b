//! The highest line of what is left: a hum, or a law of time, is a line and no function of the motion.

use std::f64::consts::TAU;

use crate::identify::golden;
use crate::signal::resample::whole_steps;

use super::search::{Search, State};

/// Phases of a line in the spectrum are those of pieces of a log that are no longer than this, s.
const PIECE_S: f64 = 60.0;

impl Search<'_> {
    /// Frequency and share of the highest line of a joint's residual.
    pub(super) fn peak(&self, state: &State, joint: usize) -> (f64, f64) {
        let residual = match self.away(state) {
            Some(away) => &away.residuals[joint],
            None => &state.residuals[joint],
        };
        let segments = state.stack.segments.iter();
        let pieces = segments.flat_map(|segment| {
            let time = &segment.time;
            let seconds = time.last().map_or(0.0, |last| last - time[0]);
            let count = whole_steps((seconds / PIECE_S).ceil()).max(1);
            let rows = move |k: usize| k * time.len() / count;
            let of_piece = move |k| {
                let rows = rows(k)..rows(k + 1);
                let of_rows = segment.start + rows.start..segment.start + rows.end;
                (&time[rows], &residual[of_rows])
            };
            (0..count).map(of_piece)
        });
        let pieces: Vec<(&[f64], &[f64])> = pieces.filter(|(time, _)| time.len() > 2).collect();
        let total: f64 = residual.iter().map(|r| r * r).sum();
        let lasts = pieces
            .iter()
            .map(|(time, _)| time[time.len() - 1] - time[0]);
        let longest = lasts.fold(0.0, f64::max);
        if longest <= 0.0 || total <= 0.0 {
            return (0.0, 0.0);
        }
        let power = |hz: f64| -> f64 { pieces.iter().map(|piece| line(*piece, hz)).sum() };
        let step = 0.5 / longest;
        let lines = (2..=whole_steps(self.shared_hz / step)).map(|k| step * k as f64);
        let highest = lines.map(|hz| (power(hz), hz));
        let highest = highest.max_by(|a, b| a.0.total_cmp(&b.0));
        let about = highest.map_or(0.0, |(_, hz)| hz);
        let Ok(hz) = golden(about - step, about + step, &mut |hz| {
            Ok::<_, std::convert::Infallible>(-power(hz))
        });
        (hz, (power(hz) / total).min(1.0))
    }
}

/// Sum of squares of a sine of a frequency, of the amplitude and phase that values at some times have.
fn line((time, values): (&[f64], &[f64]), hz: f64) -> f64 {
    let (mut re, mut im) = (0.0, 0.0);
    for (time, value) in time.iter().zip(values) {
        let (sin, cos) = (TAU * hz * time).sin_cos();
        re += value * cos;
        im += value * sin;
    }
    2.0 * (re * re + im * im) / time.len() as f64
}

#[cfg(test)]
mod tests {
    use super::line;

    #[test]
    fn a_line_has_the_power_of_its_sine() {
        let time: Vec<f64> = (0..2000).map(|k| 0.01 * f64::from(k)).collect();
        let sine = |t: &f64| 3.0 * (7.0 * t + 0.4).sin() + (11.0 * t).cos();
        let values: Vec<f64> = time.iter().map(sine).collect();
        let hz = 7.0 / std::f64::consts::TAU;
        let power = line((&time, &values), hz) / 2000.0;
        assert!((power - 4.5).abs() < 0.1, "{power}");
    }
}
