//! What a trace ends with.

mod doubt;
mod refusal;

use std::fmt;

use super::floor::Floor;
use super::structure::Structure;
use super::whereabouts::Whereabouts;
use crate::columns::Candidate;

pub(super) use doubt::{DOUBT_PERCENT, doubtful};
pub use refusal::Refusal;

/// Why an effect was accepted, in numbers.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Evidence {
    /// `F` statistic of the effect against the residual: every model column projected out, blocks of time as samples.
    pub score: f64,
    /// Probability of that score or more in noise, times the independent tests that all candidates and shapes are worth.
    pub p_value: f64,
    /// Fall of the held-out error (shared band, cross-validation inside the identification logs), percent per joint. Coefficients are those of
    /// the other folds; shapes, which are few, are those of all.
    pub held_out_percent: Vec<f64>,
    /// The same for the error on raw samples, percent per joint.
    pub raw_percent: Vec<f64>,
    /// Folds in which the effect's joints got better, of all folds.
    pub folds: (usize, usize),
}

#[cfg(test)]
impl Evidence {
    /// Beyond chance, and better in every fold, with these falls of the errors, percent per joint.
    pub(super) fn certain(held_out_percent: &[f64], raw_percent: &[f64]) -> Self {
        Self {
            score: 100.0,
            p_value: 0.0,
            held_out_percent: held_out_percent.to_vec(),
            raw_percent: raw_percent.to_vec(),
            folds: (5, 5),
        }
    }
}

/// A parameter of a found effect.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct FoundParameter {
    /// Name in the effect's definition.
    pub name: String,
    /// Estimate, SI; where others do the same, that with these at zero.
    pub value: f64,
    /// Standard deviation beside all other unknowns, shapes among them; none where another unknown or a sum of others does the same, or where the
    /// logs do not show it.
    pub std: Option<f64>,
    /// Whether it is a shape parameter.
    pub shape: bool,
    /// Whether the logs show it: of a shape that is not felt other values fit as well.
    pub is_felt: bool,
    /// Whether it has a sign that it may have: beside laws that were found later another one may have turned. A finding has no other.
    pub is_possible: bool,
}

/// An effect that the spec does not declare.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Finding {
    /// Kebab-case name.
    pub kind: String,
    /// Name in the language of what a spec declares for it.
    pub effect: String,
    /// Joints, from 0.
    pub joints: Vec<usize>,
    /// Parameters as found by the trace, linear ones first.
    pub parameters: Vec<FoundParameter>,
    /// Why it was accepted.
    pub evidence: Evidence,
    /// Whether a change of the arm was found after it: evidence and deviations are those of the arm without.
    pub precedes_change: bool,
}

/// A candidate that was judged, at its best shapes.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Tried {
    /// Effects that had been accepted before.
    pub round: usize,
    /// Kebab-case name.
    pub kind: String,
    /// Name in the language of what a spec would declare for it: of several laws of the kind, which one.
    pub effect: String,
    /// Joints, from 0.
    pub joints: Vec<usize>,
    /// Values of its shape parameters.
    pub shapes: Vec<f64>,
    /// What it is worth.
    pub evidence: Evidence,
    /// Why it may not be named; empty for one that may.
    pub refusals: Vec<Refusal>,
    /// Whether it reads the logged torque, whose noise it may be.
    pub(super) follows_torque: bool,
}

impl Tried {
    /// Whether it takes a fifth or more off both the held-out and the raw error of its joints, where either is the most of them.
    ///
    /// # Examples
    /// ```
    /// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
    /// # use pendulum::{dry_friction, measure, pendulum};
    /// use robot_model::trace::Trace;
    /// let (arm, candidate) = (pendulum(), dry_friction());
    /// let traced = Trace::new(vec![&candidate]).run(&arm, &[measure(0.7)], &mut |_| ())?;
    /// assert!(traced.tried[0].takes_much());
    /// # Ok::<(), robot_model::identify::IdentifyError>(())
    /// ```
    #[must_use]
    pub fn takes_much(&self) -> bool {
        let Evidence {
            held_out_percent,
            raw_percent,
            ..
        } = &self.evidence;
        let most = [held_out_percent, raw_percent].map(|all| self.of_its_joints(all));
        most.iter().all(|percent| *percent >= doubt::MUCH_PERCENT)
    }

    /// The most of its joints.
    fn of_its_joints(&self, percents: &[f64]) -> f64 {
        let joints = self.joints.iter().map(|joint| percents[*joint]);
        joints.fold(f64::NEG_INFINITY, f64::max)
    }
}

/// A candidate that the logs cannot tell from an accepted one, or nearly so.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Alternative {
    /// Kebab-case name.
    pub kind: String,
    /// Name in the language of what a spec declares for it.
    pub effect: String,
    /// Joints, from 0.
    pub joints: Vec<usize>,
    /// Place of the effect that it could stand for among the findings (or leads), from 0.
    pub instead_of: usize,
    /// Held-out error on raw samples relative to the finding's, percent; positive: worse.
    pub worse_percent: f64,
    /// In how many folds its held-out error, in the band of the fit and of all joints together, is larger than the finding's, and of how many;
    /// none where both were not judged on the same ones.
    pub worse_folds: Option<(usize, usize)>,
}

impl Alternative {
    /// A law in place of the finding (or lead) with a number, from 0; `worse_percent` is its held-out error relative to that one's.
    ///
    /// # Examples
    /// ```
    /// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
    /// use robot_model::trace::Alternative;
    /// let rival = Alternative::of(&pendulum::dry_friction(), 0, 0.4);
    /// assert_eq!((rival.effect.as_str(), rival.joints, rival.worse_folds), ("coulomb_friction", vec![0], None));
    /// ```
    #[must_use]
    pub fn of(candidate: &dyn Candidate, instead_of: usize, worse_percent: f64) -> Self {
        Self {
            kind: candidate.kind().to_owned(),
            effect: candidate.effect(),
            joints: candidate.joints().to_vec(),
            instead_of,
            worse_percent,
            worse_folds: None,
        }
    }
}

/// How a trace ended.
///
/// # Examples
/// ```
/// use robot_model::trace::Outcome;
/// assert_eq!(Outcome::NothingMissing.name(), "nothing-missing");
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Outcome {
    /// The declared model leaves no structure that matters.
    NothingMissing,
    /// The findings account for the structure.
    Explained,
    /// There is structure that no known effect accounts for.
    Unexplained,
}

impl Outcome {
    /// Name in JSON.
    ///
    /// # Examples
    /// ```
    /// assert_eq!(robot_model::trace::Outcome::Explained.name(), "explained");
    /// ```
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::NothingMissing => "nothing-missing",
            Self::Explained => "explained",
            Self::Unexplained => "unexplained",
        }
    }
}

impl fmt::Display for Outcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// The result of a trace.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Verdict {
    /// How it ended.
    pub outcome: Outcome,
    /// Effects that account for the structure, in the order of their discovery; empty unless the outcome is `Explained`.
    pub findings: Vec<Finding>,
    /// Effects that passed the gates although structure remains: the outcome is `Unexplained`, and these are leads.
    pub leads: Vec<Finding>,
    /// Effects that could stand for a finding.
    pub alternatives: Vec<Alternative>,
    /// The candidates of every round that explain most, best first.
    pub tried: Vec<Tried>,
    /// Structure of the residual per joint, with the declared model.
    pub before: Vec<Structure>,
    /// Structure of the residual per joint, with the findings or leads.
    pub after: Vec<Structure>,
    /// Of what the structure with the findings or leads is a function, for every joint where it matters.
    pub left: Vec<Whereabouts>,
    /// The least error that a model can have on the logs, per joint.
    pub noise_floor: Vec<Floor>,
    /// Speeds below which dry friction does not act in full with the findings, one a joint, rad/s or m/s: see [`Log::with_turn_speeds`](crate::log::Log::with_turn_speeds).
    pub turn_speeds: Vec<f64>,
    /// Joints, from 0, on which two leads are smooth curves of the joint's position and nothing else, or three are laws of it: terms of a series,
    /// which fits whatever curve the joint has, so that none is named.
    pub series: Vec<usize>,
    /// Whether the last finding changes the arm: what else is missing is to be asked of the arm with the findings declared, by
    /// [`Trace::since`](super::Trace::since).
    pub goes_on: bool,
    /// Whether what is left is no structure that the findings should have accounted for, and, where there are none, near the floor.
    pub(super) is_settled: bool,
}

impl Verdict {
    /// This one, but that no name accounts for what is there: its findings are leads.
    ///
    /// # Examples
    /// ```
    /// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
    /// # use pendulum::{dry_friction, measure, pendulum};
    /// use robot_model::trace::{Outcome, Trace};
    /// let (arm, candidate) = (pendulum(), dry_friction());
    /// let named = Trace::new(vec![&candidate]).run(&arm, &[measure(0.7)], &mut |_| ())?;
    /// let doubted = named.clone().unexplained();
    /// assert_eq!((doubted.outcome, &doubted.leads), (Outcome::Unexplained, &named.findings));
    /// # Ok::<(), robot_model::identify::IdentifyError>(())
    /// ```
    #[must_use]
    pub fn unexplained(self) -> Self {
        let leads = self.findings.into_iter().chain(self.leads);
        Self {
            outcome: Outcome::Unexplained,
            leads: leads.collect(),
            findings: Vec::new(),
            is_settled: false,
            ..self
        }
    }

    /// Where nothing was named: of the laws of the last round against which only their signs or ranges, folds that disagree or parameters that
    /// are traded speak, the one that takes most off the error of its joints, where that is a tenth or more. It is not the law, and something
    /// like it is missing. One that reads the logged torque counts only on joints with structure.
    ///
    /// # Examples
    /// ```
    /// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
    /// # use pendulum::{dry_friction, measure, pendulum};
    /// use robot_model::trace::Trace;
    /// let (arm, candidate) = (pendulum(), dry_friction());
    /// let traced = Trace::new(vec![&candidate]).run(&arm, &[measure(0.0)], &mut |_| ())?;
    /// assert_eq!(traced.doubtful(), None);
    /// # Ok::<(), robot_model::identify::IdentifyError>(())
    /// ```
    #[must_use]
    pub fn doubtful(&self) -> Option<&Tried> {
        let is_open = self.outcome == Outcome::Unexplained && self.leads.is_empty();
        doubtful(&self.tried, &self.after).filter(|_| is_open)
    }

    /// This one, which goes on, with what was found after it.
    ///
    /// # Examples
    /// ```
    /// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
    /// # use pendulum::{dry_friction, measure, pendulum};
    /// use robot_model::trace::Trace;
    /// let (arm, candidate) = (pendulum(), dry_friction());
    /// let trace = |fc| Trace::new(vec![&candidate]).run(&arm, &[measure(fc)], &mut |_| ());
    /// // First dry friction is found, then nothing more.
    /// let (first, then) = (trace(0.7)?, trace(0.0)?);
    /// let both = first.clone().followed_by(then);
    /// assert_eq!((both.outcome, &both.findings, &both.before), (first.outcome, &first.findings, &first.before));
    /// # Ok::<(), robot_model::identify::IdentifyError>(())
    /// ```
    #[must_use]
    pub fn followed_by(self, next: Self) -> Self {
        let places = self.findings.len();
        // A law that may not be named is no word against a model in which something was named before.
        let is_doubted = next.outcome == Outcome::Unexplained
            && (places == 0 || !next.leads.is_empty() || !next.is_settled);
        let is_explained = !is_doubted;
        // The last of them is the change.
        let earlier = self.findings.into_iter().enumerate();
        let earlier = earlier.map(|(place, finding)| Finding {
            precedes_change: finding.precedes_change || place + 1 < places,
            ..finding
        });
        let mut found: Vec<Finding> = earlier.collect();
        let later = if is_explained {
            next.findings
        } else {
            next.leads
        };
        found.extend(later);
        let (findings, leads) = if is_explained {
            (found, Vec::new())
        } else {
            (Vec::new(), found)
        };
        let rivals = next.alternatives.into_iter().map(|rival| Alternative {
            instead_of: places + rival.instead_of,
            ..rival
        });
        let later = next.tried.into_iter().map(|tried| Tried {
            round: places + tried.round,
            ..tried
        });
        Self {
            tried: self.tried.into_iter().chain(later).collect(),
            outcome: if is_explained {
                Outcome::Explained
            } else {
                Outcome::Unexplained
            },
            findings,
            leads,
            alternatives: self.alternatives.into_iter().chain(rivals).collect(),
            before: self.before,
            after: next.after,
            left: next.left,
            noise_floor: next.noise_floor,
            turn_speeds: next.turn_speeds,
            series: next.series,
            goes_on: next.goes_on,
            is_settled: next.is_settled,
        }
    }
}

#[cfg(test)]
mod tests;
