//! How small a joint's error can get: what no model of its motion takes away.
//!
//! Where a motion repeats, what does not come back with it is noise, whatever the model. Elsewhere curves in quantities of the motion, of
//! any form, are fitted to the residual one after the other, each judged on folds that it was not fitted on: what they leave is noise.

use super::away::LEAST_LEFT;
use super::curve::{Curve, STIFFNESS, fitted};
use super::periodic::laps;
use super::pulses;
use super::quantity::Quantity;
use super::raw::{above, mean_square};
use super::search::{Search, State};
use crate::identify::away_from_turns;
use crate::signal::resample::whole_steps;

/// Most curves that are fitted one after the other.
const MOST_CURVES: usize = 4;

/// A curve counts where it takes at least this share off the squared error of folds that it was not fitted on.
const LEAST_SHARE: f64 = 0.02;

/// Parts of a period whose mean squares are about independent of each other, where there are two.
const PARTS_OF_TWO: usize = 16;

/// Where a motion repeats, a model that leaves so many times what differs from period to period lacks something that comes back.
const BEYOND: f64 = 3.0;

/// By how much more than white noise of its size the steps of an encoder may count, in power.
pub(super) const STEPS_OVER_NOISE: f64 = 2.0;

/// From what a floor is known.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum FloorFrom {
    /// What differs from period to period of the motion.
    Periods,
    /// What curves in quantities of the motion leave of folds that they were not fitted on.
    Curves,
}

impl FloorFrom {
    /// Name in JSON.
    ///
    /// # Examples
    /// ```
    /// assert_eq!(robot_model::trace::FloorFrom::Periods.name(), "periods");
    /// ```
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Periods => "periods",
            Self::Curves => "curves",
        }
    }
}

/// The least error that a model of a joint's motion can have on the identification logs.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Floor {
    /// Root mean square of raw samples, N m or N.
    pub rms: f64,
    /// Its standard deviation, from how periods or folds differ.
    pub std: f64,
    /// From what it is known.
    pub from: FloorFrom,
    /// What the model leaves of samples away from the joint's turns, beyond what noise of the positions makes, root mean square, where the
    /// motion repeats; none where next to none are.
    pub left: Option<f64>,
    /// Share of the power of the model's residual that its largest twentieth of rows has, where the motion does not repeat; noise has some 28 %.
    /// Away from the joint's turns: none where the arm has no joint with dry friction, or where next to no rows are left.
    pub pulses: Option<f64>,
}

impl Floor {
    /// From mean squares of parts that are independent of each other.
    fn of_parts(parts: &[f64], from: FloorFrom) -> Self {
        let count = parts.len() as f64;
        let mean = parts.iter().sum::<f64>() / count;
        let spread = parts.iter().map(|part| (part - mean).powi(2)).sum::<f64>();
        let variance = spread / (count * (count - 1.0)).max(1.0);
        let rms = mean.max(0.0).sqrt();
        Self {
            rms,
            std: 0.5 * variance.sqrt() / rms.max(f64::MIN_POSITIVE),
            from,
            left: None,
            pulses: None,
        }
    }

    /// How many times the floor the model leaves of samples away from the joint's turns: [`Self::left`] over [`Self::rms`].
    ///
    /// # Examples
    /// ```
    /// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
    /// # use pendulum::{dry_friction, measure, pendulum};
    /// use robot_model::trace::Trace;
    /// let (arm, candidate) = (pendulum(), dry_friction());
    /// let traced = Trace::new(vec![&candidate]).run(&arm, &[measure(0.7)], &mut |_| ())?;
    /// let floor = traced.noise_floor[0];
    /// assert_eq!(floor.times(), floor.left.map(|left| left / floor.rms));
    /// # Ok::<(), robot_model::identify::IdentifyError>(())
    /// ```
    #[must_use]
    pub fn times(&self) -> Option<f64> {
        Some(self.left? / self.rms.max(f64::MIN_POSITIVE))
    }

    /// How many times the floor the model leaves, where that is too much for what differs from period to period: more than three times.
    ///
    /// # Examples
    /// ```
    /// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
    /// # use pendulum::{dry_friction, measure, pendulum};
    /// use robot_model::trace::Trace;
    /// let (arm, candidate) = (pendulum(), dry_friction());
    /// let traced = Trace::new(vec![&candidate]).run(&arm, &[measure(0.0)], &mut |_| ())?;
    /// assert_eq!(traced.noise_floor[0].exceeded(), None);
    /// # Ok::<(), robot_model::identify::IdentifyError>(())
    /// ```
    #[must_use]
    pub fn exceeded(&self) -> Option<f64> {
        self.times().filter(|times| *times > BEYOND)
    }

    /// The share of the residual's power in its largest twentieth of rows, where that is too much for noise: more than 90 %.
    ///
    /// # Examples
    /// ```
    /// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
    /// # use pendulum::{dry_friction, measure, pendulum};
    /// use robot_model::trace::Trace;
    /// let (arm, candidate) = (pendulum(), dry_friction());
    /// let traced = Trace::new(vec![&candidate]).run(&arm, &[measure(0.0)], &mut |_| ())?;
    /// assert_eq!(traced.noise_floor[0].pulsed(), None);
    /// # Ok::<(), robot_model::identify::IdentifyError>(())
    /// ```
    #[must_use]
    pub fn pulsed(&self) -> Option<f64> {
        self.pulses.filter(|share| *share > pulses::MOST)
    }
}

impl Search<'_> {
    /// The floor of every joint, in the residual of a model.
    pub(super) fn floor(&self, state: &State) -> Vec<Floor> {
        let calmest = self.raw_residuals(state);
        let raw = &calmest.residuals;
        let beyond = self.beyond_all(raw);
        let above = above(raw, &beyond, &state.residuals);
        let periodic = self.periods.iter().copied().collect::<Option<Vec<f64>>>();
        let of_joint = |joint: usize| {
            let changing = periodic.as_ref().and_then(|periods| {
                let logs = raw.iter().zip(&self.prepared).zip(periods);
                let parts = logs.map(|((log, prepared), period)| {
                    changing(&log[joint], period * prepared.rate_hz)
                });
                parts.collect::<Option<Vec<_>>>()
            });
            if let Some(parts) = changing {
                let parts = parts.into_iter().flatten();
                let parts: Vec<f64> = parts.map(|part| part + beyond[joint]).collect();
                let left = self.left_away(raw, joint);
                // Steps of an encoder come back with the motion, and are no torque.
                let noise = STEPS_OVER_NOISE * self.raw_noise(&calmest, joint);
                return Floor {
                    left: left.map(|left| (left + beyond[joint] - noise).max(0.0).sqrt()),
                    ..Floor::of_parts(&parts, FloorFrom::Periods)
                };
            }
            // What is above the band of rows is noise to any model: the lesser of two is known of both.
            let above = above[joint].min(self.declared_above[joint]);
            let parts = self.left_by_curves(&state.residuals[joint], joint);
            let parts: Vec<f64> = parts.into_iter().map(|part| part + above).collect();
            // Dry friction leaves pulses where joints turn round.
            let away = self.away(state);
            let away = away.filter(|away| away.mean_square(joint).is_some());
            Floor {
                pulses: away.map(|away| pulses::share_of_largest(&away.residuals[joint])),
                ..Floor::of_parts(&parts, FloorFrom::Curves)
            }
        };
        (0..self.arm.dof()).map(of_joint).collect()
    }

    /// Mean square of raw residuals of a joint away from its turns.
    fn left_away(&self, raw: &[Vec<Vec<f64>>], joint: usize) -> Option<f64> {
        let logs = raw.iter().zip(&self.prepared);
        let away = logs.flat_map(|(log, prepared)| {
            let is_away = away_from_turns(self.arm, prepared, joint);
            let is_away = is_away.into_iter().skip(prepared.shared.border());
            log[joint].iter().zip(is_away)
        });
        let away = away.filter_map(|(value, is_away)| is_away.then_some(*value));
        let away: Vec<f64> = away.collect();
        let samples: usize = raw.iter().map(|log| log[joint].len()).sum();
        (away.len() as f64 >= LEAST_LEFT * samples as f64).then(|| mean_square(&away))
    }

    /// Mean square per fold of what curves leave of a residual, each sample without the curves of its own fold.
    fn left_by_curves(&self, residual: &[f64], joint: usize) -> Vec<f64> {
        let mut left = residual.to_vec();
        let quantities = self.quantities(joint).filter(|of| *of != Quantity::Time);
        let mut curves: Vec<Curve> = quantities.filter_map(|of| self.curve(of)).collect();
        for _ in 0..MOST_CURVES {
            let least = (1.0 - LEAST_SHARE) * mean_square(&left);
            let judged = curves.iter().enumerate().flat_map(|(k, curve)| {
                let rests = self.out_of_fold(curve, &left).into_iter();
                rests.map(move |rest| (mean_square(&rest), k, rest))
            });
            let best = judged.min_by(|a, b| a.0.total_cmp(&b.0));
            let Some((_, k, rest)) = best.filter(|(power, ..)| *power < least) else {
                break;
            };
            left = rest;
            curves.swap_remove(k);
        }
        let of_fold = |rows: &Vec<usize>| {
            let squares = rows.iter().map(|&k| left[k] * left[k]);
            squares.sum::<f64>() / rows.len().max(1) as f64
        };
        self.folds.iter().map(|fold| of_fold(&fold.test)).collect()
    }

    /// What a curve of each stiffness, fitted to the rows of every fold that it may see, leaves of the others.
    fn out_of_fold(&self, curve: &Curve, values: &[f64]) -> [Vec<f64>; STIFFNESS.len()] {
        let mut left = STIFFNESS.map(|_| values.to_vec());
        for fold in &self.folds {
            let fitted = fitted(curve, values, &fold.train);
            for (left, gain) in left.iter_mut().zip(&fitted) {
                for &row in &fold.test {
                    let terms = gain.iter().zip(&curve.columns);
                    left[row] -= terms.map(|(gain, column)| gain * column[row]).sum::<f64>();
                }
            }
        }
        left
    }
}

/// Mean square of every whole period of what differs from the mean of all, as it would be about the mean of endlessly many; `None` where too
/// little comes again. Two periods differ from their mean by as much, so those of parts of both are taken.
fn changing(values: &[f64], length: f64) -> Option<Vec<f64>> {
    let (periods, bins) = laps(values.len(), length)?;
    let at = |p: usize, k: usize| {
        let row = whole_steps((p as f64 * length).round() + k as f64);
        values[row.min(values.len() - 1)]
    };
    let mean = |k: usize| (0..periods).map(|p| at(p, k)).sum::<f64>() / periods as f64;
    let means: Vec<f64> = (0..bins).map(mean).collect();
    let fewer = periods as f64 / (periods - 1) as f64;
    let square = |p: usize, k: usize| fewer * (at(p, k) - means[k]).powi(2);
    if periods == 2 {
        let count = PARTS_OF_TWO.min(bins);
        let part = |part: usize| part * bins / count..(part + 1) * bins / count;
        let of_part = |part: std::ops::Range<usize>| {
            let (length, squares) = (part.len(), part.map(|k| square(0, k)));
            squares.sum::<f64>() / length as f64
        };
        return Some((0..count).map(part).map(of_part).collect());
    }
    let of_period = |p: usize| (0..bins).map(|k| square(p, k)).sum::<f64>() / bins as f64;
    Some((0..periods).map(of_period).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers without order, from -0.5 to 0.5.
    fn noise(k: usize) -> f64 {
        (12.9898 * (k as f64 + 1.0))
            .sin()
            .mul_add(43_758.545_3, 0.0)
            .rem_euclid(1.0)
            - 0.5
    }

    #[test]
    fn what_comes_back_is_not_in_the_floor() {
        let length = 250.5;
        // Seven periods, two, which differ from their mean alike, and less than two.
        for samples in [2000, 501, 400] {
            let values: Vec<f64> = (0..samples)
                .map(|k| (std::f64::consts::TAU * k as f64 / length).sin() + 0.2 * noise(k))
                .collect();
            let parts = changing(&values, length).expect("it comes again");
            let floor = Floor::of_parts(&parts, FloorFrom::Periods);
            let truth = 0.2 / 12.0_f64.sqrt();
            assert!((floor.rms - truth).abs() < 0.1 * truth, "{floor:?}");
            assert!((0.001..0.1).contains(&(floor.std / truth)), "{floor:?}");
        }
        assert_eq!(changing(&[0.0; 300], length), None);
    }
}
