//! Of what the structure that is left is a function.
//!
//! Where no effect accounts for a joint's residual, what it moves along with says where to look for one. Quantities of the motion are
//! asked one by one, a joint's own position and velocity together as well: a curve in one of them, whatever its form, stands beside the
//! model's columns as an effect would, and its share is what it takes off the squared error of folds that it was not fitted on. Shares
//! overlap, as quantities of one motion move together.

use crate::columns::Entry;
use crate::signal::Prepared;
use crate::signal::resample::whole_steps;

use super::gram::Gram;
use super::search::{Accepted, Search, State};
use super::step::{self, Step};

/// A curve is straight between so many values of its quantity, among which samples are evenly spread.
const KNOTS: usize = 24;

/// The same of a surface in two quantities, for each of them.
const FEW_KNOTS: usize = 8;

/// Knots in time are further apart, s: a curve has to reach across the blocks that a fold leaves out.
const KNOT_S: f64 = 6.0;

/// A quantity that spans less than this of its largest value stands.
const LEAST_SPAN: f64 = 1e-6;

/// Terms of equations that are kept of a joint.
const MOST_TERMS: usize = 3;

/// How many times as much a term of the equations has to explain as an effect for the name of the effect to be wrong.
const MORE_THAN_AN_EFFECT: f64 = 1.5;

/// What a torque may follow from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Quantity {
    /// Position of a joint, from 0.
    Position(usize),
    /// Velocity of a joint; its curve may jump where the joint turns round.
    Velocity(usize),
    /// Acceleration of a joint.
    Acceleration(usize),
    /// What the transmission of a joint carries: torque of the rigid body.
    Load(usize),
    /// Position and velocity of a joint at once, one surface over both.
    Motion(usize),
    /// Time since the start of a log.
    Time,
}

impl Quantity {
    /// Name in JSON.
    ///
    /// # Examples
    /// ```
    /// assert_eq!(robot_model::trace::Quantity::Time.name(), "time");
    /// ```
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Position(_) => "position",
            Self::Velocity(_) => "velocity",
            Self::Acceleration(_) => "acceleration",
            Self::Load(_) => "load",
            Self::Motion(_) => "position-and-velocity",
            Self::Time => "time",
        }
    }

    /// The joint, from 0; none of time.
    ///
    /// # Examples
    /// ```
    /// assert_eq!(robot_model::trace::Quantity::Velocity(2).joint(), Some(2));
    /// ```
    #[must_use]
    pub const fn joint(self) -> Option<usize> {
        match self {
            Self::Position(joint)
            | Self::Velocity(joint)
            | Self::Acceleration(joint)
            | Self::Load(joint)
            | Self::Motion(joint) => Some(joint),
            Self::Time => None,
        }
    }

    /// Of a quantity that is several each of them; the last one may be a velocity.
    fn axes(self) -> Vec<Self> {
        match self {
            Self::Motion(joint) => vec![Self::Position(joint), Self::Velocity(joint)],
            one => vec![one],
        }
    }

    fn values(self, log: &Prepared) -> &[f64] {
        let motion = &log.motion;
        match self {
            Self::Position(joint) | Self::Motion(joint) => &motion.wide.q[joint],
            Self::Velocity(joint) => &motion.wide.dq[joint],
            Self::Acceleration(joint) => &motion.smooth.ddq[joint],
            Self::Load(joint) => &motion.rigid_torque[joint],
            Self::Time => &motion.time,
        }
    }

    /// The values between which a curve is straight; none of a quantity that stands.
    fn knots(self, most: usize, logs: &[Prepared]) -> Option<Vec<f64>> {
        let mut values: Vec<f64> = Vec::new();
        for log in logs {
            let of_log = self.values(log);
            values.extend(log.shared.kept(of_log.len()).map(|k| of_log[k]));
        }
        values.sort_by(f64::total_cmp);
        let (first, last) = (*values.first()?, *values.last()?);
        let count = match self {
            Self::Time => whole_steps((last - first) / KNOT_S).clamp(2, most),
            _ => most,
        };
        let at = |k: usize| values[k * (values.len() - 1) / (count - 1)];
        let mut knots: Vec<f64> = (0..count).map(at).collect();
        // Where a joint rests many samples are the same.
        let least = (last - first) / (8 * most) as f64;
        knots.dedup_by(|next, before| *next - *before < least);
        let stands = last - first <= LEAST_SPAN * first.abs().max(last.abs());
        (knots.len() > 1 && !stands).then_some(knots)
    }
}

/// How much of a joint's residual follows from one quantity.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Share {
    /// The quantity.
    pub of: Quantity,
    /// Share of the residual's power, in the band of the fit, that a curve in it takes off folds that it was not fitted on.
    pub share: f64,
}

/// How much of a joint's residual is one term of the arm's equations.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct TermShare {
    /// The function of the motion, see [`Arm::terms`](crate::columns::Arm::terms).
    pub term: String,
    /// What it is multiplied with, beside the model; in SI units.
    pub coefficient: f64,
    /// As in [`Share`].
    pub share: f64,
}

/// Where the structure of a joint's residual lives.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Whereabouts {
    /// The joint, from 0.
    pub joint: usize,
    /// Every quantity that is not at rest, the one of the largest share first.
    pub shares: Vec<Share>,
    /// Terms of the arm's equations that say most of it, the one of the largest share first.
    pub terms: Vec<TermShare>,
    /// Frequency of the highest line of the residual's spectrum, Hz.
    pub peak_hz: f64,
    /// Share of that line in the residual's power, in the band of the fit.
    pub peak_share: f64,
    /// Where its level changes, once.
    pub step: Option<Step>,
}

impl Search<'_> {
    /// Joints on which one term of the equations explains clearly more than an effect that passes: then it is the equations that are wrong.
    pub(super) fn where_a_term_is(&self, state: &State, found: &Accepted) -> Vec<usize> {
        let terms = self.terms();
        if terms.is_empty() || found.changed.is_some() {
            return Vec::new();
        }
        let baseline = self.baseline(state, 1.0, &self.folds);
        let present = &baseline.present;
        let by_effect = found.trial.project(present).map_or(0.0, |p| p.drop);
        let is_more = |joint: usize, values: &Vec<f64>| {
            let entry = Entry {
                joint,
                column: 0,
                values: values.clone(),
            };
            let projected = present.project(&[entry], 1);
            projected.is_some_and(|projected| projected.drop > MORE_THAN_AN_EFFECT * by_effect)
        };
        let mut joints = found.trial.touched();
        joints.retain(|&joint| terms.iter().any(|(_, values)| is_more(joint, values)));
        joints
    }

    /// Of some joints.
    pub(super) fn whereabouts(&self, state: &State, joints: Vec<usize>) -> Vec<Whereabouts> {
        if joints.is_empty() {
            return Vec::new();
        }
        let away = self.away(state);
        let (stack, sigma) = match away {
            Some(away) => (&away.stack, &away.solution.sigma),
            None => (&state.stack, &state.solution.sigma),
        };
        let gram = Gram::new(stack, &self.folds);
        let without = gram.held_out(sigma);
        // The model with columns beside it on a joint, and the share of the joint's residual that they take off.
        let beside = |joint: usize, columns: Vec<Vec<f64>>| {
            let entries = columns.into_iter().enumerate();
            let entries = entries.map(|(column, values)| Entry {
                joint,
                column,
                values,
            });
            let mut entries: Vec<Entry> = entries.collect();
            stack.clear_left_out(&mut entries);
            if let Some(away) = away {
                away.clear(&mut entries);
            }
            let with = gram.extended(stack, &entries, entries.len());
            let held_out = with.held_out(sigma);
            let left = held_out.mean(joint) / without.mean(joint).max(f64::MIN_POSITIVE);
            (with, (1.0 - left).max(0.0))
        };
        let terms = self.terms();
        let steps = self.steps(state);
        let of_joint = |joint: usize| {
            let shares = self.quantities(joint).filter_map(|of| {
                let (_, share) = beside(joint, self.curve(of)?);
                Some(Share { of, share })
            });
            let mut shares: Vec<Share> = shares.collect();
            shares.sort_by(|a, b| b.share.total_cmp(&a.share));
            let terms = terms.iter().map(|(term, values)| {
                let (with, share) = beside(joint, vec![values.clone()]);
                let solved = with.normal(sigma).solve();
                TermShare {
                    term: term.clone(),
                    coefficient: solved[gram.unknowns()],
                    share,
                }
            });
            let mut terms: Vec<TermShare> = terms.collect();
            terms.sort_by(|a, b| b.share.total_cmp(&a.share));
            terms.truncate(MOST_TERMS);
            let (peak_hz, peak_share) = self.peak(state, joint);
            Whereabouts {
                joint,
                shares,
                terms,
                peak_hz,
                peak_share,
                step: step::largest(&steps[joint]),
            }
        };
        joints.into_iter().map(of_joint).collect()
    }

    /// Terms of the arm's equations, filtered.
    fn terms(&self) -> Vec<(String, Vec<f64>)> {
        let names = self.arm.terms();
        let mut all = vec![Vec::new(); names.len()];
        let mut filtered = Vec::new();
        for log in &self.prepared {
            for (all, values) in all.iter_mut().zip(self.arm.term_values(&log.motion)) {
                log.shared.apply(&values, &mut filtered);
                all.extend_from_slice(&filtered);
            }
        }
        names.into_iter().zip(all).collect()
    }

    /// What a joint's residual is asked for.
    pub(super) fn quantities(&self, joint: usize) -> impl Iterator<Item = Quantity> {
        let own = [
            Quantity::Position(joint),
            Quantity::Velocity(joint),
            Quantity::Acceleration(joint),
            Quantity::Load(joint),
            Quantity::Motion(joint),
            Quantity::Time,
        ];
        let others = (0..self.arm.dof()).filter(move |&other| other != joint);
        let of_others = |other| [Quantity::Position(other), Quantity::Velocity(other)];
        own.into_iter().chain(others.flat_map(of_others))
    }

    /// Columns of a curve in a quantity, filtered: each is 1 at one knot and falls to 0 at its neighbors. None of a quantity that stands.
    pub(super) fn curve(&self, of: Quantity) -> Option<Vec<Vec<f64>>> {
        let axes = of.axes();
        let most = if axes.len() > 1 { FEW_KNOTS } else { KNOTS };
        let knots = axes.iter().map(|axis| axis.knots(most, &self.prepared));
        let knots = knots.collect::<Option<Vec<_>>>()?;
        let jumps = axes.last().filter(|of| matches!(of, Quantity::Velocity(_)));
        let cells: usize = knots.iter().map(Vec::len).product();
        let mut all = vec![Vec::new(); cells + usize::from(jumps.is_some())];
        let mut filtered = Vec::new();
        for log in &self.prepared {
            let samples = log.motion.time.len();
            let mut columns = vec![vec![0.0; samples]; all.len()];
            for k in 0..samples {
                let mut near = vec![(0, 1.0)];
                for (axis, knots) in axes.iter().zip(&knots) {
                    let (place, part) = between(knots, axis.values(log)[k]);
                    let beside = |&(cell, weight): &(usize, f64)| {
                        let cell = cell * knots.len() + place;
                        [(cell, weight * (1.0 - part)), (cell + 1, weight * part)]
                    };
                    near = near.iter().flat_map(beside).collect();
                }
                for (cell, weight) in near {
                    columns[cell][k] = weight;
                }
                if let Some(velocity) = jumps {
                    columns[cells][k] = velocity.values(log)[k].signum();
                }
            }
            for (all, column) in all.iter_mut().zip(&columns) {
                log.shared.apply(column, &mut filtered);
                all.extend_from_slice(&filtered);
            }
        }
        Some(all)
    }
}

/// The knot below a value, and how far that is on the way to the next one.
fn between(knots: &[f64], value: f64) -> (usize, f64) {
    let above = knots.partition_point(|knot| *knot <= value);
    let above = above.clamp(1, knots.len() - 1);
    let (low, high) = (knots[above - 1], knots[above]);
    (above - 1, ((value - low) / (high - low)).clamp(0.0, 1.0))
}
