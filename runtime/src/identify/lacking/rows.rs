//! The equations of logs with further columns: laws of the speed of one joint, and slopes of all torques.

use super::{Passed, WIDTHS};
use crate::columns::{Arm, Entry};
use crate::identify::stack::{Stack, nameless};
use crate::identify::turns;
use crate::signal::{Prepared, derivative};

/// A law of a joint's speed.
#[derive(Clone, Copy)]
pub(super) enum Law {
    /// `sign(v) exp(-(v/w)^2)`, of the width as a share of the root-mean-square speed.
    Slow(f64),
    /// `sign(v)`, of arms that do not have it.
    Dry,
    /// `v |v|`
    Fast,
}

impl Law {
    pub fn all() -> impl Iterator<Item = Self> {
        WIDTHS
            .into_iter()
            .map(Self::Slow)
            .chain([Self::Dry, Self::Fast])
    }

    fn of(self, speeds: &[f64]) -> Vec<f64> {
        let squares = speeds.iter().map(|v| v * v).sum::<f64>() / speeds.len().max(1) as f64;
        let usual = squares.sqrt().max(f64::MIN_POSITIVE);
        let law = |v: f64| match self {
            Self::Slow(width) => v.signum() * (-(v / (width * usual)).powi(2)).exp(),
            Self::Dry => v.signum(),
            Self::Fast => v * v.abs(),
        };
        speeds.iter().map(|v| law(*v)).collect()
    }
}

/// Rows away from turns, of joints without dry friction, too: what holds a joint there is no law of its speed.
pub(super) struct Rows<'a> {
    arm: &'a dyn Arm,
    pub logs: &'a [Prepared],
    passed: Passed<'a>,
    pub away: Stack,
}

impl<'a> Rows<'a> {
    pub fn new(arm: &'a dyn Arm, logs: &'a [Prepared], passed: Passed<'a>, stack: &Stack) -> Self {
        let mut away = stack.clone();
        let joints = 0..away.dof();
        away.turns = joints
            .map(|joint| turns::of_joint(stack, logs, joint))
            .collect();
        turns::leave_out(&mut away);
        Self {
            arm,
            logs,
            passed,
            away,
        }
    }

    /// A series of all logs, as rows have it.
    fn series(&self, of: impl Fn(&Prepared) -> Vec<f64>) -> Vec<f64> {
        let (mut all, mut filtered) = (Vec::new(), Vec::new());
        for log in self.logs {
            log.shared.apply(&of(log), &mut filtered);
            all.extend_from_slice(&filtered);
        }
        all
    }

    /// The rows with laws of joints behind their columns.
    pub fn with(&self, laws: &[(usize, Law)]) -> Stack {
        let entries = laws.iter().enumerate();
        let entries = entries.map(|(column, &(joint, law))| self.law(joint, law, column));
        self.beside(entries.collect(), laws.len())
    }

    /// The rows' equations for a law of a joint in the place of the torques.
    pub fn of_law(&self, joint: usize, law: Law) -> Stack {
        let mut of_law = self.away.clone();
        for rows in &mut of_law.joints {
            rows.target.fill(0.0);
        }
        put(&mut of_law, &self.away, self.law(joint, law, 0));
        of_law
    }

    fn law(&self, joint: usize, law: Law, column: usize) -> Entry {
        let values =
            self.series(|log| (self.passed)(log, joint, law.of(&log.motion.smooth.dq[joint])));
        Entry {
            joint,
            column,
            values,
        }
    }

    /// The rows with one column of the slopes of all torques behind the others, and its place: of a torque that is late by `d`,
    /// `tau = W beta - d dtau/dt`.
    pub fn with_slopes(&self) -> (Stack, usize) {
        let slopes = self.slopes(&self.away);
        (self.beside(slopes, 1), self.away.unknowns.len())
    }

    /// The equations of a stack for the slopes of torques in the place of these.
    pub fn of_slopes(&self, stack: &Stack) -> Stack {
        let mut of_slopes = stack.clone();
        for slopes in self.slopes(stack) {
            put(&mut of_slopes, stack, slopes);
        }
        of_slopes
    }

    fn slopes(&self, stack: &Stack) -> Vec<Entry> {
        let slope = |log: &Prepared, joint: usize| {
            let gain = self.arm.actuator_gain()[joint];
            let mut slope = Vec::new();
            derivative(&log.tau[joint], 1.0 / log.rate_hz, &mut slope);
            slope.iter().map(|x| -gain * x).collect()
        };
        let joints = 0..stack.dof();
        let entries = joints.map(|joint| Entry {
            joint,
            column: 0,
            values: self.series(|log| slope(log, joint)),
        });
        entries.collect()
    }

    fn beside(&self, mut entries: Vec<Entry>, count: usize) -> Stack {
        let mut stack = self.away.clone();
        stack.clear_left_out(&mut entries);
        stack.append(&vec![nameless(); count], &entries);
        turns::leave_out(&mut stack);
        stack
    }
}

/// Makes a series the target of a joint, in the rows that are there.
fn put(equations: &mut Stack, stack: &Stack, entry: Entry) {
    let there = &stack.joints[entry.joint];
    let values = entry.values.into_iter().enumerate();
    let values = values.map(|(k, value)| if there.is_there(k) { value } else { 0.0 });
    equations.joints[entry.joint].target = values.collect();
}
