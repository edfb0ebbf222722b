//! The simulation of a window.

use nalgebra::{DMatrix, DVector};

use super::law::{JointLaw, Law};
use super::recording::Hold;
use super::window::{Window, range};
use crate::simulate::{Adjustable, Drive, Integrator, SimulateError, Tangent, Tolerances};

/// How exact simulated motions are: far better than encoders.
const TOLERANCES: Tolerances = Tolerances {
    relative: 1e-8,
    absolute: 1e-9,
    floor: 1e-6,
};

/// A simulation that is so many ranges of its log away from it, and so many rad or m, has run away: what follows says nothing, and takes long.
const FAR: f64 = 10.0;

/// So has one whose position would move by so many rad or m where its start moves by one, or a parameter by all of it: the tolerances of
/// simulations alone move it by as much as a motion is long.
const SENSITIVE: f64 = 1e8;

/// What a simulation is to give.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Asked {
    /// Positions and torques.
    Motion,
    /// Slopes to search with, too.
    Slopes,
    /// Slopes to judge by.
    ExactSlopes,
}

/// A simulated window.
#[derive(Debug, Clone)]
pub(super) struct Run {
    /// `[joint][sample]`, with the torques that a controller made.
    pub q: Vec<Vec<f64>>,
    pub torque: Vec<Vec<f64>>,
    /// `d q / d (parameters, start)`, joint after joint, sample after sample.
    pub slopes: Option<DMatrix<f64>>,
    /// Columns of the start.
    pub starts: usize,
}

impl Window<'_> {
    /// A plant at the start, and how its state moves with parameters and start.
    fn stand<P: Adjustable + Clone + Sync>(
        &self,
        plant: &P,
        start: &DVector<f64>,
        asked: Asked,
    ) -> Result<(Integrator<P>, Option<Tangent>), SimulateError> {
        let (dof, states) = (plant.dof(), plant.states());
        let (q, dq) = start.as_slice().split_at(dof);
        let tangent = (asked != Asked::Motion).then(|| {
            let unknowns = plant.parameters();
            let mut state = DMatrix::zeros(2 * dof + states, unknowns + 2 * dof);
            for k in 0..2 * dof {
                state[(k, unknowns + k)] = 1.0;
            }
            let tangent = Tangent::new(plant, state);
            if asked == Asked::Slopes {
                tangent.coarse()
            } else {
                tangent
            }
        });
        let arm = Integrator::new(plant.clone(), q, dq, TOLERANCES)?;
        let time = self.recording.log.time[self.samples.start];
        Ok((arm.begun_at(time), tangent))
    }

    /// Simulates it.
    pub fn run<P: Adjustable + Clone + Sync>(
        &self,
        plant: &P,
        start: &DVector<f64>,
        law: Option<&Law>,
        hold: Hold,
        asked: Asked,
    ) -> Result<Run, SimulateError> {
        let time = |station: usize| self.recording.log.time[self.sample(station)];
        let (mut arm, mut tangent) = self.stand(plant, start, asked)?;
        let (joints, count) = (plant.joints(), self.stations.len());
        let columns = tangent.as_ref().map_or(0, |tangent| tangent.state.ncols());
        let mut run = Run {
            q: vec![Vec::with_capacity(count); joints],
            torque: vec![Vec::with_capacity(count); joints],
            slopes: tangent
                .is_some()
                .then(|| DMatrix::zeros(joints * count, columns)),
            starts: start.len(),
        };
        // How the controller's torques move with parameters and start.
        let mut drives: Vec<DMatrix<f64>> = vec![DMatrix::zeros(count, columns); joints];
        let near = Near::of(self, plant, start.len());
        for k in 0..count {
            near.check(&arm, tangent.as_ref(), k)?;
            for joint in 0..joints {
                run.q[joint].push(arm.q()[joint]);
                if let (Some(slopes), Some(tangent)) = (&mut run.slopes, &tangent) {
                    slopes.set_row(joint * count + k, &tangent.state.row(joint));
                }
            }
            for joint in 0..joints {
                let torque = match law {
                    None => self.logged(joint, k, hold),
                    Some(law) => self.commanded(&law.joints[joint], joint, &run, &mut drives, k),
                };
                run.torque[joint].push(torque);
                if let (Some(tangent), Some(_)) = (&mut tangent, law) {
                    tangent.drive.set_row(joint, &drives[joint].row(k));
                }
            }
            if k + 1 == count {
                break;
            }
            let (now, next) = (time(k), time(k + 1));
            let [inputs, after] = [k, k + 1].map(|k| self.inputs_at(self.sample(k)));
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

    /// The torque that the log has behind a station, to the next one in the mean.
    fn logged(&self, joint: usize, k: usize, hold: Hold) -> f64 {
        let torque = &self.recording.torque[joint];
        let first = self.sample(k);
        let behind = self
            .stations
            .get(k + 1)
            .map_or(1, |next| next - self.stations[k]);
        let last = (first + behind).min(torque.len() - 1);
        // Half of what the sum of the means has more at its end than at its start.
        let shift = match hold {
            Hold::Sample => 0.0,
            Hold::Mean => 0.5 * (torque[last] - torque[first]),
        };
        self.driven(joint, k).unwrap_or_else(|| {
            let held: f64 = torque[first..first + behind].iter().sum();
            (held + shift) / behind as f64
        })
    }

    /// The torque that the controller makes behind a sample; how it moves goes into row `k` of the joint's `drives`.
    fn commanded(
        &self,
        law: &JointLaw,
        joint: usize,
        run: &Run,
        drives: &mut [DMatrix<f64>],
        k: usize,
    ) -> f64 {
        let taps = &self.taps[joint];
        let channel = |tap: usize, k: usize| taps[tap].map_or(0.0, |values| values[self.sample(k)]);
        let (torque, is_cut) = law.torque(k, &run.q[joint], &run.torque[joint], channel);
        if let (Some(slopes), false) = (&run.slopes, is_cut) {
            let drives = &mut drives[joint];
            let mut drive = DMatrix::zeros(1, slopes.ncols());
            for (i, weight) in law.position.iter().enumerate() {
                let row = joint * self.stations.len() + k.saturating_sub(i);
                drive += slopes.row(row) * *weight;
            }
            for (i, weight) in law.torque.iter().enumerate().take(k) {
                drive += drives.row(k - 1 - i) * *weight;
            }
            drives.set_row(k, &drive.row(0));
        }
        torque
    }
}

/// How near a simulation has to stay to its log to say anything of it.
struct Near<'a> {
    window: &'a Window<'a>,
    /// How far each may be from them.
    far: Vec<f64>,
    /// By what each parameter and start is measured: all of it.
    whole: Vec<f64>,
}

impl<'a> Near<'a> {
    fn of(window: &'a Window<'_>, plant: &impl Adjustable, starts: usize) -> Self {
        let q = &window.recording.log.q;
        let values = plant.values().into_iter().map(|x| x.abs().max(1e-6));
        Self {
            window,
            far: q.iter().map(|q| FAR * (1.0 + range(q))).collect(),
            whole: values.chain(vec![1.0; starts]).collect(),
        }
    }

    fn check<P: Adjustable + Clone + Sync>(
        &self,
        arm: &Integrator<P>,
        tangent: Option<&Tangent>,
        k: usize,
    ) -> Result<(), SimulateError> {
        let time = arm.time();
        let sample = self.window.sample(k);
        for (joint, measured) in self.window.recording.log.q.iter().enumerate() {
            let away = (arm.q()[joint] - measured[sample]).abs();
            if away.is_nan() || away > self.far[joint] {
                let joint = joint + 1;
                return Err(SimulateError::Unbounded { time, joint });
            }
            let Some(tangent) = tangent else { continue };
            let moves = tangent.state.row(joint);
            let mut moves = moves.iter().zip(&self.whole);
            if !moves.all(|(slope, whole)| (slope * whole).abs() < SENSITIVE) {
                let joint = joint + 1;
                return Err(SimulateError::Sensitive { time, joint });
            }
        }
        Ok(())
    }
}
