//! Rows around the turns of joints with dry friction.
//!
//! A joint that turns may stand for a while, held by as much friction as it takes and not by what the law says of either direction;
//! and encoders do not tell within some samples when it turned. Of simulated arms under a controller both make dry friction come out
//! too large and viscous friction too small by several deviations. By how much an estimate moves when a joint's rows there are left out,
//! as far as the shared filter spreads them, is in its deviations; or they are left out. Source of that practice: Swevers, Verdonck,
//! De Schutter 2007, Dynamic model identification for industrial robots, who leave out samples of low velocity.
//!
//! The filter of the filtered form remembers a turn for much longer than the shared one spreads it, and starts anew behind each (see
//! [`start_anew`]).

use super::clipped::{clear_rows, rows_at};
use super::deviated::Solved;
use super::least_squares::{Factors, Solution};
use super::stack::Stack;
use super::{Estimate, Identify, IdentifyError, is_shape_told};
use crate::columns::Arm;
use crate::motion;
use crate::signal::Prepared;
use crate::signal::resample::whole_steps;

mod standing;

use standing::Motion;

/// What the shared filter spreads a turn over, on either side, in periods of its cutoff.
const SPREAD: f64 = 0.75;

/// By how many times deviations are smaller without rows at turns where these are left out: real friction is no jump, and what rows at turns
/// say of it is not given up for less.
const SURER: f64 = 1.5;

/// Notes which rows of a stack of the logs the turns of dry joints reach. Those of a joint that stands nearly all the time are left out,
/// and those of long rests: dry friction holds it with a torque that nobody knows, and steps of its encoder are no motion.
pub(super) fn find(stack: &mut Stack, arm: &dyn Arm, logs: &[Prepared]) {
    stack.turns = vec![Vec::new(); stack.dof()];
    stack.held = stack.turns.clone();
    for (number, log) in logs.iter().enumerate() {
        let start = stack.segments[number].start;
        for &joint in arm.dry_joints() {
            let Standing { turns, held } = Standing::of(log, joint);
            stack.held[joint].extend(rows_at(start, log, &held));
            stack.turns[joint].extend(rows_at(start, log, &turns));
        }
    }
    clear_rows(&mut stack.joints, &stack.held);
}

/// Rows of a joint whose dry friction the arm does not know: where it turns, and where it is held.
pub(super) fn of_joint(stack: &Stack, logs: &[Prepared], joint: usize) -> Vec<usize> {
    let of_log = |(number, log): (usize, &Prepared)| {
        let start = stack.segments[number].start;
        let Standing { turns, held } = Standing::of(log, joint);
        let reached = [turns, held].map(|reached| rows_at(start, log, &reached));
        reached.concat()
    };
    logs.iter().enumerate().flat_map(of_log).collect()
}

/// Which samples of a log are left out, since the dry friction of a joint holds it.
pub(super) fn held(arm: &dyn Arm, log: &Prepared, joint: usize) -> Vec<bool> {
    if arm.dry_joints().contains(&joint) {
        Standing::of(log, joint).held
    } else {
        Vec::new()
    }
}

/// Which samples of a log say what a model of a joint is worth: those away from its turns, at which its dry friction does not hold it.
pub(crate) fn away(arm: &dyn Arm, log: &Prepared, joint: usize) -> Vec<bool> {
    if !arm.dry_joints().contains(&joint) {
        return vec![true; log.motion.time.len()];
    }
    let Standing { turns, held } = Standing::of(log, joint);
    let pairs = turns.iter().zip(&held);
    pairs.map(|(turns, held)| !turns && !held).collect()
}

/// Which samples of a log the turns of a joint reach, and at which it is held.
struct Standing {
    turns: Vec<bool>,
    held: Vec<bool>,
}

impl Standing {
    fn of(log: &Prepared, joint: usize) -> Self {
        let motion = Motion::new(&log.motion, joint);
        let reach = whole_steps((SPREAD * log.shared.border() as f64).ceil());
        let mut turns = motion.near_turns(reach);
        let mut held = vec![false; turns.len()];
        if motion.is_held(&turns) {
            std::mem::swap(&mut turns, &mut held);
        } else {
            let mut rests = motion.rests(&turns, reach, log.rate_hz);
            rests.extend(motion.dwells(reach, log.rate_hz));
            for rest in rests {
                turns[rest.clone()].fill(false);
                held[rest].fill(true);
            }
        }
        Self { turns, held }
    }
}

/// What becomes of rows around the turns of [joints with dry friction](Arm::dry_joints).
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum AtTurns {
    /// By how much they move an estimate is in its deviations, but for arms with [`Arm::dry_shapes`] that other rows tell: these are fitted
    /// without them.
    #[default]
    Kept,
    /// Left out also where they move an estimate further than what they tell is worth: where deviations are a third smaller without them, in
    /// the geometric mean over the unknowns. For friction that is a jump: of any other law the difference says what the spec lacks.
    Judged,
    /// Other rows alone are fitted.
    LeftOut,
}

impl Identify {
    /// Fits an arm with [`Arm::dry_shapes`] without rows at turns: there a joint stands longer than its law says, and a search would bend
    /// the law after that. With these rows where no others tell all that is looked for.
    pub(super) fn away_from_turns(
        &self,
        arm: &dyn Arm,
        fit: &dyn Fn(&Self) -> Result<Estimate, IdentifyError>,
    ) -> Result<Estimate, IdentifyError> {
        if self.leaves_out_turns() || self.shapes.is_some() || arm.dry_shapes().is_empty() {
            return fit(self);
        }
        let away = self.without_turns();
        let is_told = |found: &Estimate, shape: usize| {
            let std = found.shape_std[shape];
            std.is_some_and(|std| is_shape_told(found.shapes[shape].1, std))
        };
        match fit(&away) {
            Ok(found)
                if found.unexcited.is_empty()
                    && arm.dry_shapes().iter().all(|&k| is_told(&found, k)) =>
            {
                Ok(found)
            }
            _ => fit(&Self {
                at_turns: AtTurns::Kept,
                ..self.clone()
            }),
        }
    }

    /// The same without rows at turns.
    pub(super) fn without_turns(&self) -> Self {
        Self {
            at_turns: AtTurns::LeftOut,
            ..self.clone()
        }
    }

    /// Whether rows at turns are left out whatever they say.
    pub(super) fn leaves_out_turns(&self) -> bool {
        self.at_turns == AtTurns::LeftOut
    }

    /// The fit without rows at turns in the place of one with them, where that is to be judged, is less sure, and tells no more.
    pub(super) fn surer_without(
        &self,
        with: &Solved,
        fit: &dyn Fn(&Self) -> Result<Estimate, IdentifyError>,
    ) -> Option<Estimate> {
        if !with.is_surer_without_turns || self.at_turns != AtTurns::Judged {
            return None;
        }
        let found = fit(&self.without_turns()).ok()?;
        let mut shapes = with.shape_std.iter().zip(&found.shape_std);
        let tells_shapes = shapes.all(|(with, without)| with.is_none() || without.is_some());
        let untold = with.solution.unexcited.len();
        (tells_shapes && found.unexcited.len() == untold).then_some(found)
    }
}

/// Makes the rows zero that turns reach.
pub(crate) fn leave_out(stack: &mut Stack) {
    clear_rows(&mut stack.joints, &stack.turns);
}

/// Which samples of a motion are within `reach` of one at which a joint turns or may stand.
pub(super) fn near(motion: &motion::Motion, joint: usize, reach: usize) -> Vec<bool> {
    Motion::new(motion, joint).near_turns(reach)
}

/// Starts a filter of the first order anew behind every turn, from zero, and leaves nothing of what is near one. Of a sample `kept` is left
/// in the next. What a series that passed it has of the time before decays by that factor whatever comes in, so both sides of an equation
/// stay equal.
pub(super) fn start_anew(series: &mut [f64], near: &[bool], kept: f64) {
    let mut had = 0.0;
    for (value, is_near) in series.iter_mut().zip(near) {
        had = if *is_near { *value } else { kept * had };
        *value -= had;
    }
}

/// Whether rows of a stack are at turns, `[joint][row]`.
pub(super) fn are_at(stack: &Stack) -> Vec<Vec<bool>> {
    let mut are_at = vec![vec![false; stack.samples()]; stack.dof()];
    for (are_at, turns) in are_at.iter_mut().zip(&stack.turns) {
        for &row in turns {
            are_at[row] = true;
        }
    }
    are_at
}

/// Factors of the rows of a stack, which have weights, and of those of them that are not at turns.
pub(super) fn with_and_without(stack: &Stack, weights: &[Vec<f64>]) -> [Factors; 2] {
    let are_at = are_at(stack);
    let root = |joint: usize, row: usize| weights[joint][row].sqrt();
    let away = |joint: usize, row: usize| {
        if are_at[joint][row] {
            0.0
        } else {
            root(joint, row)
        }
    };
    [
        Factors::of_rows(stack, &root),
        Factors::of_rows(stack, &away),
    ]
}

/// Deviations with what rows at turns move a solution of least squares by, unknown by unknown: factors of all rows and of those away
/// from turns are solved with the same `scale` of each joint. Of the difference `d`, whose variance is that of the solution without
/// them less that with them, `d^2` less that variance counts. Unknowns that other rows do not tell keep their deviations.
///
/// Tells whether the solution without these rows is the surer one: other rows tell as many unknowns, and its deviations are smaller by
/// [`SURER`] in the geometric mean.
pub(super) fn widen(all: &Factors, away: &Factors, scale: &[f64], std: &mut [f64]) -> bool {
    let ones = vec![1.0; scale.len()];
    let [with, without] = [all, away].map(|factors| factors.solve(scale, &ones));
    widen_between(&with, &without, std)
}

/// The same of two solutions by one method, with all rows and without those at turns.
pub(super) fn widen_between(with: &Solution, without: &Solution, std: &mut [f64]) -> bool {
    let (mut logarithms, mut told) = (0.0, 0.0);
    for (k, std) in std.iter_mut().enumerate() {
        if with.is_told(k) && without.is_told(k) && with.std[k] > 0.0 && *std > 0.0 {
            let difference = with.estimate[k] - without.estimate[k];
            let less_told = (without.std[k] / with.std[k]).powi(2) - 1.0;
            let noise_without = *std * (1.0 + less_told.max(0.0)).sqrt();
            let beyond = difference.powi(2) - std.powi(2) * less_told.max(0.0);
            *std = std.hypot(beyond.max(0.0).sqrt());
            logarithms += (*std / noise_without).ln();
            told += 1.0;
        }
    }
    logarithms > told * SURER.ln() && without.unexcited == with.unexcited
}
