//! A motor whose voltage was not logged, but was switched between constants.
//!
//! With the current (or the voltage across a known resistance) `u` and the velocity `w`, the commanded voltage is `v = u + k w`, in
//! the units of `u`. It is a square wave, so `k` is the factor that makes `v` constant in pieces.
//!
//! Starts: slopes `-du/dw` between samples that are 1, 2, 4, .. apart, and of each distance the median weighed with `|dw|`, but by no
//! more than the median `|dw|`. Plain least absolute differences weigh by all of `|dw|`; where a motor follows its voltage quickly
//! most of `w` changes at the switches, and the factor that hides these is found in place of `k`. From each start jumps are found
//! and `k` by least squares with a constant for each piece, in turns, until the pieces stay the same; the result with the least
//! Bayesian criterion counts.

use std::ops::Range;

use super::inductance;
use super::pieces::pieces;
use super::statistics::{mean, scatter};
use super::voltage::vary;
use super::windows::{REACH, Windows, check_time};
use super::{CalibrateError, Measured, check};
use crate::identify::long_run_sum;

/// Fewest samples.
const LEAST: usize = 32;

/// Fewest samples of a piece; shorter ones are transitions, and count for nothing.
const SHORTEST: usize = 8;

/// What a jump has to be worth: so many times the variance of the noise, times `ln n`. White noise asks for 2; noise of windows
/// or filters, which is alike over some samples, for several times that, and switches are larger still.
const PRICE: f64 = 16.0;

/// How often jumps and factor are found in turns, at most.
const ROUNDS: usize = 50;

/// Variance below this share of that of a channel is rounding.
const ROUNDING: f64 = 1e-16;

/// Percentages below which nothing is constant in pieces.
const HELD: f64 = 50.0;
const EXPLAINED: f64 = 90.0;
const BY_JUMPS: f64 = 75.0;

/// A voltage `v = u + back_emf * w` that is constant in pieces.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Commanded {
    /// The factor `k`, in units of `u` per rad/s. The deviation is that of errors that are alike from sample to sample.
    pub back_emf: Measured,
    /// The constants, in order.
    pub pieces: Vec<Piece>,
    /// Percent of the samples that are in pieces.
    pub held: f64,
    /// Percent of the variance of `v` there that the constants explain.
    pub explained: f64,
    /// Percent of all change of `v` that is in jumps, and not in slopes of the pieces.
    pub by_jumps: f64,
    /// Standard deviation of `v` about its constants, in units of `u`.
    pub residual_std: f64,
    /// By how many percent noise of the velocity may have made `k` too small, at most: were all that is left of it.
    pub attenuation: f64,
    /// By which share `k` is too large for each second of the winding's electric time constant, whose voltage is left out; a `u`
    /// [`with_inductance`](super::with_inductance) has it.
    pub by_time_constant: f64,
    /// Samples in pieces.
    pub samples: usize,
    /// `v`, one a sample or window.
    pub voltage: Vec<f64>,
}

/// A constant.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Piece {
    /// First sample, s.
    pub start: f64,
    /// Last sample, s.
    pub end: f64,
    /// Mean of `v`, in units of `u`.
    pub level: f64,
}

impl Commanded {
    /// From time (s), `u` and velocity (rad/s), `[sample]`.
    ///
    /// # Errors
    /// [`CalibrateError`] for channels of different lengths, values that are not finite, fewer than 32 samples, time that does not
    /// rise or has gaps, `u` or a velocity that does not vary, also between switches; where no switch is found, and where no factor
    /// makes the voltage constant in pieces.
    ///
    /// # Examples
    /// ```
    /// use robot_model::calibrate::Commanded;
    /// // A square wave of 3 V, of which a log has `u = v - 1.5 w`.
    /// let time: Vec<f64> = (0..200).map(|k| 0.02 * f64::from(k)).collect();
    /// let w: Vec<f64> = time.iter().map(|t| (5.0 * t).sin()).collect();
    /// let wave = |t: f64| if (t - 0.5).rem_euclid(2.0) < 1.0 { 3.0 } else { -3.0 };
    /// let u: Vec<f64> = time.iter().zip(&w).map(|(&t, w)| wave(t) - 1.5 * w).collect();
    /// let found = Commanded::find(&time, &u, &w)?;
    /// assert!((found.back_emf.value - 1.5).abs() < 1e-9 && (found.pieces[1].level - 3.0).abs() < 1e-9);
    /// # Ok::<(), robot_model::calibrate::CalibrateError>(())
    /// ```
    pub fn find(time: &[f64], u: &[f64], velocity: &[f64]) -> Result<Self, CalibrateError> {
        check(&[time, u, velocity], LEAST)?;
        check_time(time)?;
        Self::search(time, u, velocity, 0)
    }

    /// From `u` at each sample of a motion, whose velocities are those of windows. Samples beside switches are left out.
    ///
    /// # Errors
    /// As [`Commanded::find`].
    ///
    /// # Examples
    /// ```
    /// use robot_model::calibrate::{Commanded, Windows};
    /// let time: Vec<f64> = (0..400).map(|k| 0.01 * f64::from(k)).collect();
    /// let position: Vec<f64> = time.iter().map(|t| -0.2 * (5.0 * t).cos()).collect();
    /// let wave = |t: f64| if (t - 0.5).rem_euclid(2.0) < 1.0 { 3.0 } else { -3.0 };
    /// let drop: Vec<f64> = time.iter().map(|t| wave(*t) - 1.5 * (5.0 * t).sin()).collect();
    /// let found = Commanded::find_in(&Windows::new(&time, &position)?, &drop)?;
    /// assert!((found.back_emf.value - 1.5).abs() < 0.002);
    /// # Ok::<(), robot_model::calibrate::CalibrateError>(())
    /// ```
    pub fn find_in(windows: &Windows, u: &[f64]) -> Result<Self, CalibrateError> {
        if u.len() != windows.logged() {
            return Err(CalibrateError::Lengths);
        }
        check(&[u], LEAST + 2 * REACH)?;
        Self::search(&windows.time, &windows.means(u), &windows.velocity, 1)
    }

    /// When the voltage was switched, s: in the middle between two pieces.
    ///
    /// # Examples
    /// The wave of the [module](super) switches at 0.5, 1.5, 2.5 and 3.5 s, found to half a sample:
    /// ```
    /// # use robot_model::calibrate::Commanded;
    /// # let time: Vec<f64> = (0..200).map(|k| 0.02 * f64::from(k)).collect();
    /// # let velocity: Vec<f64> = time.iter().map(|t| (5.0 * t).sin()).collect();
    /// let wave = |t: f64| if (t - 0.5).rem_euclid(2.0) < 1.0 { 3.0 } else { -3.0 };
    /// let drop: Vec<f64> = time.iter().zip(&velocity).map(|(&t, w)| wave(t) - 1.5 * w).collect();
    /// let switches = Commanded::find(&time, &drop, &velocity)?.switches();
    /// for (switch, truth) in switches.iter().zip([0.5, 1.5, 2.5, 3.5]) {
    ///     assert!((switch - truth).abs() < 0.02);
    /// }
    /// # assert_eq!(switches.len(), 4);
    /// # Ok::<(), robot_model::calibrate::CalibrateError>(())
    /// ```
    #[must_use]
    pub fn switches(&self) -> Vec<f64> {
        let pairs = self.pieces.windows(2);
        pairs.map(|two| 0.5 * (two[0].end + two[1].start)).collect()
    }

    fn search(time: &[f64], u: &[f64], w: &[f64], guard: usize) -> Result<Self, CalibrateError> {
        vary(u, w)?;
        let series = Series { u, w, guard };
        let distances = std::iter::successors(Some(1), |distance| Some(2 * distance));
        let trials = distances
            .take_while(|distance| *distance <= u.len() / 8)
            .filter_map(|distance| series.start(distance))
            .map(|start| series.refine(start));
        let best = trials.min_by(|one, other| one.cost.total_cmp(&other.cost));
        let Some(trial) = best.filter(|trial| trial.back_emf.is_finite()) else {
            return Err(CalibrateError::NoSwitch);
        };
        series.judge(time, &trial)
    }
}

struct Series<'a> {
    u: &'a [f64],
    w: &'a [f64],
    /// Samples beside a switch that count for nothing.
    guard: usize,
}

/// What a start has led to.
struct Trial {
    back_emf: f64,
    kept: Vec<Range<usize>>,
    cost: f64,
}

impl Series<'_> {
    /// `v` for a factor.
    fn voltage(&self, k: f64) -> Vec<f64> {
        let pairs = self.u.iter().zip(self.w);
        pairs.map(|(u, w)| u + k * w).collect()
    }

    /// Median slope between samples so far apart; `None` where the velocity is the same in all pairs.
    fn start(&self, distance: usize) -> Option<f64> {
        let ends = (0..self.u.len() - distance).map(|k| (k, k + distance));
        let mut slopes: Vec<(f64, f64)> = ends
            .map(|(k, l)| (self.u[l] - self.u[k], self.w[l] - self.w[k]))
            .filter(|(_, dw)| *dw != 0.0)
            .map(|(du, dw)| (-du / dw, dw.abs()))
            .collect();
        let mut weights: Vec<f64> = slopes.iter().map(|slope| slope.1).collect();
        weights.sort_unstable_by(f64::total_cmp);
        let most = *weights.get(weights.len() / 2)?;
        let half = 0.5 * weights.iter().map(|weight| weight.min(most)).sum::<f64>();
        slopes.sort_unstable_by(|one, other| one.0.total_cmp(&other.0));
        let mut sum = 0.0;
        let median = slopes.iter().find(|slope| {
            sum += slope.1.min(most);
            sum >= half
        });
        median.map(|slope| slope.0)
    }

    /// Jumps and factor in turns.
    fn refine(&self, start: f64) -> Trial {
        let count = self.u.len() as f64;
        let mut k = start;
        let mut v = self.voltage(k);
        let mut noise = variance_of_steps(&v);
        let mut found = Vec::new();
        let mut kept = Vec::new();
        for _ in 0..ROUNDS {
            let least = ROUNDING * scatter(self.u) / count;
            let now = pieces(&v, PRICE * count.ln() * noise.max(least));
            if now == found {
                break;
            }
            kept = self.kept(&now);
            found = now;
            let Some(better) = self.factor(&kept) else {
                break;
            };
            k = better;
            v = self.voltage(k);
            noise = about_constants(&v, &kept) / freedom(&kept).max(1.0);
        }
        // Rounding must not decide between two that are exact.
        let left = about_constants(&v, &found) + 1e-12 * scatter(self.u);
        Trial {
            back_emf: k,
            cost: count * (left / count).ln() + PRICE * count.ln() * found.len() as f64,
            kept,
        }
    }

    /// Pieces that are long enough, without the samples beside switches.
    fn kept(&self, found: &[Range<usize>]) -> Vec<Range<usize>> {
        let long = found.iter().filter(|piece| piece.len() >= SHORTEST);
        let inside = |piece: &Range<usize>| {
            let start = piece.start + if piece.start == 0 { 0 } else { self.guard };
            let is_last = piece.end == self.u.len();
            start..piece.end - if is_last { 0 } else { self.guard }
        };
        long.map(inside).collect()
    }

    /// Least squares with a constant for each piece; `None` where the velocity is constant too.
    fn factor(&self, kept: &[Range<usize>]) -> Option<f64> {
        let spread = about_constants(self.w, kept);
        if spread <= ROUNDING * scatter(self.w) {
            return None;
        }
        Some(-along(self.w, self.u, kept) / spread)
    }

    /// The result, unless it is none.
    fn judge(&self, time: &[f64], trial: &Trial) -> Result<Commanded, CalibrateError> {
        let (k, kept) = (trial.back_emf, &trial.kept);
        let v = self.voltage(k);
        let samples: usize = kept.iter().map(Range::len).sum();
        let inside: Vec<f64> = kept.iter().flat_map(|p| v[p.clone()].to_vec()).collect();
        let left = about_constants(&v, kept);
        let held = 100.0 * samples as f64 / v.len() as f64;
        // One constant and the velocity explain the log: so would friction.
        let of_u: Vec<f64> = kept
            .iter()
            .flat_map(|p| self.u[p.clone()].to_vec())
            .collect();
        let is_one = kept.len() == 1 && held >= HELD;
        if is_one && 100.0 * left <= (100.0 - EXPLAINED) * scatter(&of_u) {
            return Err(CalibrateError::NoSwitch);
        }
        let levels: Vec<f64> = kept.iter().map(|p| mean(&v[p.clone()])).collect();
        let jumps: f64 = levels.windows(2).map(|two| (two[1] - two[0]).abs()).sum();
        let rises: f64 = kept.iter().map(|piece| rise(&v[piece.clone()])).sum();
        let percent = |part: f64, whole: f64| {
            if whole > 0.0 {
                100.0 * part / whole
            } else {
                0.0
            }
        };
        let by_jumps = percent(jumps, jumps + rises);
        let all = if inside.is_empty() {
            0.0
        } else {
            scatter(&inside)
        };
        let explained = percent(all - left, all);
        if held < HELD || explained < EXPLAINED || by_jumps < BY_JUMPS {
            return Err(CalibrateError::NotInPieces {
                back_emf: k,
                held,
                explained,
                by_jumps,
                shortest: SHORTEST,
            });
        }
        let spread = about_constants(self.w, kept);
        if self.factor(kept).is_none() {
            return Err(CalibrateError::Stands {
                what: "velocity between switches",
                mend: "let it vary there: by gravity, or from switch to steady speed at a faster rate",
            });
        }
        let freedom = freedom(kept).max(1.0);
        let correction = samples as f64 / freedom;
        let std = (correction * long_run_sum(&self.influence(&v, kept, spread)))
            .max(0.0)
            .sqrt();
        // Errors of `v` are those of `u` and `k` times those of `w`; the latter's share of the velocity is that of what is missed.
        let ratio = left / (k * k * spread);
        let piece = |(range, level): (&Range<usize>, f64)| Piece {
            start: time[range.start],
            end: time[range.end - 1],
            level,
        };
        let slopes = inductance::slopes(time, self.u);
        Ok(Commanded {
            back_emf: Measured::new(k, std, freedom),
            by_time_constant: along(self.w, &slopes, kept) / (spread * k),
            pieces: kept.iter().zip(levels).map(piece).collect(),
            held,
            explained,
            by_jumps,
            residual_std: (left / freedom).sqrt(),
            attenuation: 100.0 * ratio / (1.0 + ratio),
            samples,
            voltage: v,
        })
    }

    /// What each sample moves the factor by.
    fn influence(&self, v: &[f64], kept: &[Range<usize>], spread: f64) -> Vec<f64> {
        let of_piece = |piece: &Range<usize>| {
            let (w, v) = (&self.w[piece.clone()], &v[piece.clone()]);
            let (center, level) = (mean(w), mean(v));
            let pairs = w.iter().zip(v);
            let moves = pairs.map(|(w, v)| (w - center) * (v - level) / spread);
            moves.collect::<Vec<f64>>()
        };
        kept.iter().flat_map(of_piece).collect()
    }
}

/// Samples that are more than the constants and the factor.
fn freedom(kept: &[Range<usize>]) -> f64 {
    let samples: usize = kept.iter().map(Range::len).sum();
    samples as f64 - kept.len() as f64 - 1.0
}

/// Squares about the mean of each piece.
fn about_constants(values: &[f64], kept: &[Range<usize>]) -> f64 {
    let pieces = kept.iter().map(|piece| scatter(&values[piece.clone()]));
    pieces.sum()
}

/// Products with the velocity about its mean of each piece.
fn along(w: &[f64], values: &[f64], kept: &[Range<usize>]) -> f64 {
    let products = kept.iter().map(|piece| {
        let center = mean(&w[piece.clone()]);
        let pairs = w[piece.clone()].iter().zip(&values[piece.clone()]);
        pairs.map(|(w, value)| (w - center) * value).sum::<f64>()
    });
    products.sum()
}

/// Variance of the noise from the steps of a series, without the tenth that is largest, where the jumps are.
fn variance_of_steps(values: &[f64]) -> f64 {
    let steps = values.windows(2).map(|pair| (pair[1] - pair[0]).powi(2));
    let mut squares: Vec<f64> = steps.collect();
    squares.sort_unstable_by(f64::total_cmp);
    squares.truncate(squares.len() - squares.len() / 10);
    0.5 * mean(&squares)
}

/// By how much a line through a piece rises or falls over it.
fn rise(values: &[f64]) -> f64 {
    let count = values.len() as f64;
    let middle = 0.5 * (count - 1.0);
    let centered = (0..values.len()).map(|k| k as f64 - middle);
    let product: f64 = centered.zip(values).map(|(k, v)| k * v).sum();
    // `sum k^2 = n (n^2 - 1) / 12`.
    let slope = 12.0 * product / (count * (count * count - 1.0));
    (slope * (count - 1.0)).abs()
}

#[cfg(test)]
mod tests;
