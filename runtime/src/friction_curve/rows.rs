//! What a joint's torque is made of beside friction, along stretches of a log.

use std::ops::Range;

use super::stretch::{BLOCK_S, Stretch, encoder_step};
use crate::columns::{Arm, Entry};
use crate::log::{Channel, Log};
use crate::motion::{Kinematics, Motion};
use crate::signal::resample::whole_steps;
use crate::signal::{Bands, Prepared, SignalError, prepare};

/// A joint whose friction is measured, and the columns of its torque that are none.
///
/// The curve stands for everything that a constant speed leaves constant, so effects of friction and constant torques are not among the
/// columns.
///
/// # Examples
/// A motor alone, of which nothing is known:
/// ```
/// use robot_model::columns::{Arm, Columns, Entry, Shape, Unknown};
/// use robot_model::friction_curve::{Law, Measured};
/// use robot_model::log::Log;
/// use robot_model::motion::Motion;
///
/// struct Motor(Vec<String>);
/// impl Columns for Motor {
///     fn unknowns(&self) -> &[Unknown] { &[] }
///     fn shapes(&self) -> &[Shape] { &[] }
///     fn uses_rigid_torque(&self) -> bool { false }
///     fn entries(&self, _: &Motion, _: &[f64]) -> Vec<Entry> { Vec::new() }
/// }
/// impl Arm for Motor {
///     fn dof(&self) -> usize { 1 }
///     fn joints(&self) -> &[String] { &self.0 }
///     fn actuator_gain(&self) -> &[f64] { &[1.0] }
///     fn known_torque(&self, motion: &Motion, _: &[f64]) -> Vec<Vec<f64>> {
///         vec![vec![0.0; motion.time.len()]]
///     }
///     fn rigid_torque(&self, motion: &Motion, _: &[f64], _: &[f64]) -> Vec<Vec<f64>> {
///         vec![vec![0.0; motion.time.len()]]
///     }
/// }
///
/// // 2 s at each of six speeds, with friction of 0.5 N m and 0.1 N m s/rad.
/// let (mut q, mut tau) = (vec![0.0], vec![0.6]);
/// for k in 0..6000 {
///     let speed = 0.5 * f64::from(1 + k / 1000);
///     q.push(q[q.len() - 1] + 0.002 * speed);
///     tau.push(0.5 + 0.1 * speed);
/// }
/// let time = (0..q.len()).map(|k| 0.002 * k as f64).collect();
/// let log = Log::from_samples("a motor", time, vec![q], vec![tau])?;
/// let motor = Motor(vec!["motor".to_owned()]);
/// let measured = Measured { arm: &motor, joint: 0, shapes: Vec::new(), columns: Vec::new(), known: None };
/// let curve = measured.curve(&[log])?;
/// assert_eq!(curve.points.len(), 6);
/// let law = Law::fit(&curve)?;
/// assert!((law.coulomb.value - 0.5).abs() < 1e-3 && (law.viscous.value - 0.1).abs() < 1e-3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone)]
pub struct Measured<'a> {
    /// The arm.
    pub arm: &'a dyn Arm,
    /// The joint, from 0.
    pub joint: usize,
    /// A value for each shape that the arm leaves open; those of friction do not matter.
    pub shapes: Vec<f64>,
    /// Columns that are not friction: indices into the arm's unknowns, ascending.
    pub columns: Vec<usize>,
    /// Values of all the arm's unknowns, where they are known: then nothing is fitted beside the curve.
    pub known: Option<Vec<f64>>,
}

/// The joint's torque and its columns along a motion.
pub(super) struct Along {
    /// N m or N; less what is known of it.
    pub torque: Vec<f64>,
    /// What is known of it.
    known: Vec<f64>,
    /// `[column][sample]`, in the order of [`Measured::columns`].
    pub columns: Vec<Vec<f64>>,
}

/// Means over blocks of stretches.
#[derive(Default)]
pub(super) struct Rows {
    /// Which stretch a block belongs to.
    pub stretch: Vec<usize>,
    /// Length of each block, s.
    pub seconds: Vec<f64>,
    pub torque: Vec<f64>,
    /// What is known of the torque, and was taken from it.
    pub known: Vec<f64>,
    /// `[column][block]`: columns at no acceleration, and behind them what accelerations add to each. Their values are looked for apart,
    /// as the little acceleration of a constant speed says nothing of a weight.
    pub columns: Vec<Vec<f64>>,
}

/// Where a joint's curve was measured.
#[derive(Default)]
pub(super) struct Runs {
    pub rows: Rows,
    /// Speed and length, s, of each stretch.
    pub stretches: Vec<(f64, f64)>,
    /// From where to where each joint went or stood.
    pub range: Vec<(f64, f64)>,
    /// A step of the encoder from one sample to the next, as a speed.
    pub speed_step: f64,
}

impl Measured<'_> {
    pub(super) fn name(&self) -> String {
        self.arm.joints()[self.joint].clone()
    }

    /// Torque and columns along a motion, in which other joints stand.
    pub(super) fn along(&self, motion: &Motion) -> Along {
        let gain = self.arm.actuator_gain()[self.joint];
        let known = self.arm.known_torque(motion, &self.shapes);
        let mut along = Along {
            torque: motion.tau[self.joint]
                .iter()
                .map(|tau| gain * tau)
                .collect(),
            known: known[self.joint].clone(),
            columns: vec![vec![0.0; motion.time.len()]; self.columns.len()],
        };
        for Entry {
            joint,
            column,
            values,
        } in self.arm.entries(motion, &self.shapes)
        {
            let Ok(place) = self.columns.binary_search(&column) else {
                continue;
            };
            if joint != self.joint {
                continue;
            }
            match &self.known {
                Some(known) => {
                    let pairs = along.known.iter_mut().zip(values);
                    pairs.for_each(|(all, value)| *all += known[column] * value);
                }
                None => along.columns[place] = values,
            }
        }
        if self.known.is_some() {
            along.columns.clear();
        }
        let pairs = along.torque.iter_mut().zip(&along.known);
        pairs.for_each(|(torque, known)| *torque -= known);
        along
    }

    /// As [`Self::along`], with columns at no acceleration and what accelerations add.
    fn parted(&self, motion: &Motion) -> Along {
        let mut along = self.along(motion);
        let mut even = motion.clone();
        for band in [&mut even.smooth, &mut even.wide] {
            band.ddq[self.joint].fill(0.0);
        }
        let even = self.along(&even).columns;
        for (column, even) in along.columns.iter_mut().zip(&even) {
            column.iter_mut().zip(even).for_each(|(x, even)| *x -= even);
        }
        along.columns = [even, along.columns].concat();
        along
    }

    /// All stretches of all logs.
    pub(super) fn runs(&self, logs: &[Log]) -> Result<Runs, SignalError> {
        let mut runs = Runs {
            range: vec![(f64::INFINITY, f64::NEG_INFINITY); self.arm.dof()],
            speed_step: f64::INFINITY,
            ..Runs::default()
        };
        let count = match self.known {
            None => self.columns.len(),
            Some(_) => 0,
        };
        runs.rows.columns = vec![Vec::new(); 2 * count];
        for log in logs {
            let found = Stretch::find(log, self.joint);
            if found.is_empty() {
                continue;
            }
            let step = encoder_step(&log.q[self.joint]) * log.rate_hz();
            // A fast log may jump over single steps.
            runs.speed_step = runs.speed_step.min(step);
            let prepared = prepare(log, &Bands::for_log(log))?;
            let block = whole_steps((BLOCK_S * prepared.rate_hz).round()).max(1);
            for stretch in found {
                let from = stretch.samples.start.div_ceil(prepared.stride);
                let samples = from..stretch.samples.end / prepared.stride;
                if samples.len() < block {
                    continue;
                }
                let motion = standing(&prepared, samples, self.joint);
                for (range, q) in runs.range.iter_mut().zip(&motion.smooth.q) {
                    let (low, high) = super::stretch::ends(q);
                    *range = (range.0.min(low), range.1.max(high));
                }
                let number = runs.stretches.len();
                let seconds = stretch.samples.len() as f64 / log.rate_hz();
                runs.stretches.push((stretch.speed, seconds));
                let seconds = block as f64 / prepared.rate_hz;
                runs.rows
                    .push(number, &self.parted(&motion), block, seconds);
            }
        }
        Ok(runs)
    }
}

impl Rows {
    /// Appends the means of a stretch's blocks. What a mean leaves of an acceleration is the difference of two velocities.
    fn push(&mut self, stretch: usize, along: &Along, block: usize, seconds: f64) {
        let means = |values: &[f64]| -> Vec<f64> {
            let blocks = values.chunks_exact(block);
            blocks
                .map(|block| block.iter().sum::<f64>() / block.len() as f64)
                .collect()
        };
        let torque = means(&along.torque);
        self.stretch
            .extend(std::iter::repeat_n(stretch, torque.len()));
        self.seconds
            .extend(std::iter::repeat_n(seconds, torque.len()));
        self.torque.extend(torque);
        self.known.extend(means(&along.known));
        for (column, values) in self.columns.iter_mut().zip(&along.columns) {
            column.extend(means(values));
        }
    }
}

/// A part of a motion in which all joints but one stand where they are on average.
pub(super) fn standing(prepared: &Prepared, samples: Range<usize>, joint: usize) -> Motion {
    let motion = &prepared.motion;
    let part = |values: &Vec<f64>| values[samples.clone()].to_vec();
    let all = |channels: &[Vec<f64>]| channels.iter().map(part).collect::<Vec<_>>();
    let still = |band: &Kinematics| {
        let mut band = Kinematics {
            q: all(&band.q),
            dq: all(&band.dq),
            ddq: all(&band.ddq),
        };
        for other in (0..band.q.len()).filter(|&other| other != joint) {
            let mean = band.q[other].iter().sum::<f64>() / samples.len() as f64;
            band.q[other].fill(mean);
            band.dq[other].fill(0.0);
            band.ddq[other].fill(0.0);
        }
        band
    };
    Motion {
        time: part(&motion.time),
        smooth: still(&motion.smooth),
        wide: still(&motion.wide),
        tau: all(&motion.tau),
        extra: motion
            .extra
            .iter()
            .map(|channel| Channel {
                name: channel.name.clone(),
                values: part(&channel.values),
            })
            .collect(),
        displacement_hz: motion.displacement_hz,
        ..Motion::default()
    }
}
