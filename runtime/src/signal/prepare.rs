//! A log to the motion that models read.

use std::fmt;
use std::ops::Range;

use super::{LowPass, SharedFilter, SignalError, derivative, resample, turn_speed};
use crate::log::{Channel, Log};
use crate::motion::{Kinematics, Motion};

/// Order per direction of all motion filters.
pub(crate) const MOTION_ORDER: usize = 4;

/// Displacements of links are made of torques, which are noisier than positions, and differentiated twice: they pass a band
/// that is this much wider than the one that counts.
const DISPLACEMENT_BAND: f64 = 1.5;

/// Logs come down to about this rate: the widest default band fits five times into it.
const RATE_HZ: f64 = 500.0;

/// Cutoff of the filter before decimation, as a share of the new rate (of which 0.5 is the limit).
const ANTI_ALIAS: f64 = 0.4;

/// Cutoff frequencies, Hz, of the zero-phase filters: `shared <= smooth <= wide`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bands {
    /// Of positions for rigid-body terms, which are products of derivatives and want little noise.
    pub smooth_hz: f64,
    /// Of positions for effects, whose signs change within milliseconds and want the reversal where it was.
    pub wide_hz: f64,
    /// Of the filter that torque and all columns share; least squares sees this band only.
    pub shared_hz: f64,
}

/// Shared, smooth and wide, as in `10,30,90 Hz`.
impl fmt::Display for Bands {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{},{},{} Hz",
            self.shared_hz, self.smooth_hz, self.wide_hz
        )
    }
}

impl Bands {
    /// The bands for logs at 250 Hz and more: 10 Hz shared, 30 Hz smooth, 90 Hz wide.
    pub const DEFAULT: Self = Self {
        smooth_hz: 30.0,
        wide_hz: 90.0,
        shared_hz: 10.0,
    };

    /// That each band is at least the one before it: shared, smooth, wide.
    ///
    /// # Errors
    /// [`SignalError::Bands`]
    ///
    /// # Examples
    /// ```
    /// use robot_model::signal::Bands;
    /// assert!(Bands::DEFAULT.check().is_ok());
    /// assert!(Bands { wide_hz: 20.0, ..Bands::DEFAULT }.check().is_err());
    /// ```
    pub fn check(&self) -> Result<(), SignalError> {
        let Self {
            smooth_hz,
            wide_hz,
            shared_hz,
        } = *self;
        if shared_hz <= smooth_hz && smooth_hz <= wide_hz {
            return Ok(());
        }
        Err(SignalError::Bands {
            shared_hz,
            smooth_hz,
            wide_hz,
        })
    }

    /// [`Bands::DEFAULT`], narrowed where samples come too slowly for it: the wide band to 0.36 of the rate, the shared one to
    /// a tenth, and the smooth one to three times the shared one.
    ///
    /// # Examples
    /// ```
    /// use robot_model::signal::Bands;
    /// assert_eq!(Bands::for_rate(1000.0), Bands::DEFAULT);
    /// assert_eq!(Bands::for_rate(50.0), Bands { smooth_hz: 15.0, wide_hz: 18.0, shared_hz: 5.0 });
    /// ```
    #[must_use]
    pub fn for_rate(rate_hz: f64) -> Self {
        let shared_hz = Self::DEFAULT.shared_hz.min(0.1 * rate_hz);
        let smooth_hz = 3.0 * shared_hz;
        Self {
            smooth_hz,
            wide_hz: Self::DEFAULT.wide_hz.min(0.36 * rate_hz).max(smooth_hz),
            shared_hz,
        }
    }

    /// The same where samples come fast enough for them, at the rate that [`prepare`] brings them down to: two in a period of the widest are
    /// too few. Or else no wider ones than [`Bands::for_rate`].
    ///
    /// # Examples
    /// ```
    /// use robot_model::signal::Bands;
    /// assert_eq!(Bands::DEFAULT.at_rate(250.0), Bands::DEFAULT);
    /// assert_eq!(Bands::DEFAULT.at_rate(50.0), Bands::for_rate(50.0));
    /// let wide = Bands { wide_hz: 300.0, ..Bands::DEFAULT };
    /// assert_eq!((wide.at_rate(700.0), wide.at_rate(1000.0)), (wide, Bands::DEFAULT)); // 1000 Hz are brought down to 500
    /// ```
    #[must_use]
    pub fn at_rate(self, rate_hz: f64) -> Self {
        let widest = self.shared_hz.max(self.smooth_hz).max(self.wide_hz);
        if widest < 0.5 * rate_hz / stride(rate_hz) as f64 {
            return self;
        }
        let most = Self::for_rate(rate_hz);
        Self {
            smooth_hz: self.smooth_hz.min(most.smooth_hz),
            wide_hz: self.wide_hz.min(most.wide_hz),
            shared_hz: self.shared_hz.min(most.shared_hz),
        }
    }

    /// [`Bands::for_rate`] at the rate of a log. Where several logs are fitted together, take the bands of the slowest.
    ///
    /// # Examples
    /// ```
    /// use robot_model::{log::Log, signal::Bands};
    /// let time: Vec<f64> = (0..100).map(|k| 0.02 * f64::from(k)).collect();
    /// let log = Log::from_samples("a plant", time, vec![vec![0.0; 100]], vec![vec![0.0; 100]])?;
    /// assert!((Bands::for_log(&log).shared_hz - 5.0).abs() < 1e-9); // a tenth of 50 Hz
    /// # Ok::<(), robot_model::log::LogError>(())
    /// ```
    #[must_use]
    pub fn for_log(log: &Log) -> Self {
        Self::for_rate(log.rate_hz())
    }
}

/// A log that is ready for a model.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Prepared {
    /// Positions and derivatives in both bands, on a uniform grid.
    pub motion: Motion,
    /// What the model is fitted to, `[joint][sample]`: the torque as logged on the grid of `motion`, not smoothed except
    /// before decimation.
    pub tau: Vec<Vec<f64>>,
    /// Mean square of what decimation took off the logged torque, per joint: no model sees it, and raw errors have it.
    pub tau_beyond: Vec<f64>,
    /// Sample rate of `motion`, Hz.
    pub rate_hz: f64,
    /// Samples of the motion where a joint's torque stands at a limit, `[joint]`; no joints where none were looked for.
    pub clipped: Vec<Vec<Range<usize>>>,
    /// Sample `k` of the motion is sample `k * stride` of the log.
    pub stride: usize,
    /// The filter for torque and every column.
    pub shared: SharedFilter,
}

impl Prepared {
    /// Rate of the rows of a fit, Hz.
    pub(crate) fn filtered_hz(&self) -> f64 {
        self.rate_hz / self.shared.stride() as f64
    }

    /// Whether a sample of the motion, or one between two, is made up or next to what is.
    pub(crate) fn is_in_hole(&self, sample: f64) -> bool {
        self.shared.is_in_hole(sample)
    }

    /// Whether a joint's torque stands at a limit at a sample of the motion, or within so many samples of it.
    pub(crate) fn is_clipped(&self, joint: usize, reach: usize) -> Vec<bool> {
        let count = self.motion.time.len();
        let mut is_clipped = vec![false; count];
        for range in self.clipped.get(joint).into_iter().flatten() {
            let start = range.start.saturating_sub(reach).min(count);
            is_clipped[start..(range.end + reach).min(count)].fill(true);
        }
        is_clipped
    }
}

/// Filters and differentiates a log.
///
/// Positions pass a zero-phase Butterworth low-pass of order 4 at [`Bands::smooth_hz`] and another at [`Bands::wide_hz`];
/// velocity and acceleration are central differences of each. Logs at more than 500 Hz come down to 500 Hz or a little
/// more: one zero-phase low-pass at 0.4 of the new rate goes over torque and positions alike, derivatives are taken at the
/// full rate, and every `stride`-th sample is kept. Further channels go the way of the torque.
///
/// # Errors
/// [`SignalError::Bands`], [`SignalError::Cutoff`] and [`SignalError::Reduced`] for bands that are not ordered or do not fit the log's rate,
/// [`SignalError::TooShort`] where the filters' borders leave nothing of the log.
///
/// # Examples
/// ```
/// use robot_model::{log::Log, signal::{Bands, prepare}};
/// let time: Vec<f64> = (0..4000).map(|k| 0.001 * f64::from(k)).collect();
/// let q = vec![time.iter().map(|t| (3.0 * t).sin()).collect()];
/// let tau = vec![time.iter().map(|t| -18.0 * (3.0 * t).sin()).collect()];
/// let log = Log::from_samples("a plant", time, q, tau)?;
/// let prepared = prepare(&log, &Bands::for_log(&log))?;
/// assert_eq!(prepared.stride, 2);
/// let ratio = prepared.tau[0][500] / prepared.motion.smooth.ddq[0][500];
/// assert!((ratio - 2.0).abs() < 1e-6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn prepare(log: &Log, bands: &Bands) -> Result<Prepared, SignalError> {
    prepare_rates(log, bands, true)
}

/// As [`prepare`], but no acceleration is computed: `ddq` has no channels. For the filtered form.
///
/// # Errors
/// Those of [`prepare`].
///
/// # Examples
/// ```
/// use robot_model::{log::Log, signal::{Bands, prepare_velocities}};
/// let time: Vec<f64> = (0..4000).map(|k| 0.001 * f64::from(k)).collect();
/// let q = vec![time.iter().map(|t| (3.0 * t).sin()).collect()];
/// let log = Log::from_samples("a plant", time, q, vec![vec![0.0; 4000]])?;
/// let smooth = prepare_velocities(&log, &Bands::for_log(&log))?.motion.smooth;
/// assert!((smooth.dq[0][500] - 3.0 * 3.0_f64.cos()).abs() < 1e-3 && smooth.ddq.is_empty()); // at 1 s
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn prepare_velocities(log: &Log, bands: &Bands) -> Result<Prepared, SignalError> {
    prepare_rates(log, bands, false)
}

/// Samples of a log for one of its motion.
fn stride(logged_hz: f64) -> usize {
    // The small slack keeps 999.99 Hz from becoming a stride of one.
    resample::whole_steps(logged_hz / RATE_HZ + 1e-3).max(1)
}

fn prepare_rates(log: &Log, bands: &Bands, accelerations: bool) -> Result<Prepared, SignalError> {
    let Bands {
        smooth_hz,
        wide_hz,
        shared_hz,
    } = *bands;
    bands.check()?;
    let logged_hz = log.rate_hz();
    let stride = stride(logged_hz);
    let rate_hz = logged_hz / stride as f64;
    let anti_alias = if stride > 1 {
        Some(LowPass::butterworth(
            MOTION_ORDER,
            ANTI_ALIAS * rate_hz,
            logged_hz,
        )?)
    } else {
        None
    };
    // Judged at the reduced rate, where columns are formed.
    if wide_hz >= 0.5 * rate_hz && stride > 1 {
        return Err(SignalError::Reduced {
            wide_hz,
            logged_hz,
            rate_hz,
        });
    }
    let smooth = LowPass::butterworth(MOTION_ORDER, smooth_hz, logged_hz)?;
    let wide = LowPass::butterworth(MOTION_ORDER, wide_hz, logged_hz)?;
    let on_motion = |time: f64| resample::whole_steps((time * rate_hz).max(0.0));
    let samples_of = |span: &Range<f64>| on_motion(span.start)..on_motion(span.end) + 2;
    let holes = log.holes.iter().map(samples_of);
    let clipped = log.clipped.iter();
    let clipped = clipped.map(|spans| spans.iter().map(samples_of).collect());
    let clipped = clipped.collect();
    let shared = SharedFilter::new(bands, rate_hz)?.around(holes);

    let samples = log.time.len().div_ceil(stride);
    let needed = 2 * shared.border() + shared.stride();
    if samples < needed {
        let (seconds, needed) = (log.seconds(), needed as f64 / rate_hz);
        return Err(SignalError::TooShort {
            source_name: log.source.clone(),
            seconds,
            needed,
            shared_hz,
        });
    }

    let limit = |channel: &Vec<f64>| match &anti_alias {
        None => channel.clone(),
        Some(filter) => filtered(filter, channel),
    };
    let on_grid = |channel: &Vec<f64>| resample::every(&limit(channel), stride);
    let q: Vec<Vec<f64>> = log.q.iter().map(limit).collect();
    let tau: Vec<Vec<f64>> = log.tau.iter().map(on_grid).collect();
    let beyond = |channel: &Vec<f64>| mean_square(channel, &limit(channel));
    let step = 1.0 / logged_hz;
    let rates = |filter: &LowPass| kinematics(&q, filter, step, stride, accelerations);
    let wide = rates(&wide);
    let turns = log.q.iter().zip(&wide.dq);
    let turn_speeds = if log.turn_speeds.is_empty() {
        turns.map(|(q, dq)| turn_speed(q, dq, wide_hz)).collect()
    } else {
        log.turn_speeds.clone()
    };
    Ok(Prepared {
        motion: Motion {
            time: resample::grid(0.0, 1.0 / rate_hz, samples),
            smooth: rates(&smooth),
            wide,
            rigid_torque: Vec::new(),
            transmitted_torque: Vec::new(),
            displacement_hz: (DISPLACEMENT_BAND * shared_hz).min(smooth_hz),
            turn_speeds,
            tau: tau.clone(),
            extra: log
                .extra
                .iter()
                .map(|channel| Channel {
                    name: channel.name.clone(),
                    values: on_grid(&channel.values),
                })
                .collect(),
        },
        tau,
        tau_beyond: log.tau.iter().map(beyond).collect(),
        rate_hz,
        clipped,
        stride,
        shared,
    })
}

/// Mean square of a difference.
fn mean_square(left: &[f64], right: &[f64]) -> f64 {
    let squares = left.iter().zip(right).map(|(l, r)| (l - r).powi(2));
    squares.sum::<f64>() / left.len().max(1) as f64
}

/// Filtered positions and their derivatives at the full rate, of which every `stride`-th sample is kept.
fn kinematics(
    positions: &[Vec<f64>],
    filter: &LowPass,
    step: f64,
    stride: usize,
    accelerations: bool,
) -> Kinematics {
    let mut kinematics = Kinematics::default();
    let (mut dq, mut ddq) = (Vec::new(), Vec::new());
    for position in positions {
        let q = filtered(filter, position);
        derivative(&q, step, &mut dq);
        rest(&mut dq);
        kinematics.q.push(resample::every(&q, stride));
        kinematics.dq.push(resample::every(&dq, stride));
        if accelerations {
            derivative(&dq, step, &mut ddq);
            kinematics.ddq.push(resample::every(&ddq, stride));
        }
    }
    kinematics
}

/// A joint that stands still has no velocity: what rounding in the filter leaves would have a sign.
fn rest(velocity: &mut [f64]) {
    const ROUNDING: f64 = 1e-10;
    velocity
        .iter_mut()
        .filter(|v| v.abs() < ROUNDING)
        .for_each(|v| *v = 0.0);
}

fn filtered(filter: &LowPass, signal: &[f64]) -> Vec<f64> {
    let mut out = Vec::new();
    filter.apply(signal, &mut out);
    out
}

#[cfg(test)]
mod tests;
