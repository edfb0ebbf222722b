//! What bends values and leaves no noise, so that no deviation of noise knows of it: it widens deviations.
//!
//! Friction whose law is another one than the spec's is in the values of the law that the spec has. So each joint is asked, away from its
//! turns, whether one more law of its speed `v` is there: `sign(v) exp(-(v/w)^2)` of some widths `w`, as Stribeck friction has it,
//! `sign(v)` or `v |v|`. Where one is, values are off by no less than what it moves them by.
//!
//! A torque that is set at a sample and holds until the next is early by half of one. Few logs say which of both theirs is, so two deviations
//! have what half a sample moves values by, as far as the log itself does not tell the time of its torque better. Where it tells a delay that
//! is longer, and noise hides what that leaves of errors, deviations have what it moves values by.

use std::collections::BTreeSet;
use std::ops::Range;

use super::deviated::Solved;
use super::least_squares::{Factors, Solution};
use super::stack::{Stack, norm, percent};
use super::{Beyond, Identify, is_delay, longest_period, turns};
use crate::columns::Arm;
use crate::signal::Prepared;

mod rows;

use rows::{Law, Rows};

/// Widths of the laws, as shares of a joint's root-mean-square speed.
const WIDTHS: [f64; 3] = [0.1, 0.25, 0.6];

/// A law is there from so many deviations on: laws and joints are many.
const DEVIATIONS: f64 = 5.0;

/// Share of a sample that two deviations of a torque's time are where nobody tells it.
const HELD: f64 = 0.5;

/// A law is another one than those of the arm where this share of it is beside the arm's columns. One that the arm has, the bands of which
/// differ, leaves a thousandth, and would be told against it.
const OWN_SHARE: f64 = 0.02;

/// Rows for an unknown below which any law would be found.
const FEWEST: usize = 5;

/// A joint whose torque follows its speed in another way than the friction of its spec.
///
/// # Examples
/// A pendulum with dry friction of 0.7 N m that its model lacks:
/// ```
/// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
/// # use pendulum::{measure, pendulum};
/// # use robot_model::identify::Identify;
/// let fit = |friction| Identify::default().fit(&pendulum(), &[measure(friction)]);
/// let [found] = fit(0.7)?.other_friction[..] else { panic!("one joint") };
/// assert!(found.joint == 0 && found.percent > 1.0);
/// assert!(fit(0.0)?.other_friction.is_empty());
/// # Ok::<(), robot_model::identify::IdentifyError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct OtherFriction {
    /// The joint, from 0.
    pub joint: usize,
    /// Root mean square of the law that is missing, of the joint's torque, percent: what the other columns do not make up for.
    pub percent: f64,
}

/// A delay of all torques that a log tells by its deviations alone: noise hides what it leaves of errors, by which a [`Delay`](super::Delay) is
/// told.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct HiddenDelay {
    /// By how much torques are late, s; negative where they are early.
    pub seconds: f64,
    /// Standard deviation, s.
    pub std: f64,
}

/// What values may be off by.
#[derive(Default)]
pub(super) struct Lacking {
    pub friction: Vec<OtherFriction>,
    pub delay: Option<HiddenDelay>,
    /// Of each unknown, in its unit; nothing where nobody asked.
    pub off: Vec<f64>,
    /// Unknowns that no rows but those at turns tell.
    pub at_turns: Vec<usize>,
}

impl Lacking {
    /// Deviations with what values are off by, of unknowns that have one.
    pub fn widened(&self, std: &[f64]) -> Vec<f64> {
        let mut widened = std.to_vec();
        for (std, off) in widened.iter_mut().zip(&self.off) {
            if *std > 0.0 {
                *std = std.hypot(*off);
            }
        }
        widened
    }
}

/// What a series of torques of a joint is in the equations of a fit.
pub(super) type Passed<'a> = &'a dyn Fn(&Prepared, usize, Vec<f64>) -> Vec<f64>;

impl Identify {
    /// What the values of a solution may be off by; nothing where no delays are asked for, which take as long.
    pub(super) fn lacking(
        &self,
        arm: &dyn Arm,
        logs: &[Prepared],
        passed: Passed<'_>,
        solved: &Solved,
    ) -> Lacking {
        let stack = &solved.stack;
        let counted: usize = stack.counts().iter().sum();
        if self.beyond < Beyond::Delays || counted < FEWEST * (stack.unknowns.len() + stack.dof()) {
            return Lacking::default();
        }
        let rows = Rows::new(arm, logs, passed, stack);
        let mut found = self.laws(&rows).unwrap_or_default();
        let (delay, moved) = self.moved_by_time(&rows, solved).unwrap_or_default();
        found.delay = delay;
        found.at_turns = self.told_at_turns(solved);
        found.off.resize(stack.unknowns.len(), 0.0);
        let pairs = found.off.iter_mut().zip(moved);
        pairs.for_each(|(off, moved)| *off = off.hypot(moved));
        found
    }

    /// Laws of speed that are there beside the friction of the arm; `None` where these rows do not tell what others do.
    fn laws(&self, rows: &Rows<'_>) -> Option<Lacking> {
        let plain = self.solve_stack(&rows.away).ok()?;
        let mut laws = self.likely(rows, &plain)?;
        while !laws.is_empty() {
            let with = Beside::new(self, rows, plain.estimate.len(), &laws)?;
            let sure = (0..laws.len()).filter(|law| with.is_sure(*law));
            let sure: Vec<(usize, Law)> = sure.map(|law| laws[law]).collect();
            if sure.len() == laws.len() {
                return Some(with.lacking(rows, &plain, &laws));
            }
            laws = sure;
        }
        None
    }

    /// Of each joint the law that is most likely, by deviations of correlation times, which are quick.
    fn likely(&self, rows: &Rows<'_>, plain: &Solution) -> Option<Vec<(usize, Law)>> {
        let unknowns = plain.estimate.len();
        let joints: Vec<usize> = (0..rows.away.dof()).collect();
        let mut best = vec![(DEVIATIONS, None); joints.len()];
        for law in Law::all() {
            let laws: Vec<(usize, Law)> = joints.iter().map(|&joint| (joint, law)).collect();
            let found = self.solve_stack(&rows.with(&laws)).ok()?;
            for (joint, best) in best.iter_mut().enumerate() {
                let own = unknowns + joint;
                let size = (found.estimate[own] / found.std[own]).abs();
                if found.is_told(own) && size > best.0 && is_another(rows, plain, joint, law) {
                    *best = (size, Some(law));
                }
            }
        }
        let joints = joints.into_iter().zip(best);
        Some(
            joints
                .filter_map(|(joint, (_, law))| Some((joint, law?)))
                .collect(),
        )
    }

    /// Unknowns that no rows but those at turns of one dry joint tell: by how much these move them nobody knows.
    fn told_at_turns(&self, solved: &Solved) -> Vec<usize> {
        if !self.has_turns(&solved.stack) {
            return Vec::new();
        }
        let untold = |joints: Range<usize>| {
            let mut rest = solved.stack.clone();
            for (joint, rows) in rest.turns.iter_mut().enumerate() {
                if !joints.contains(&joint) {
                    rows.clear();
                }
            }
            turns::leave_out(&mut rest);
            let rest = self.solve_stack(&rest).ok();
            let told = (0..solved.solution.estimate.len()).filter(|k| solved.solution.is_told(*k));
            rest.map_or_else(Vec::new, |rest| {
                told.filter(|k| !rest.is_told(*k)).collect()
            })
        };
        let joints = 0..solved.stack.dof();
        // Most logs tell all without any of these rows, and are asked once.
        if untold(joints.clone()).is_empty() {
            return Vec::new();
        }
        let of_joints: BTreeSet<usize> =
            joints.flat_map(|joint| untold(joint..joint + 1)).collect();
        of_joints.into_iter().collect()
    }

    /// What the time of torques moves values by, that nobody tells or that is beyond a sample.
    fn moved_by_time(
        &self,
        rows: &Rows<'_>,
        solved: &Solved,
    ) -> Option<(Option<HiddenDelay>, Vec<f64>)> {
        let (asked, own) = rows.with_slopes();
        let mut found = self.solve_stack(&asked).ok()?;
        found.std = self.deviations_of_products(&asked, &found);
        let period = longest_period(rows.logs);
        let most = 0.5 * HELD * period;
        let told = found.is_told(own).then(|| HiddenDelay {
            seconds: found.estimate[own],
            std: found.std[own],
        });
        let is_sure = |delay: &HiddenDelay| {
            delay.seconds.abs() > DEVIATIONS * delay.std && is_delay(delay.seconds, period)
        };
        let delay = told.filter(is_sure);
        let seconds = match (delay, told) {
            (Some(sure), _) => sure.seconds,
            (None, Some(told)) => told.seconds.hypot(told.std).min(most),
            (None, None) => most,
        };
        // By a second they are moved as far as the slopes are fitted by the other columns, joints weighed as in the fit.
        let slopes = Factors::new(&rows.of_slopes(&solved.stack));
        let moved = slopes.solve(&solved.solution.scale, &vec![1.0; solved.stack.dof()]);
        let moved = moved.estimate.iter().map(|x| x * seconds);
        Some((delay, moved.collect()))
    }
}

/// Whether a law of a joint is none that the columns of the arm have among them.
fn is_another(rows: &Rows<'_>, plain: &Solution, joint: usize, law: Law) -> bool {
    let of_law = rows.of_law(joint, law);
    let unweighted = vec![1.0; of_law.dof()];
    let solved = Factors::new(&of_law).solve(&plain.scale, &unweighted);
    let left = of_law.residuals(&solved.estimate);
    norm(&left[joint]) > OWN_SHARE * norm(&of_law.joints[joint].target)
}

/// A fit with laws behind the columns of the arm.
struct Beside {
    unknowns: usize,
    stack: Stack,
    solution: Solution,
}

impl Beside {
    fn new(
        identify: &Identify,
        rows: &Rows<'_>,
        unknowns: usize,
        laws: &[(usize, Law)],
    ) -> Option<Self> {
        let stack = rows.with(laws);
        let mut solution = identify.solve_stack(&stack).ok()?;
        solution.std = identify.deviations(&stack, &solution);
        Some(Self {
            unknowns,
            stack,
            solution,
        })
    }

    fn is_sure(&self, law: usize) -> bool {
        let (own, found) = (self.unknowns + law, &self.solution);
        found.is_told(own) && found.estimate[own].abs() > DEVIATIONS * found.std[own]
    }

    /// What the laws do beside the values without them.
    fn lacking(&self, rows: &Rows<'_>, plain: &Solution, laws: &[(usize, Law)]) -> Lacking {
        let before = rows.away.residuals(&plain.estimate);
        let after = self.stack.residuals(&self.solution.estimate);
        let friction = laws.iter().map(|&(joint, _)| {
            let less = norm(&before[joint]).powi(2) - norm(&after[joint]).powi(2);
            OtherFriction {
                joint,
                percent: percent(less.max(0.0).sqrt(), norm(&self.stack.joints[joint].tau)),
            }
        });
        let off = (0..self.unknowns).map(|k| {
            if plain.is_told(k) && self.solution.is_told(k) {
                self.solution.estimate[k] - plain.estimate[k]
            } else {
                0.0
            }
        });
        Lacking {
            friction: friction.collect(),
            delay: None,
            off: off.collect(),
            at_turns: Vec::new(),
        }
    }
}
