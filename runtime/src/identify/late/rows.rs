//! The equations of logs, with columns beside those of the model that look like a delay.

use super::super::stack::{Stack, nameless, says_nothing};
use super::super::{clipped, turns};
use crate::columns::{Arm, Entry};
use crate::signal::{Prepared, derivative};

/// The equations without delays.
pub(super) struct Rows<'a> {
    pub arm: &'a dyn Arm,
    pub logs: &'a [Prepared],
    /// Per log the joints that say nothing.
    silent: Vec<Vec<usize>>,
    pub stack: Stack,
    /// `[joint][row]` at turns of joints with dry friction that the arm does not know.
    pub stuck: Vec<Vec<usize>>,
}

impl<'a> Rows<'a> {
    /// Of a stack, with friction that the arm may not have. Rows at turns of joints whose dry friction it knows are left out in any case: what
    /// holds a joint there is no law's, and larger than what a delay makes.
    pub fn new(arm: &'a dyn Arm, logs: &'a [Prepared], stack: Stack) -> Self {
        let mut rows = Self {
            arm,
            logs,
            silent: logs.iter().map(says_nothing).collect(),
            stack,
            stuck: vec![Vec::new(); arm.dof()],
        };
        let sign = |log: &Prepared, joint: usize| -> Vec<f64> {
            let speeds = log.motion.wide.dq[joint].iter();
            let sign = |v: &f64| if *v == 0.0 { 0.0 } else { v.signum() };
            speeds.map(sign).collect()
        };
        let columns = |series: &dyn Fn(&Prepared, usize) -> Vec<f64>| -> Vec<Vec<f64>> {
            let joints = 0..arm.dof();
            let of = |joint| rows.filtered(joint, |log| series(log, joint));
            joints.map(of).collect()
        };
        let viscous = columns(&|log, joint| log.motion.smooth.dq[joint].clone());
        let dry = columns(&sign);
        let turns = columns(&|log, joint| {
            let mut slope = Vec::new();
            derivative(&sign(log, joint), 1.0 / log.rate_hz, &mut slope);
            slope
        });
        for columns in [viscous, dry, turns] {
            append(&mut rows.stack, columns);
        }
        clipped::clear_again(&mut rows.stack);
        turns::leave_out(&mut rows.stack);
        rows
    }

    /// The dry friction that joints may have beside what the arm has of it: which joint's it is, and in which column.
    pub fn dry(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        let dof = self.arm.dof();
        // Viscous friction is before it, and turns are behind.
        let first = self.stack.unknowns.len() - 2 * dof;
        let known = self.arm.dry_joints();
        let unknown = (0..dof).filter(|joint| !known.contains(joint));
        unknown.map(move |joint| (joint, first + joint))
    }

    /// Whether a joint says something of the time of its channels: its friction holds it for less than half of the time.
    pub fn moves(&self, joint: usize) -> bool {
        let held = self.stack.held.get(joint).map_or(0, Vec::len);
        2 * held < self.stack.samples()
    }

    /// Rows at turns of joints that stick there.
    pub fn stuck_at(&self, sticky: &[usize]) -> Vec<Vec<usize>> {
        let of = |joint| {
            if sticky.contains(&joint) {
                turns::of_joint(&self.stack, self.logs, joint)
            } else {
                Vec::new()
            }
        };
        (0..self.arm.dof()).map(of).collect()
    }

    /// The same without such rows.
    pub fn without(mut self, stuck: &[Vec<usize>]) -> Self {
        for (turns, stuck) in self.stack.turns.iter_mut().zip(stuck) {
            turns.extend(stuck);
        }
        turns::leave_out(&mut self.stack);
        self.stuck = stuck.to_vec();
        self
    }

    /// A joint's series of all logs, as the rows have it: zero where the joint says nothing.
    pub fn filtered(&self, joint: usize, series: impl Fn(&Prepared) -> Vec<f64>) -> Vec<f64> {
        let mut all = Vec::new();
        let mut filtered = Vec::new();
        for (log, silent) in self.logs.iter().zip(&self.silent) {
            log.shared.apply(&series(log), &mut filtered);
            if silent.contains(&joint) {
                filtered.fill(0.0);
            }
            all.extend_from_slice(&filtered);
        }
        all
    }

    /// What a joint's torque of so much later has more than that of now, as rows have it.
    pub fn moved(&self, joint: usize, delay: f64) -> Vec<f64> {
        let gain = self.arm.actuator_gain()[joint];
        self.filtered(joint, |log| {
            let later = log.motion.late(&log.tau[joint], -delay);
            let pairs = later.into_iter().zip(&log.tau[joint]);
            pairs.map(|(later, now)| gain * (later - now)).collect()
        })
    }

    /// Rows that were left out say nothing of columns that came later, either.
    pub fn leave_out(stack: &mut Stack) {
        clipped::clear_again(stack);
        turns::leave_out(stack);
    }

    /// The same equations for the torque of so much later, and behind their columns the slopes of that torque.
    pub fn shifted(&self, delays: &[f64]) -> Stack {
        let mut stack = self.stack.clone();
        let mut slopes = Vec::new();
        for (joint, delay) in delays.iter().enumerate() {
            let later = |log: &Prepared| log.motion.late(&log.tau[joint], -delay);
            let moved = self.moved(joint, *delay);
            let rows = &mut stack.joints[joint];
            for values in [&mut rows.tau, &mut rows.target] {
                values.iter_mut().zip(&moved).for_each(|(x, by)| *x += by);
            }
            let gain = self.arm.actuator_gain()[joint];
            slopes.push(self.filtered(joint, |log| {
                let mut slope = Vec::new();
                derivative(&later(log), 1.0 / log.rate_hz, &mut slope);
                slope.iter().map(|x| -gain * x).collect()
            }));
        }
        append(&mut stack, slopes);
        Self::leave_out(&mut stack);
        stack
    }
}

/// A column for each joint.
pub(super) fn append(stack: &mut Stack, columns: Vec<Vec<f64>>) {
    let entries = columns.into_iter().enumerate();
    let entries = entries.map(|(joint, values)| Entry {
        joint,
        column: joint,
        values,
    });
    let entries: Vec<Entry> = entries.collect();
    stack.append(&vec![nameless(); entries.len()], &entries);
}
