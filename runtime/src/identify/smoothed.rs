//! Torques that went through a low-pass which positions did not go through.
//!
//! Dry friction jumps where a joint turns round. A filter in the torque's channel rounds the jump, and what a model has there and the log
//! has not looks like a law of low speeds with a negative sign. It is a filter of the recorder where two things hold: what the model says
//! comes nearer to all torques by one and the same low-pass, nearer than by any delay, and the torques have no more beyond it than it
//! leaves: noise of a sensor is there as much as below.

use super::{Estimate, IdentifyError};
use crate::columns::Arm;
use crate::log::Log;
use crate::signal::resample::whole_steps;
use crate::signal::{FirstOrder, LowPass, band_density};

/// Cutoffs that are tried, Hz: from the first, each so many times the one before.
const LOWEST_HZ: f64 = 0.7;
const STEP: f64 = 1.25;
/// The highest is this share of the log's rate, and no more than what hardly rounds a turn of a joint, Hz. What is best there has no end.
const HIGHEST: f64 = 0.1;
const HIGHEST_HZ: f64 = 30.0;

/// By which share the error above half the cutoff has to be less, on the joint where that is most, and on at least three of four joints.
const MOST_SHARE: f64 = 0.3;
const SHARE: f64 = 0.1;
const JOINTS: f64 = 0.75;
/// By which share the error of any joint may be larger.
const WORSE: f64 = 0.02;

/// Beyond this many times the cutoff torques have less than this share of the density that they have below it, or less than so many times what
/// the low-pass leaves there of the model's: noise of a sensor behind the filter would be more.
const BEYOND: f64 = 3.0;
const EMPTY: f64 = 1e-4;
const AS_MUCH: f64 = 2.0;

/// Order of the low-pass without phase, one way.
const ORDER: usize = 4;

/// Delays that are tried in place of a low-pass are at most this many seconds.
const LATEST_S: f64 = 0.06;

/// A low-pass in the channel of all torques.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Smoothed {
    /// Its cutoff, Hz.
    pub cutoff_hz: f64,
    /// Whether it lags, as a filter of the first order does that runs along; else it has no phase, as one that ran forward and backward.
    pub lags: bool,
    /// By which share the error is less on the joint where that is most.
    pub share: f64,
}

/// What may stand between the torque and its channel.
enum Channel {
    Late(usize),
    Lag(FirstOrder),
    ZeroPhase(LowPass),
}

impl Channel {
    fn apply(&self, torque: &[f64]) -> Vec<f64> {
        let mut out = Vec::new();
        match self {
            Self::Late(samples) => {
                let first = torque.first().copied().unwrap_or(0.0);
                out.resize((*samples).min(torque.len()), first);
                out.extend_from_slice(&torque[..torque.len() - out.len()]);
            }
            Self::Lag(filter) => {
                filter.apply(torque.first().copied().unwrap_or(0.0), torque, &mut out);
            }
            Self::ZeroPhase(filter) => filter.apply(torque, &mut out),
        }
        out
    }
}

impl Estimate {
    /// The low-pass that the torques of a log went through and its positions did not; none where nothing speaks for one.
    ///
    /// # Errors
    /// Those of [`Self::predict`].
    ///
    /// # Examples
    /// A drive that logs its torque through a low-pass of 1 Hz, `L(s) = w / (s + w)`:
    /// ```
    /// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
    /// # use pendulum::{measure, pendulum};
    /// # use robot_model::{identify::Identify, signal::FirstOrder};
    /// let (arm, mut log) = (pendulum(), measure(0.0));
    /// let estimate = Identify::default().fit(&arm, std::slice::from_ref(&log))?;
    /// assert_eq!(estimate.smoothed(&arm, &log)?, None);
    /// let lag = FirstOrder::new(std::f64::consts::TAU, log.rate_hz()).expect("below the log's rate");
    /// let torque = log.tau[0].clone();
    /// lag.apply(torque[0], &torque, &mut log.tau[0]);
    /// let found = estimate.smoothed(&arm, &log)?.expect("all torques are rounded");
    /// assert!(found.lags && (found.cutoff_hz - 1.0).abs() < 0.2);
    /// # Ok::<(), robot_model::identify::IdentifyError>(())
    /// ```
    pub fn smoothed(&self, arm: &dyn Arm, log: &Log) -> Result<Option<Smoothed>, IdentifyError> {
        let predicted = self.predict(arm, log)?;
        let gains = arm.actuator_gain().iter();
        let measured = log.tau.iter().zip(gains);
        let measured =
            measured.map(|(tau, gain)| tau.iter().map(|tau| gain * tau).collect::<Vec<f64>>());
        Ok(find(
            &measured.collect::<Vec<_>>(),
            &predicted,
            log.rate_hz(),
        ))
    }
}

fn find(measured: &[Vec<f64>], predicted: &[Vec<f64>], rate_hz: f64) -> Option<Smoothed> {
    let samples = measured.first().map_or(0, Vec::len);
    let border = whole_steps(rate_hz).min(samples / 4);
    let errors = |channel: &Channel| -> Vec<f64> {
        let joints = measured.iter().zip(predicted);
        let error = |(measured, predicted): (&Vec<f64>, &Vec<f64>)| {
            let through = channel.apply(predicted);
            let inner = border..samples - border;
            let squares = inner.map(|k| (measured[k] - through[k]).powi(2));
            squares.sum::<f64>().sqrt()
        };
        joints.map(error).collect()
    };
    let told = |errors: &[f64]| {
        let logarithms = errors.iter().map(|error| error.max(f64::MIN_POSITIVE).ln());
        logarithms.sum::<f64>()
    };
    let best = |channels: Vec<(f64, Channel)>| {
        let tried = channels
            .into_iter()
            .map(|(cutoff, channel)| (cutoff, errors(&channel), channel));
        tried.min_by(|a, b| told(&a.1).total_cmp(&told(&b.1)))
    };
    let (_, _, late) = best(delays(rate_hz))?;
    let low_passes = low_passes(rate_hz);
    let highest = low_passes.last().map_or(0.0, |(hz, _)| *hz);
    let (cutoff_hz, _, channel) = best(low_passes).filter(|(hz, ..)| *hz < highest)?;
    // What a model lacks is slow: the low-pass has to be in what is fast.
    let slow_part = LowPass::butterworth(2, cutoff_hz / 2.0, rate_hz).ok()?;
    let fast_error = |joint: usize, channel: &Channel| {
        let through = channel.apply(&predicted[joint]);
        let error = measured[joint].iter().zip(through);
        let error: Vec<f64> = error
            .map(|(measured, through)| measured - through)
            .collect();
        let mut slow = Vec::new();
        slow_part.apply(&error, &mut slow);
        let inner = border..samples - border;
        let squares = inner.map(|k| (error[k] - slow[k]).powi(2));
        squares.sum::<f64>().sqrt()
    };
    let shares = (0..measured.len()).map(|joint| {
        let (with, without) = (fast_error(joint, &channel), fast_error(joint, &late));
        1.0 - with / without.max(f64::MIN_POSITIVE)
    });
    let shares: Vec<f64> = shares.collect();
    let share = shares.iter().copied().fold(0.0, f64::max);
    let nearer = shares.iter().filter(|share| **share >= SHARE).count();
    let is_nearer = share >= MOST_SHARE
        && nearer as f64 >= JOINTS * shares.len() as f64
        && shares.iter().all(|share| *share > -WORSE);
    let is_empty = |(torque, predicted): (&Vec<f64>, &Vec<f64>)| {
        let edges = [
            cutoff_hz / 2.0,
            cutoff_hz,
            BEYOND * cutoff_hz,
            0.45 * rate_hz,
        ];
        let [of_torque, of_model] =
            [torque, &channel.apply(predicted)].map(|torque| band_density(torque, rate_hz, &edges));
        of_torque[2] < EMPTY * of_torque[0] || of_torque[2] < AS_MUCH * of_model[2]
    };
    (is_nearer && measured.iter().zip(predicted).all(is_empty)).then_some(Smoothed {
        cutoff_hz,
        lags: matches!(channel, Channel::Lag(_)),
        share,
    })
}

/// From no delay on, with a cutoff of none.
fn delays(rate_hz: f64) -> Vec<(f64, Channel)> {
    let most = whole_steps(LATEST_S * rate_hz);
    let step = most.div_ceil(30).max(1);
    let delays = (0..=most).step_by(step);
    delays
        .map(|samples| (f64::INFINITY, Channel::Late(samples)))
        .collect()
}

fn low_passes(rate_hz: f64) -> Vec<(f64, Channel)> {
    let highest = HIGHEST_HZ.min(HIGHEST * rate_hz);
    let cutoffs = std::iter::successors(Some(LOWEST_HZ), |hz| Some(STEP * hz));
    let cutoffs = cutoffs.take_while(|hz| *hz <= highest);
    let both = |hz: f64| {
        let lag = FirstOrder::new(std::f64::consts::TAU * hz, rate_hz).ok();
        let zero_phase = LowPass::butterworth(ORDER, hz, rate_hz).ok();
        let channels = [lag.map(Channel::Lag), zero_phase.map(Channel::ZeroPhase)];
        channels
            .into_iter()
            .flatten()
            .map(move |channel| (hz, channel))
    };
    cutoffs.flat_map(both).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const RATE: f64 = 500.0;

    /// A torque with dry friction, and the speed that turns it.
    fn friction(k: usize) -> f64 {
        let t = k as f64 / RATE;
        let speed = (2.0 * t).cos() + 0.6 * (5.3 * t).cos();
        speed.signum() + 0.3 * speed
    }

    fn noise(k: usize) -> f64 {
        (12.9898 * (k as f64 + 1.0))
            .sin()
            .abs()
            .mul_add(43_758.545_3, 0.0)
            .rem_euclid(1.0)
            - 0.5
    }

    fn predicted() -> Vec<f64> {
        (0..10_000).map(friction).collect()
    }

    fn noisy(torque: &[f64]) -> Vec<f64> {
        let values = torque.iter().enumerate();
        values.map(|(k, value)| value + 0.1 * noise(k)).collect()
    }

    fn through(channel: &Channel) -> Option<Smoothed> {
        let clean = predicted();
        find(&[channel.apply(&noisy(&clean))], &[clean], RATE)
    }

    #[test]
    fn a_low_pass_is_found_with_its_cutoff_and_its_kind() {
        let lag = FirstOrder::new(std::f64::consts::TAU * 6.0, RATE).expect("a filter");
        let found = through(&Channel::Lag(lag)).expect("a low-pass");
        assert!(found.lags, "{found:?}");
        assert!((found.cutoff_hz / 6.0).ln().abs() < 0.2, "{found:?}");
        let zero_phase = LowPass::butterworth(4, 6.0, RATE).expect("a filter");
        let found = through(&Channel::ZeroPhase(zero_phase)).expect("a low-pass");
        assert!(!found.lags, "{found:?}");
        assert!((found.cutoff_hz / 6.0).ln().abs() < 0.2, "{found:?}");
    }

    #[test]
    fn a_delay_and_a_law_that_is_round_itself_are_no_low_pass() {
        assert_eq!(through(&Channel::Late(0)), None);
        assert_eq!(through(&Channel::Late(9)), None);
        // Friction that is round by itself, beside noise of the sensor.
        let clean = predicted();
        let filter = LowPass::butterworth(4, 6.0, RATE).expect("a filter");
        let round = Channel::ZeroPhase(filter).apply(&clean);
        assert_eq!(find(&[noisy(&round)], &[clean], RATE), None);
    }
}
