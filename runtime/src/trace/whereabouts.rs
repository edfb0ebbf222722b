//! Of what the structure that is left is a function.
//!
//! Where no effect accounts for a joint's residual, what it moves along with says where to look for one. Quantities of the motion are
//! asked one by one, a joint's own position and velocity together as well: a curve in one of them, whatever its form, stands beside the
//! model's columns as an effect would, and its share is what it takes off the squared error of folds that it was not fitted on. Shares
//! overlap, as quantities of one motion move together.

use crate::columns::Entry;

use super::curve::{Curve, STIFFNESS};
use super::gram::{Gram, HeldOut};
use super::normal::Smooth;
use super::quantity::Quantity;
use super::raw::mean_square;
use super::search::{Accepted, Search, State};
use super::step::{self, Step};
use super::verdict::DOUBT_PERCENT;

/// Terms of equations that are kept of a joint.
const MOST_TERMS: usize = 3;

/// How many times as much a term of the equations has to explain as an effect for the name of the effect to be wrong.
const MORE_THAN_AN_EFFECT: f64 = 1.5;

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
    /// Share of the residual's power that one constant takes off, which is in every curve.
    pub level: f64,
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
        let baseline = self.baseline(state, 1.0, self.folds_of(state));
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

    /// Of some joints; of those that are asked in full by what other joints do at once, too.
    pub(super) fn whereabouts(
        &self,
        state: &State,
        joints: Vec<usize>,
        is_asked_in_full: &dyn Fn(&usize) -> bool,
    ) -> Vec<Whereabouts> {
        if joints.is_empty() {
            return Vec::new();
        }
        let away = self.away(state);
        let (stack, sigma) = match away {
            Some(away) => (&away.stack, &away.solution.sigma),
            None => (&state.stack, &state.solution.sigma),
        };
        let gram = Gram::new(stack, self.folds_of(state));
        let without = gram.held_out(sigma);
        // The model with columns beside it on a joint.
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
            gram.extended(stack, &entries, entries.len())
        };
        // The share of the joint's residual that they take off.
        let share = |joint: usize, held_out: &HeldOut| {
            let left = held_out.mean(joint) / without.mean(joint).max(f64::MIN_POSITIVE);
            (1.0 - left).max(0.0)
        };
        let terms = self.terms();
        let level = self.level();
        let steps = self.steps(state);
        let of_joint = |joint: usize| {
            let more = is_asked_in_full(&joint).then(|| self.more_pairs(joint));
            let quantities = self.quantities(joint).chain(self.pairs(joint));
            let quantities = quantities.chain(more.into_iter().flatten());
            let shares = quantities.filter_map(|of| {
                let Curve { columns, bends } = self.curve(of)?;
                let with = beside(joint, columns);
                let shares = STIFFNESS.map(|stiffness| {
                    let first = gram.unknowns();
                    let smooth = Smooth {
                        first,
                        bends: &bends,
                        stiffness,
                    };
                    share(joint, &with.held_out_smooth(sigma, &smooth))
                });
                let share = shares.into_iter().fold(0.0, f64::max);
                Some(Share { of, share })
            });
            let mut shares: Vec<Share> = shares.collect();
            shares.sort_by(|a, b| b.share.total_cmp(&a.share));
            let terms = terms.iter().map(|(term, values)| {
                let with = beside(joint, vec![values.clone()]);
                let share = share(joint, &with.held_out(sigma));
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
            let level = beside(joint, vec![level.clone()]).held_out(sigma);
            Whereabouts {
                joint,
                level: share(joint, &level),
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

    /// A constant of 1, filtered.
    fn level(&self) -> Vec<f64> {
        let mut all = Vec::new();
        let mut filtered = Vec::new();
        for log in &self.prepared {
            let ones = vec![1.0; log.motion.time.len()];
            log.shared.apply(&ones, &mut filtered);
            all.extend_from_slice(&filtered);
        }
        all
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

    /// What two joints do at once.
    fn pairs(&self, joint: usize) -> impl Iterator<Item = Quantity> {
        let others = (0..self.arm.dof()).filter(move |&other| other != joint);
        others.flat_map(move |other| {
            [
                Quantity::Positions(joint, other),
                Quantity::Velocities(joint, other),
            ]
        })
    }

    /// Dry friction that changes with another joint's position or in time, and what two other joints do at once.
    fn more_pairs(&self, joint: usize) -> impl Iterator<Item = Quantity> {
        let others = move || (0..self.arm.dof()).filter(move |&other| other != joint);
        let own = others().map(move |other| Quantity::VelocityAndPosition(joint, other));
        let of_others = others().flat_map(move |one| {
            let second = others().filter(move |&other| other > one);
            second.flat_map(move |other| {
                [
                    Quantity::Positions(one, other),
                    Quantity::Velocities(one, other),
                ]
            })
        });
        let in_time = std::iter::once(Quantity::VelocityAndTime(joint));
        in_time.chain(own).chain(of_others)
    }

    /// Whereabouts on the joints that are told, and on others that are asked if a function of the motion has so large a share in them that it
    /// would take as much off their raw errors as makes a doubt, beyond what time or a constant has: a law that no structure shows, as noise is
    /// correlated over as long.
    pub(super) fn unknown_functions(
        &self,
        state: &State,
        is_told: &dyn Fn(&usize) -> bool,
        is_asked: &dyn Fn(&usize) -> bool,
    ) -> Vec<Whereabouts> {
        let raw = self.raw(state);
        let filtered: Vec<f64> = state.residuals.iter().map(mean_square).collect();
        let takes = |joint: usize, share: f64| {
            let all = raw.noise_power[joint] + filtered[joint];
            100.0 * (1.0 - (1.0 - share * filtered[joint] / all.max(f64::MIN_POSITIVE)).sqrt())
        };
        let may = |joint: &usize| {
            is_told(joint) || (is_asked(joint) && takes(*joint, 1.0) >= DOUBT_PERCENT)
        };
        let joints = (0..self.arm.dof()).filter(may).collect();
        let mut found = self.whereabouts(state, joints, is_told);
        found.retain(|one| {
            let most = |is: &dyn Fn(Quantity) -> bool| {
                let shares = one.shares.iter().filter(|share| is(share.of));
                shares.map(|share| share.share).fold(0.0, f64::max)
            };
            // A zero that wanders is as much a function of what is as slow, and one that is off is in every curve.
            let of_zero = most(&|of| of == Quantity::Time).max(one.level);
            let of_motion = most(&|of| of != Quantity::Time) - of_zero;
            is_told(&one.joint) || takes(one.joint, of_motion.max(0.0)) >= DOUBT_PERCENT
        });
        found
    }
}
