//! Rows of [`drive_gains`](super::drive_gains): where its search starts, and its equations about a point.

use super::shares::{Shares, columns};
use crate::columns::{Entry, Unknown};
use crate::identify::least_squares::Factors;
use crate::identify::{IdentifyError, RANK_TOLERANCE, Solution, Stack};

/// The rows of all logs, with what is known of their torques.
pub(super) struct Rows {
    /// Columns of the arm and of what is looked for of the payload; the target is what the drives logged.
    stack: Stack,
    /// `[joint][row]`, filtered torques of the spec's known parameters and of the payload as far as it is known.
    known: Vec<Vec<f64>>,
}

/// Least squares of some joints' rows for targets of their own, every row as it is.
fn ordinary(
    stack: &Stack,
    joints: std::ops::Range<usize>,
    targets: &[Vec<f64>],
) -> (Stack, Solution) {
    let mut own = Stack {
        unknowns: stack.unknowns.clone(),
        joints: stack.joints[joints].to_vec(),
        ..Stack::default()
    };
    for (rows, target) in own.joints.iter_mut().zip(targets) {
        rows.target.clone_from(target);
    }
    let solution = Factors::new(&own).ordinary(&vec![1.0; own.dof()]);
    (own, solution)
}

fn unknown(name: String) -> Unknown {
    Unknown {
        name,
        nonnegative: false,
    }
}

fn square(values: &[Vec<f64>]) -> f64 {
    values.iter().flatten().map(|x| x * x).sum()
}

impl Rows {
    /// `base` is what is known of the payload, there from row `start` on, in the arm's unknowns.
    pub fn new(mut stack: Stack, start: usize, shares: &Shares, base: &[f64]) -> Self {
        let mut known: Vec<Vec<f64>> = Vec::new();
        for rows in &mut stack.joints {
            let pairs = rows.tau.iter().zip(&rows.target);
            known.push(pairs.map(|(tau, target)| tau - target).collect());
            rows.target.clone_from(&rows.tau);
        }
        for entry in columns(&stack, start, 1, |unknown, _| base[unknown]) {
            for (sum, value) in known[entry.joint].iter_mut().zip(&entry.values) {
                *sum += value;
            }
        }
        let looked_for = shares.columns(&stack, start);
        stack.append(&shares.unknowns, &looked_for);
        Self { stack, known }
    }

    /// What the drives logged as their own joint's columns can make it, with as many parameters of its own for each joint.
    fn smoothed(&self) -> Vec<Vec<f64>> {
        let all = self.stack.joints.iter().zip(&self.known).enumerate();
        let of = all.map(|(joint, (rows, known))| {
            let mut own = self.stack.clone();
            let entry = Entry {
                joint,
                column: 0,
                values: known.clone(),
            };
            own.append(&[unknown("known".to_owned())], &[entry]);
            let target = std::slice::from_ref(&rows.tau);
            let (own, solution) = ordinary(&own, joint..joint + 1, target);
            let residual = &own.residuals(&solution.estimate)[0];
            let pairs = rows.tau.iter().zip(residual);
            pairs.map(|(tau, rest)| tau - rest).collect()
        });
        of.collect()
    }

    /// Unknowns and gains to start from, from `known = g v - W beta - W K pi`.
    ///
    /// # Errors
    /// [`IdentifyError::PayloadHidden`].
    pub fn start(&self) -> Result<(Vec<f64>, Vec<Option<f64>>), IdentifyError> {
        let (all, n) = (0..self.stack.dof(), self.stack.unknowns.len());
        let (without, hidden) = ordinary(&self.stack, all.clone(), &self.known);
        let rest = square(&without.residuals(&hidden.estimate));
        if rest <= RANK_TOLERANCE.powi(2) * square(&self.known) {
            return Err(IdentifyError::PayloadHidden);
        }
        let mut stack = self.stack.clone();
        for (joint, values) in self.smoothed().into_iter().enumerate() {
            let entry = Entry {
                joint,
                column: 0,
                values: values.iter().map(|value| -value).collect(),
            };
            stack.append(&[unknown(format!("gain {joint}"))], &[entry]);
        }
        let negative = self
            .known
            .iter()
            .map(|values| values.iter().map(|k| -k).collect());
        let negative: Vec<Vec<f64>> = negative.collect();
        let (_, solution) = ordinary(&stack, all.clone(), &negative);
        let gain = |joint: usize| {
            let value = solution.estimate[n + joint];
            (solution.is_told(n + joint) && value != 0.0).then_some(value)
        };
        let gains: Vec<Option<f64>> = all.map(gain).collect();
        if gains.iter().all(Option::is_none) {
            return Err(IdentifyError::PayloadHidden);
        }
        Ok((solution.estimate[..n].to_vec(), gains))
    }

    /// The equations `v = f / g` about a point, linear in the unknowns and behind them the gains that are told; those of a joint
    /// without a gain are linear already, with a gain of 1.
    pub fn linear(&self, values: &[f64], gains: &[Option<f64>], joints: &[String]) -> Stack {
        let mut linear = self.stack.clone();
        let mut entries: Vec<(String, Entry)> = Vec::new();
        for (joint, (rows, gain)) in linear.joints.iter_mut().zip(gains).enumerate() {
            let known = &self.known[joint];
            let Some(gain) = gain else {
                let pairs = rows.target.iter_mut().zip(known);
                pairs.for_each(|(target, known)| *target -= known);
                continue;
            };
            let mut torque = known.clone();
            for (column, own) in &mut rows.columns {
                for (sum, value) in torque.iter_mut().zip(own.iter_mut()) {
                    *sum += values[*column] * *value;
                    *value /= gain;
                }
            }
            for ((target, known), torque) in rows.target.iter_mut().zip(known).zip(&torque) {
                *target -= (known + torque) / gain;
            }
            let entry = Entry {
                joint,
                column: 0,
                values: torque.iter().map(|f| -f / (gain * gain)).collect(),
            };
            entries.push((format!("{}.actuator_gain", joints[joint]), entry));
        }
        for (name, entry) in entries {
            linear.append(&[unknown(name)], &[entry]);
        }
        linear
    }
}
