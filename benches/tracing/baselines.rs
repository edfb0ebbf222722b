//! What the baselines make of an experiment: they get the logs and the columns that the tracer has.

use std::time::Instant;

use robot_model::columns::{Arm as _, Candidate, Columns as _, Entry};
use robot_model::identify::{Identify, Method, Stack, torque_of};
use robot_model::log::Log;
use robot_model::signal::{Bands, Prepared, prepare};
use robot_model_benches::baselines::{ALL, Choice, Column, FOLDS, Folds, Rows, by_blocks, by_lot};
use robot_model_cli::close_the_loop::Loop;

use crate::columns::{Fit, Trial, load};
use crate::experiment::said;

/// As for the tracer: an effect is named if the raw error of one of its joints falls by this share, and six effects at most.
const MATERIAL: f64 = 0.05;
const MOST_EFFECTS: usize = 6;

/// Length of a block of a motion that does not repeat, s: ten of them in the log that is fitted.
const BLOCK_S: f64 = 2.0;

/// Of more effects than this the rest is not looked at.
const MOST_TRIED: usize = 20;

/// What a baseline says is missing.
pub struct Answer {
    pub method: &'static str,
    /// Effects and joints from 0, the largest first.
    pub named: Vec<(String, Vec<usize>)>,
    /// How many effects it chose, with those that do not matter.
    pub chosen: usize,
    pub seconds: f64,
}

/// What each baseline says of the logs that were traced.
///
/// # Errors
/// What went wrong, in words.
pub fn answers(closed: &Loop) -> Result<Vec<Answer>, String> {
    let start = Instant::now();
    let arm = &closed.before.arm;
    let undeclared = arm.undeclared();
    let has_channels = |candidate: &&dyn Candidate| {
        let has = |log: &Log, name: &String| log.extra.iter().any(|one| one.name == *name);
        let mut logs = closed.traced.iter();
        logs.all(|log| candidate.inputs().iter().all(|name| has(log, name)))
    };
    let candidates: Vec<&dyn Candidate> = undeclared
        .candidates()
        .into_iter()
        .filter(has_channels)
        .collect();
    let fit = fitted(closed)?;
    let trials = fit.trials(&candidates);
    let rows = fit.stack.samples() * fit.stack.dof();
    let lots = Given::new(&fit, &trials, &by_lot(rows));
    let forming = start.elapsed().as_secs_f64();
    let blocks = Given::new(&fit, &trials, &blocks(&fit, &closed.traced));
    ALL.iter()
        .map(|baseline| {
            let start = Instant::now();
            let given = match baseline.folds {
                Folds::ByLot => &lots,
                Folds::Blocks => &blocks,
            };
            let choices = (baseline.choose)(&given.rows);
            let named = given.material(&choices)?.into_iter();
            let told = |effect: usize| {
                let candidate = candidates[effect];
                (candidate.kind().to_owned(), candidate.joints().to_vec())
            };
            Ok(Answer {
                method: baseline.name,
                named: named.map(told).collect(),
                chosen: choices.len(),
                seconds: forming + start.elapsed().as_secs_f64(),
            })
        })
        .collect()
}

/// The declared model's fit in the tracer's bands. No arm of the study declares an effect of the load.
fn fitted(closed: &Loop) -> Result<Fit<'_>, String> {
    let arm = &closed.before.arm;
    let rates = closed.traced.iter().map(Log::rate_hz);
    let bands = Bands::for_rate(rates.fold(f64::INFINITY, f64::min));
    let identify = Identify {
        method: Method::Wls,
        bands: Some(bands),
        ..Identify::default()
    };
    let logs = closed.traced.iter().map(|log| prepare(log, &bands));
    let mut logs = logs.collect::<Result<Vec<Prepared>, _>>().map_err(said)?;
    let mut stack = Stack::new(arm, &logs, &[]);
    let solution = identify.solve_stack(&stack).map_err(said)?;
    stack.silence(&solution.unexcited);
    load(arm, &mut logs, &[], &solution.estimate);
    Ok(Fit {
        arm,
        identify,
        logs,
        stack,
        solution,
    })
}

/// Folds of blocks of time one after the other, or of intervals of the phase of a motion that repeats; the same for all joints.
fn blocks(fit: &Fit<'_>, logs: &[Log]) -> Vec<usize> {
    let logs = fit.stack.segments.iter().zip(logs);
    let of_log = logs.flat_map(|(segment, log)| {
        let cycle = log.period().unwrap_or(BLOCK_S * FOLDS as f64);
        by_blocks(&segment.time, cycle)
    });
    let one: Vec<usize> = of_log.collect();
    one.repeat(fit.stack.dof())
}

/// All columns as weighted rows, joint after joint.
struct Given<'a> {
    fit: &'a Fit<'a>,
    trials: &'a [Trial<'a>],
    /// Trial and column of the effect, of each column in `rows`.
    places: Vec<(usize, usize)>,
    rows: Rows,
}

impl<'a> Given<'a> {
    fn new(fit: &'a Fit<'a>, trials: &'a [Trial<'a>], fold_of_row: &[usize]) -> Self {
        let samples = fit.stack.samples();
        let all = samples * fit.stack.dof();
        let put = |to: &mut [f64], joint: usize, values: &[f64]| {
            let weight = fit.solution.sigma[joint].recip();
            let own = &mut to[joint * samples..(joint + 1) * samples];
            own.iter_mut()
                .zip(values)
                .for_each(|(to, value)| *to += weight * value);
        };
        let mut model = vec![vec![0.0; all]; fit.stack.unknowns.len()];
        let mut target = vec![0.0; all];
        for (joint, rows) in fit.stack.joints.iter().enumerate() {
            put(&mut target, joint, &rows.target);
            for (column, values) in &rows.columns {
                put(&mut model[*column], joint, values);
            }
        }
        let (mut columns, mut places) = (Vec::new(), Vec::new());
        for (number, trial) in trials.iter().enumerate() {
            for column in 0..trial.candidate.unknowns().len() {
                let mut values = vec![0.0; all];
                for entry in trial.entries.iter().filter(|entry| entry.column == column) {
                    put(&mut values, entry.joint, &entry.values);
                }
                places.push((number, column));
                columns.push(Column {
                    effect: trial.effect,
                    trial: number,
                    values,
                });
            }
        }
        Self {
            fit,
            trials,
            places,
            rows: Rows::new(&model, &columns, &target, fold_of_row),
        }
    }

    /// Those of the chosen effects, in their order, that lower the raw error of one of their joints by what matters.
    fn material(&self, choices: &[Choice]) -> Result<Vec<usize>, String> {
        let mut named = Vec::new();
        let mut columns: Vec<usize> = Vec::new();
        let mut before = self.power(&columns)?;
        for choice in choices.iter().take(MOST_TRIED) {
            let with = [columns.as_slice(), &choice.columns].concat();
            let after = self.power(&with)?;
            let candidate = self.trials[self.places[choice.columns[0]].0].candidate;
            let every: Vec<usize> = (0..before.len()).collect();
            let mut joints = if candidate.change().is_some() {
                every.iter()
            } else {
                candidate.joints().iter()
            };
            if joints.any(|j| after[*j] <= (1.0 - MATERIAL).powi(2) * before[*j]) {
                named.push(choice.effect);
                (columns, before) = (with, after);
            }
            if named.len() == MOST_EFFECTS {
                break;
            }
        }
        Ok(named)
    }

    /// Mean square of the raw error per joint with some columns: of filtered rows where they are held out, and what raw samples have beyond.
    fn power(&self, columns: &[usize]) -> Result<Vec<f64>, String> {
        let fit = self.fit;
        let mut stack = fit.stack.clone();
        for column in columns {
            let (trial, column) = self.places[*column];
            let (unknown, entries) = self.trials[trial].column(column);
            stack.append(std::slice::from_ref(unknown), &entries);
        }
        let estimate = fit.identify.solve_stack(&stack).map_err(said)?.estimate;
        let filtered = stack.residuals(&estimate);
        let raw = self.raw(columns, &estimate);
        let held_out = self.rows.held_out(columns);
        let samples = stack.samples();
        let of_joint = |joint: usize| {
            let above = (mean_square(&raw[joint]) - mean_square(&filtered[joint])).max(0.0);
            let own = &held_out[joint * samples..(joint + 1) * samples];
            above + fit.solution.sigma[joint].powi(2) * mean_square(own)
        };
        Ok((0..stack.dof()).map(of_joint).collect())
    }

    /// Residuals on raw samples, `[joint]`, all logs after each other and both ends of each cut. What changes the arm is left out, as it
    /// has no column there.
    fn raw(&self, columns: &[usize], estimate: &[f64]) -> Vec<Vec<f64>> {
        let arm = self.fit.arm;
        let own = arm.unknowns().len();
        let mut all = vec![Vec::new(); arm.dof()];
        for log in &self.fit.logs {
            let mut torque = torque_of(arm, &log.motion, &[], &estimate[..own], arm.dof());
            for (sum, known) in torque.iter_mut().zip(arm.known_torque(&log.motion, &[])) {
                sum.iter_mut()
                    .zip(known)
                    .for_each(|(sum, known)| *sum += known);
            }
            for (column, gain) in columns.iter().zip(&estimate[own..]) {
                let (trial, column) = self.places[*column];
                let Trial {
                    candidate, shapes, ..
                } = &self.trials[trial];
                let entries = candidate.entries(&log.motion, shapes);
                let is_own = |entry: &Entry| entry.column == column;
                for entry in entries.into_iter().filter(is_own) {
                    let sums = torque[entry.joint].iter_mut();
                    sums.zip(entry.values)
                        .for_each(|(sum, value)| *sum += gain * value);
                }
            }
            let border = log.shared.border();
            let inner = border..log.motion.time.len().saturating_sub(border);
            for (joint, left) in all.iter_mut().enumerate() {
                let gain = arm.actuator_gain()[joint];
                left.extend(
                    inner
                        .clone()
                        .map(|k| gain * log.tau[joint][k] - torque[joint][k]),
                );
            }
        }
        all
    }
}

fn mean_square(values: &[f64]) -> f64 {
    values.iter().map(|value| value * value).sum::<f64>() / values.len().max(1) as f64
}
