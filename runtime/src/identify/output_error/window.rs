//! A part of a log that is simulated from a start of its own.

use std::ops::Range;

use nalgebra::{DMatrix, DVector};

use super::OutputErrorError;
use super::equations::Start;
use super::law::{JointLaw, Law};
use super::recording::Recording;
use super::run::Run;
use crate::signal::resample::whole_steps;
use crate::simulate::{Instant, Plant};

/// Samples from which an initial velocity is guessed, and fewest that a window has.
const GUESS: usize = 21;

/// At how many samples simulations are looked at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Pace {
    /// At each of them.
    Sample,
    /// As many as a search needs to come near: torque between two stations is the mean of what is logged there, whose impulse is the same.
    Coarse,
}

/// Seconds between two coarse stations at most, and fewest of them in a window.
const STATION: f64 = 0.01;
const FEWEST: usize = 20;

impl Pace {
    /// Samples from one station to the next, in a window of so many that are so many seconds apart.
    fn stride(self, samples: usize, step: f64) -> usize {
        match self {
            Self::Sample => 1,
            Self::Coarse => whole_steps(STATION / step).min(samples / FEWEST).max(1),
        }
    }

    /// From the first sample to the last one.
    fn stations(self, samples: usize, step: f64) -> Vec<usize> {
        let last = samples - 1;
        let inner = (0..last).step_by(self.stride(samples, step));
        inner.chain([last]).collect()
    }
}

/// Some samples of a recording, with a start that is fitted.
#[derive(Debug, Clone)]
pub(super) struct Window<'a> {
    pub(super) recording: &'a Recording,
    pub(super) samples: Range<usize>,
    /// Samples where the simulation is looked at, from the start of the window: all of them, or some to search with.
    pub(super) stations: Vec<usize>,
    /// Places among the stations of those that count.
    counted: Vec<usize>,
    /// Values of the controller's taps, `[joint][tap]`; none of a channel that may be missing.
    pub(super) taps: Vec<Vec<Option<&'a [f64]>>>,
    /// A joint that is driven otherwise behind some samples, by what torque.
    driven: Option<(usize, Vec<(usize, f64)>)>,
}

/// Weighted equations of a window: errors, and their slopes by its start and by the parameters.
#[derive(Debug, Clone)]
pub(super) struct Rows {
    pub errors: DVector<f64>,
    pub by_start: DMatrix<f64>,
    pub by_parameters: DMatrix<f64>,
}

impl Rows {
    /// Slopes by parameters with the start following them.
    pub fn own(&self, start: &Start) -> DMatrix<f64> {
        match start.follow() {
            Some(follow) => &self.by_parameters + &self.by_start * follow,
            None => self.by_parameters.clone(),
        }
    }
}

/// Largest less least value.
pub(super) fn range(values: &[f64]) -> f64 {
    let (low, high) = values
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &x| {
            (low.min(x), high.max(x))
        });
    high - low
}

/// Value and slope of a parabola through the first samples, at the first.
fn first_of(values: &[f64], step: f64) -> (f64, f64) {
    let count = values.len().min(GUESS);
    let design = DMatrix::from_fn(count, 3, |k, power| {
        (k as f64 * step).powi(i32::try_from(power).unwrap_or(0))
    });
    let values = DVector::from_column_slice(&values[..count]);
    let found = design.svd(true, true).solve(&values, 1e-14);
    found.map_or((values[0], 0.0), |found| (found[0], found[1]))
}

impl<'a> Window<'a> {
    /// Windows of so many seconds, or one.
    pub fn cut(
        recording: &'a Recording,
        seconds: Option<f64>,
        law: Option<&Law>,
        pace: Pace,
    ) -> Result<Vec<Self>, OutputErrorError> {
        let log = &recording.log;
        let taps = |joint: &JointLaw| -> Result<Vec<_>, OutputErrorError> {
            let taps = joint.channels.iter().map(|tap| {
                let channel = log.extra.iter().find(|extra| extra.name == tap.channel);
                match channel {
                    None if !tap.is_optional => Err(OutputErrorError::NoChannel {
                        log: log.source.clone(),
                        channel: tap.channel.clone(),
                    }),
                    channel => Ok(channel.map(|channel| channel.values.as_slice())),
                }
            });
            taps.collect()
        };
        let taps = law.map(|law| law.joints.iter().map(taps).collect::<Result<Vec<_>, _>>());
        let taps = taps.transpose()?.unwrap_or_default();
        let (count, step) = (log.time.len(), log.time[1] - log.time[0]);
        let length = match seconds {
            None => count,
            Some(seconds) => {
                let length = whole_steps((seconds / step).clamp(0.0, count as f64));
                if length < GUESS {
                    return Err(OutputErrorError::Short { seconds });
                }
                length
            }
        };
        let parts = (count / length).max(1);
        let windows = (0..parts).map(|part| {
            // What is left over is the last one's.
            let end = if part + 1 == parts {
                count
            } else {
                (part + 1) * length
            };
            let samples = part * length..end;
            let is_hole = |k: usize| {
                let time = log.time[k] - log.time[0];
                log.holes.iter().any(|hole| hole.contains(&time))
            };
            let stations = pace.stations(samples.len(), step);
            let places = stations.iter().enumerate();
            let counted = places.filter(|(_, k)| !is_hole(samples.start + **k));
            Self {
                counted: counted.map(|(place, _)| place).collect(),
                recording,
                samples,
                stations,
                taps: taps.clone(),
                driven: None,
            }
        });
        Ok(windows.collect())
    }

    pub fn source(&self) -> &str {
        &self.recording.log.source
    }

    /// The same with the torque of a joint behind some of its samples that of the sample so many later.
    pub fn driven_at(&self, joint: usize, samples: &[usize], later: usize) -> Self {
        let torque = &self.recording.torque[joint];
        let driven = samples.iter().map(|&k| {
            let sample = (self.samples.start + k + later).min(torque.len() - 1);
            (k, torque[sample])
        });
        Self {
            driven: Some((joint, driven.collect())),
            ..self.clone()
        }
    }

    /// What else than the recording drives a joint behind a sample.
    pub(super) fn driven(&self, joint: usize, sample: usize) -> Option<f64> {
        let (other, torques) = self.driven.as_ref()?;
        let found = torques.binary_search_by_key(&sample, |(k, _)| *k);
        (*other == joint).then_some(())?;
        found.ok().map(|place| torques[place].1)
    }

    /// Whether both begin at the same sample.
    pub fn begins_as(&self, other: &Window<'_>) -> bool {
        std::ptr::eq(self.recording, other.recording) && self.samples.start == other.samples.start
    }

    pub fn counted(&self) -> usize {
        self.counted.len()
    }

    /// Guessed positions and velocities of all degrees of freedom at the start: joints as the log has them, what hangs on them quiet.
    pub fn start<P: Plant + Clone>(&self, plant: &P) -> DVector<f64> {
        let log = &self.recording.log;
        let first = self.samples.start;
        let step = log.time[1] - log.time[0];
        let guesses = log
            .q
            .iter()
            .map(|q| first_of(&q[self.samples.clone()], step));
        let (q, dq): (Vec<f64>, Vec<f64>) = guesses.unzip();
        let torque: Vec<f64> = self.recording.torque.iter().map(|tau| tau[first]).collect();
        let q = plant.clone().start(&Instant {
            time: log.time[first],
            q: &q,
            dq: &dq,
            ddq: &vec![0.0; dq.len()],
            memory: &vec![0.0; plant.states()],
            switches: &vec![0.0; plant.switches()],
            torque: &torque,
            inputs: &self.inputs_at(first),
        });
        let dq: Vec<f64> = (0..q.len()).map(|k| dq[plant.joint(k)]).collect();
        DVector::from_vec([q, dq].concat())
    }

    pub(super) fn inputs_at(&self, sample: usize) -> Vec<f64> {
        let extra = &self.recording.log.extra;
        let inputs = self.recording.inputs.iter();
        inputs.map(|&k| extra[k].values[sample]).collect()
    }

    /// Measured and simulated positions of a joint.
    pub fn positions(&self, run: &Run, joint: usize) -> Vec<(f64, f64)> {
        self.pairs(&self.recording.log.q[joint], &run.q[joint])
    }

    /// Measured and simulated torques of a joint.
    pub fn torques(&self, run: &Run, joint: usize) -> Vec<(f64, f64)> {
        self.pairs(&self.recording.torque[joint], &run.torque[joint])
    }

    pub fn is_coarse(&self) -> bool {
        self.stations.len() < self.samples.len()
    }

    /// The sample of the log at a station.
    pub(super) fn sample(&self, station: usize) -> usize {
        self.samples.start + self.stations[station]
    }

    fn pairs(&self, measured: &[f64], simulated: &[f64]) -> Vec<(f64, f64)> {
        let counted = self.counted.iter();
        counted
            .map(|&k| (measured[self.sample(k)], simulated[k]))
            .collect()
    }

    /// Sum of the squared errors of each joint.
    pub fn squares(&self, run: &Run, scale: &[f64]) -> Vec<f64> {
        let square = |joint: usize| {
            let pairs = self.positions(run, joint).into_iter();
            pairs
                .map(|(y, s)| ((y - s) / scale[joint]).powi(2))
                .sum::<f64>()
        };
        (0..scale.len()).map(square).collect()
    }

    /// Weighted errors of a run, joint after joint.
    pub fn errors(&self, run: &Run, scale: &[f64]) -> DVector<f64> {
        let joints = scale.iter().enumerate();
        let errors = joints.flat_map(|(joint, scale)| {
            let pairs = self.positions(run, joint).into_iter();
            pairs.map(move |(y, s)| (s - y) / scale)
        });
        DVector::from_vec(errors.collect())
    }

    /// Equations of a run with slopes.
    pub fn rows(&self, run: &Run, scale: &[f64]) -> Rows {
        let (n, count, all) = (scale.len(), self.counted.len(), self.stations.len());
        let none = DMatrix::zeros(n * all, 0);
        let slopes = run.slopes.as_ref().unwrap_or(&none);
        let starts = run.starts;
        let unknowns = slopes.ncols().saturating_sub(starts);
        let mut rows = Rows {
            errors: self.errors(run, scale),
            by_start: DMatrix::zeros(n * count, starts),
            by_parameters: DMatrix::zeros(n * count, unknowns),
        };
        for joint in 0..n {
            for (place, &k) in self.counted.iter().enumerate() {
                let row = joint * count + place;
                let slope = slopes.row(joint * all + k) / scale[joint];
                rows.by_parameters.set_row(row, &slope.columns(0, unknowns));
                rows.by_start.set_row(row, &slope.columns(unknowns, starts));
            }
        }
        rows
    }
}
