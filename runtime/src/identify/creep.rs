//! How slowly a joint has to move for its dry friction to have a direction.
//!
//! Where a joint turns round its friction goes from one side to the other over a range of speeds: asperities bend, and a joint that is held
//! creeps. A law that has the sign of a velocity in it takes that for nothing, and what it is off by, a pulse at every turn, looks like
//! bristles or like a Stribeck curve with the wrong sign. So logs are asked for the width `w` of `tanh(dq / w)` in place of `sign(dq)`, joint
//! by joint, as far as that is small: what is wider is another law.

use super::{Identify, IdentifyError, Stack, check_logs, prepare_all, slowest_bands};
use crate::columns::{Arm, Entry, Unknown};
use crate::log::Log;
use crate::motion::between;
use crate::signal::Prepared;
use crate::signal::resample::whole_steps;

/// Widths that are tried, as shares of a joint's root-mean-square speed: each so many times the one before. None is narrower than what the
/// encoder does not tell. What holds a joint does not know how fast its motion is, so a slow joint, as one along a rail, may have twice the
/// width that others are taken to have where logs do not tell.
const LOWEST: f64 = 2e-4;
const HIGHEST: f64 = 0.015;
const HIGHEST_OF_SLOW: f64 = 0.05;
const STEP: f64 = 1.5;

/// How often the step between widths is halved after that.
const HALVINGS: i32 = 4;

/// Instants of a sample interval over which a column is averaged.
const INSTANTS: u32 = 4;

/// A column of the model is the joint's dry friction from this correlation on.
const ALIKE: f64 = 0.95;

/// By which share a joint's squared error has to be less with a width than with the one that its encoder has.
const SHARE: f64 = 0.04;

/// Where logs do not tell, a joint that its friction holds is taken to creep at speeds up to this, rad/s or m/s, and to at most this share of
/// its root-mean-square speed: a fine encoder shows the direction of creep, which says nothing of the friction. Positions between steps,
/// of a simulation or a filter, are taken for exact.
const CREEP: f64 = 0.002;
const MOST_CREEP_SHARE: f64 = 0.005;

impl Identify {
    /// Speeds below which dry friction does not act in full, one a joint, rad/s or m/s, for [`Log::with_turn_speeds`]: what explains the
    /// logs better than what their encoders do not tell. Other joints have that, or 2 mrad/s (mm/s) if it is more.
    ///
    /// # Errors
    /// Those of [`Identify::fit`].
    ///
    /// # Examples
    /// ```
    /// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
    /// # use pendulum::{measure, pendulum};
    /// # use robot_model::identify::Identify;
    /// let speeds = Identify::default().turn_speeds(&pendulum(), &[measure(0.7)])?;
    /// assert_eq!(speeds.len(), 1);
    /// # Ok::<(), robot_model::identify::IdentifyError>(())
    /// ```
    pub fn turn_speeds(&self, arm: &dyn Arm, logs: &[Log]) -> Result<Vec<f64>, IdentifyError> {
        check_logs(arm, logs)?;
        let mut prepared = prepare_all(logs, &slowest_bands(logs))?;
        let (solution, _, mut stack) = self.solve(arm, &mut prepared, None)?;
        stack.silence(&solution.unexcited);
        let joints: Vec<usize> = (0..arm.dof()).collect();
        let untold = joints.iter().map(|&joint| {
            let of_encoder = current(&prepared, joint);
            let creep = CREEP.min(MOST_CREEP_SHARE * speed(&prepared, joint));
            if of_encoder > 0.0 {
                of_encoder.max(creep)
            } else {
                0.0
            }
        });
        let mut speeds: Vec<f64> = untold.collect();
        for (joint, speed) in self.creeping(&stack, &prepared, &joints)? {
            speeds[joint] = speed;
        }
        Ok(speeds)
    }

    /// Of these joints those that creep where they turn round, with the speeds of it.
    pub(crate) fn creeping(
        &self,
        stack: &Stack,
        logs: &[Prepared],
        joints: &[usize],
    ) -> Result<Vec<(usize, f64)>, IdentifyError> {
        let joints = joints.iter().copied();
        let turns = joints.map(|joint| Turns::new(logs, joint));
        let mut turns: Vec<Turns> = turns.filter(|turns| turns.lowest < turns.highest).collect();
        if turns.is_empty() {
            return Ok(Vec::new());
        }
        let mut without = stack.clone();
        for turns in &mut turns {
            turns.find_friction(&mut without, logs);
        }
        let turns = turns;
        let found = self.tried(&without, &turns, logs, &vec![None; turns.len()])?;
        let before: Vec<f64> = found.iter().map(|tried| tried.squares).collect();
        let count = whole_steps(((HIGHEST_OF_SLOW / LOWEST).ln() / STEP.ln()).ceil());
        let mut best: Vec<(usize, Tried)> = vec![(0, Tried::NONE); turns.len()];
        let at = |turns: &Turns, place: usize| turns.lowest * STEP.powf(place as f64);
        for place in 0..count {
            let widths = turns
                .iter()
                .map(|turns| Some(at(turns, place).min(turns.highest)));
            let tried = self.tried(&without, &turns, logs, &widths.collect::<Vec<_>>())?;
            for (best, tried) in best.iter_mut().zip(tried) {
                if tried.squares < best.1.squares {
                    *best = (place, tried);
                }
            }
        }
        let inside = turns.iter().zip(&best);
        let inside = inside.map(|(turns, (place, _))| at(turns, place + 1) < turns.highest);
        let inside: Vec<bool> = inside.collect();
        let mut best: Vec<Tried> = best.into_iter().map(|(_, tried)| tried).collect();
        for halving in 1..=HALVINGS {
            let step = STEP.powf(0.5_f64.powi(halving));
            for factor in [step, 1.0 / step] {
                let widths = best.iter().map(|tried| Some(factor * tried.width));
                let tried = self.tried(&without, &turns, logs, &widths.collect::<Vec<_>>())?;
                for (best, tried) in best.iter_mut().zip(tried) {
                    if tried.squares < best.squares {
                        *best = tried;
                    }
                }
            }
        }
        let told = turns.iter().zip(best).zip(before).zip(inside);
        let told = told.filter(|(((_, tried), before), inside)| {
            *inside && tried.squares < (1.0 - SHARE) * before
        });
        Ok(told
            .map(|(((turns, tried), _), _)| (turns.joint, tried.width))
            .collect())
    }

    /// The model with these widths, of a joint each; without one where there is none.
    fn tried(
        &self,
        without: &Stack,
        turns: &[Turns],
        logs: &[Prepared],
        widths: &[Option<f64>],
    ) -> Result<Vec<Tried>, IdentifyError> {
        let mut stack = without.clone();
        let asked = turns.iter().zip(widths);
        let asked = asked.filter_map(|(turns, width)| width.map(|width| (turns, width)));
        for (turns, width) in asked {
            let change = turns.column(&stack, logs, &|dq| {
                jump(dq, width) - jump(dq, turns.current)
            });
            turns.widen(&mut stack, &change);
        }
        let solution = self.solve_stack(&stack)?;
        let residuals = stack.residuals(&solution.estimate);
        let all = turns.iter().zip(widths);
        let tried = all.map(|(turns, width)| Tried {
            width: width.unwrap_or(turns.current),
            squares: residuals[turns.joint].iter().map(|r| r * r).sum(),
        });
        Ok(tried.collect())
    }
}

/// A width, and the squared error of the joint with it.
#[derive(Debug, Clone, Copy)]
struct Tried {
    width: f64,
    squares: f64,
}

impl Tried {
    const NONE: Self = Self {
        width: 0.0,
        squares: f64::INFINITY,
    };
}

/// A joint that may creep.
struct Turns {
    joint: usize,
    /// Widths that are tried.
    lowest: f64,
    highest: f64,
    /// The width that its columns have.
    current: f64,
    /// The column of its dry friction, and how many times that of a direction it is.
    friction: Option<(usize, f64)>,
}

impl Turns {
    fn new(logs: &[Prepared], joint: usize) -> Self {
        let speed = speed(logs, joint);
        let current = current(logs, joint);
        Self {
            joint,
            lowest: (LOWEST * speed).max(STEP.sqrt() * current),
            highest: (2.0 * CREEP).clamp(HIGHEST * speed, HIGHEST_OF_SLOW * speed),
            current,
            friction: None,
        }
    }

    /// Looks for the column of the joint's dry friction, which an undeclared one has to have, too.
    fn find_friction(&mut self, stack: &mut Stack, logs: &[Prepared]) {
        let values = self.column(stack, logs, &|dq| jump(dq, self.current));
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let own = dot(&values, &values).max(f64::MIN_POSITIVE);
        let alike = |column: &[f64]| {
            let norm = (dot(column, column) * own).sqrt();
            dot(column, &values).abs() / norm.max(f64::MIN_POSITIVE)
        };
        let columns = stack.joints[self.joint].columns.iter();
        let best = columns.map(|(column, of_joint)| (*column, alike(of_joint), of_joint));
        let best = best.max_by(|a, b| a.1.total_cmp(&b.1));
        self.friction = Some(match best {
            Some((column, alike, of_joint)) if alike > ALIKE => {
                (column, dot(of_joint, &values) / own)
            }
            _ => (self.append(stack, values), 1.0),
        });
    }

    /// Makes the column of the joint's dry friction another one.
    fn widen(&self, stack: &mut Stack, change: &[f64]) {
        let Some((wanted, times)) = self.friction else {
            return;
        };
        let columns = &mut stack.joints[self.joint].columns;
        for (_, values) in columns.iter_mut().filter(|(column, _)| *column == wanted) {
            for (value, change) in values.iter_mut().zip(change) {
                *value += times * change;
            }
        }
    }

    /// Filtered rows of a function of the joint's velocity.
    fn column(&self, stack: &Stack, logs: &[Prepared], of: &dyn Fn(f64) -> f64) -> Vec<f64> {
        let (mut values, mut filtered) = (Vec::with_capacity(stack.samples()), Vec::new());
        for log in logs {
            let column = means(&log.motion.wide.dq[self.joint], of);
            log.shared.apply(&column, &mut filtered);
            values.extend_from_slice(&filtered);
        }
        let rows = &stack.joints[self.joint];
        for (row, value) in values.iter_mut().enumerate() {
            if !rows.is_there(row) {
                *value = 0.0;
            }
        }
        values
    }

    /// A column more; its place.
    fn append(&self, stack: &mut Stack, values: Vec<f64>) -> usize {
        let unknown = Unknown {
            name: String::new(),
            nonnegative: false,
        };
        let entry = Entry {
            joint: self.joint,
            column: 0,
            values,
        };
        stack.append(&[unknown], &[entry])
    }
}

/// The largest of the widths that logs have now.
fn current(logs: &[Prepared], joint: usize) -> f64 {
    let speeds = logs.iter().map(|log| log.motion.turn_speed(joint));
    speeds.fold(0.0, f64::max)
}

/// A joint's root-mean-square speed.
fn speed(logs: &[Prepared], joint: usize) -> f64 {
    let velocities = || logs.iter().flat_map(|log| &log.motion.wide.dq[joint]);
    let squares = velocities().map(|dq| dq * dq).sum::<f64>();
    (squares / velocities().count().max(1) as f64).sqrt()
}

/// Means of a function of a velocity over the interval about every sample, as columns that jump are.
fn means(velocity: &[f64], of: &dyn Fn(f64) -> f64) -> Vec<f64> {
    let all: Vec<usize> = (0..velocity.len()).collect();
    let mut sum = vec![0.0; velocity.len()];
    for instant in 0..INSTANTS {
        let part = (f64::from(instant) + 0.5) / f64::from(INSTANTS) - 0.5;
        for (sum, velocity) in sum.iter_mut().zip(between(velocity, part, &all)) {
            *sum += of(velocity) / f64::from(INSTANTS);
        }
    }
    sum
}

/// The direction of a velocity, over a width.
fn jump(dq: f64, width: f64) -> f64 {
    if width > 0.0 {
        (dq / width).tanh()
    } else if dq == 0.0 {
        0.0
    } else {
        dq.signum()
    }
}
