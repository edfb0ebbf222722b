//! A part of a log that is simulated from a start of its own.

use std::ops::Range;

use nalgebra::{DMatrix, DVector};

use super::OutputErrorError;
use super::equations::Start;
use super::law::{JointLaw, Law};
use super::recording::{Hold, Recording};
use crate::signal::resample::whole_steps;
use crate::simulate::{
    Adjustable, Drive, Instant, Integrator, Plant, SimulateError, Tangent, Tolerances,
};

/// How exact simulated motions are: far better than encoders.
const TOLERANCES: Tolerances = Tolerances {
    relative: 1e-8,
    absolute: 1e-9,
    floor: 1e-6,
};

/// Samples from which an initial velocity is guessed, and fewest that a window has.
const GUESS: usize = 21;

/// A simulation that is so many ranges of its log away from it, and so many rad or m, has run away: what follows says nothing, and takes long.
const FAR: f64 = 10.0;

/// So has one whose position would move by so many rad or m where its start moves by one, or a parameter by all of it: the tolerances of
/// simulations alone move it by as much as a motion is long.
const SENSITIVE: f64 = 1e8;

/// Some samples of a recording, with a start that is fitted.
#[derive(Debug, Clone)]
pub(super) struct Window<'a> {
    recording: &'a Recording,
    samples: Range<usize>,
    /// Samples that count, from the start of the window.
    counted: Vec<usize>,
    /// Values of the controller's taps, `[joint][tap]`; none of a channel that may be missing.
    taps: Vec<Vec<Option<&'a [f64]>>>,
    /// A joint that is driven otherwise behind some samples, by what torque.
    driven: Option<(usize, Vec<(usize, f64)>)>,
}

/// A simulated window.
#[derive(Debug, Clone)]
pub(super) struct Run {
    /// `[joint][sample]`, with the torques that a controller made.
    pub q: Vec<Vec<f64>>,
    torque: Vec<Vec<f64>>,
    /// `d q / d (parameters, start)`, joint after joint, sample after sample.
    slopes: Option<DMatrix<f64>>,
    /// Columns of the start.
    starts: usize,
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
            Self {
                counted: samples
                    .clone()
                    .filter(|&k| !is_hole(k))
                    .map(|k| k - samples.start)
                    .collect(),
                recording,
                samples,
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
    fn driven(&self, joint: usize, sample: usize) -> Option<f64> {
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

    fn inputs_at(&self, sample: usize) -> Vec<f64> {
        let extra = &self.recording.log.extra;
        let inputs = self.recording.inputs.iter();
        inputs.map(|&k| extra[k].values[sample]).collect()
    }

    /// A plant at the start, and how its state moves with parameters and start.
    fn stand<P: Adjustable + Clone>(
        &self,
        plant: &P,
        start: &DVector<f64>,
        with_slopes: bool,
    ) -> Result<(Integrator<P>, Option<Tangent>), SimulateError> {
        let (dof, states) = (plant.dof(), plant.states());
        let (q, dq) = start.as_slice().split_at(dof);
        let tangent = with_slopes.then(|| {
            let unknowns = plant.parameters();
            let mut state = DMatrix::zeros(2 * dof + states, unknowns + 2 * dof);
            for k in 0..2 * dof {
                state[(k, unknowns + k)] = 1.0;
            }
            Tangent::new(plant, state)
        });
        let arm = Integrator::new(plant.clone(), q, dq, TOLERANCES)?;
        let time = self.recording.log.time[self.samples.start];
        Ok((arm.begun_at(time), tangent))
    }

    /// Simulates it.
    pub fn run<P: Adjustable + Clone>(
        &self,
        plant: &P,
        start: &DVector<f64>,
        law: Option<&Law>,
        hold: Hold,
        with_slopes: bool,
    ) -> Result<Run, SimulateError> {
        let log = &self.recording.log;
        let (mut arm, mut tangent) = self.stand(plant, start, with_slopes)?;
        let (n, count) = (plant.joints(), self.samples.len());
        let columns = tangent.as_ref().map_or(0, |tangent| tangent.state.ncols());
        let mut run = Run {
            q: vec![Vec::with_capacity(count); n],
            torque: vec![Vec::with_capacity(count); n],
            slopes: tangent
                .is_some()
                .then(|| DMatrix::zeros(n * count, columns)),
            starts: start.len(),
        };
        let mut drives: Vec<DMatrix<f64>> = vec![DMatrix::zeros(count, columns); n];
        let whole = plant.values().into_iter().map(|x| x.abs().max(1e-6));
        let whole: Vec<f64> = whole.chain(vec![1.0; start.len()]).collect();
        let far: Vec<f64> = log.q.iter().map(|q| FAR * (1.0 + range(q))).collect();
        for k in 0..count {
            for joint in 0..n {
                let measured = log.q[joint][self.samples.start + k];
                let away = (arm.q()[joint] - measured).abs();
                if away.is_nan() || away > far[joint] {
                    return Err(SimulateError::Unbounded {
                        time: arm.time(),
                        joint: joint + 1,
                    });
                }
                run.q[joint].push(arm.q()[joint]);
                if let (Some(slopes), Some(tangent)) = (&mut run.slopes, &tangent) {
                    let moves = tangent.state.row(joint);
                    let mut moves = moves.iter().zip(&whole);
                    if !moves.all(|(slope, whole)| (slope * whole).abs() < SENSITIVE) {
                        return Err(SimulateError::Sensitive {
                            time: arm.time(),
                            joint: joint + 1,
                        });
                    }
                    slopes.set_row(joint * count + k, &tangent.state.row(joint));
                }
            }
            let sample = self.samples.start + k;
            for joint in 0..n {
                let torque = match law {
                    None => {
                        let torque = &self.recording.torque[joint];
                        let logged = match hold {
                            Hold::Sample => torque[sample],
                            Hold::Mean => {
                                0.5 * (torque[sample] + torque[(sample + 1).min(torque.len() - 1)])
                            }
                        };
                        self.driven(joint, k).unwrap_or(logged)
                    }
                    Some(law) => {
                        let (law, taps) = (&law.joints[joint], &self.taps[joint]);
                        let first = self.samples.start;
                        let channel = |tap: usize, k: usize| {
                            taps[tap].map_or(0.0, |values| values[first + k])
                        };
                        let (torque, is_cut) =
                            law.torque(k, &run.q[joint], &run.torque[joint], channel);
                        if let (Some(slopes), false) = (&run.slopes, is_cut) {
                            let mut drive = DMatrix::zeros(1, columns);
                            for (i, weight) in law.position.iter().enumerate() {
                                drive += slopes.row(joint * count + k.saturating_sub(i)) * *weight;
                            }
                            for (i, weight) in law.torque.iter().enumerate().take(k) {
                                drive += drives[joint].row(k - 1 - i) * *weight;
                            }
                            drives[joint].set_row(k, &drive.row(0));
                        }
                        torque
                    }
                };
                run.torque[joint].push(torque);
                if let (Some(tangent), Some(_)) = (&mut tangent, law) {
                    tangent.drive.set_row(joint, &drives[joint].row(k));
                }
            }
            if k + 1 == count {
                break;
            }
            let (now, next) = (log.time[sample], log.time[sample + 1]);
            let (inputs, after) = (self.inputs_at(sample), self.inputs_at(sample + 1));
            let rates = inputs
                .iter()
                .zip(after)
                .map(|(x, y)| (y - x) / (next - now));
            arm.drive(Drive {
                torque: run.torque.iter().map(|torque| torque[k]).collect(),
                input_rates: rates.collect(),
                inputs,
                since: now,
            });
            match &mut tangent {
                Some(tangent) => arm.advance_with(next, tangent)?,
                None => arm.advance(next)?,
            }
        }
        Ok(run)
    }

    /// Measured and simulated positions of a joint.
    pub fn positions(&self, run: &Run, joint: usize) -> Vec<(f64, f64)> {
        self.pairs(&self.recording.log.q[joint], &run.q[joint])
    }

    /// Measured and simulated torques of a joint.
    pub fn torques(&self, run: &Run, joint: usize) -> Vec<(f64, f64)> {
        self.pairs(&self.recording.torque[joint], &run.torque[joint])
    }

    fn pairs(&self, measured: &[f64], simulated: &[f64]) -> Vec<(f64, f64)> {
        let first = self.samples.start;
        let counted = self.counted.iter();
        counted
            .map(|&k| (measured[first + k], simulated[k]))
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
        let (n, count, all) = (scale.len(), self.counted.len(), self.samples.len());
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
