//! From accepted effects and what they leave to a verdict.

use std::ops::Range;

use super::floor::Floor;
use super::search::{Accepted, State};
use super::structure::Structure;
use super::sure::TOLD;
use super::verdict::{Alternative, Finding, FoundParameter, Outcome, Tried, Verdict, doubtful};

/// Structure is accounted for where less than this share of it is left.
const LEFT_SHARE: f64 = 0.3;

/// The right law leaves next to nothing of a joint's structure: a name is doubtful where more than the first share of it is left on its joint,
/// if that is more than the second share of the error's power, as what the filters of the motion leave is not, and if more than the third
/// share of the error that was not fitted stays.
const LEFT_OF_LAW: f64 = 0.15;
const LEFT_BY_FILTERS: f64 = 0.06;
const STAYS: f64 = 0.5;

impl<'a> State<'a> {
    /// Accepted effects with the places of their parameters among the unknowns; none of changes of the arm, which have none.
    pub(super) fn placed(&self) -> impl Iterator<Item = (&Accepted<'a>, Range<usize>)> {
        let all = || {
            let effects = self.accepted.iter();
            effects.filter(|effect| effect.changed.is_none())
        };
        let count: usize = all().map(|effect| effect.trial.count()).sum();
        let mut next = self.stack.unknowns.len() - count;
        all().map(move |effect| {
            let first = next;
            next += effect.trial.count();
            (effect, first..next)
        })
    }

    /// Effects that are named and act on a joint.
    fn acting(&self, joint: usize) -> impl Iterator<Item = &Accepted<'a>> {
        let acts =
            move |effect: &&Accepted| !effect.is_small && effect.trial.touched().contains(&joint);
        self.accepted.iter().filter(acts)
    }

    /// The share of a joint's held-out error that stays with the effects which act on it.
    fn stays(&self, joint: usize) -> f64 {
        let percent = self.acting(joint);
        let percent = percent.map(|effect| effect.evidence.held_out_percent[joint]);
        percent.map(|percent| 1.0 - percent / 100.0).product()
    }

    /// Whether a joint has findings that leave most of its held-out error.
    pub(super) fn leaves_most(&self, joint: usize) -> bool {
        self.acting(joint).next().is_some() && self.stays(joint) > STAYS
    }
}

/// What is told of the last model beside what it is made of.
pub(super) struct Told {
    /// Deviations of the accepted effects' parameters.
    pub(super) std: Vec<Vec<Option<f64>>>,
    /// The floor of every joint.
    pub(super) floor: Vec<Floor>,
    /// Speeds below which dry friction does not act in full.
    pub(super) turn_speeds: Vec<f64>,
}

/// The verdict on a finished search; `is_beyond` is whether it leaves more than differs from period to period where it found nothing, or a function
/// of the motion that is as large as a doubt.
pub(super) fn verdict(
    state: &State,
    before: Vec<Structure>,
    after: Vec<Structure>,
    values: &Told,
    tried: Vec<Tried>,
    is_beyond: bool,
) -> Verdict {
    let found = findings(state, &values.std);
    // Nor is all well where a law that is not the right one takes much off.
    let is_doubtful = found.is_empty() && doubtful(&tried, &after).is_some();
    let is_settled = !is_beyond && !unsettled(&before, &after, state);
    // A law that only fits with a sign which it may not have stands with the others for something else.
    let mut parameters = found.iter().flat_map(|finding| &finding.parameters);
    let has_turned = parameters.any(|parameter| !parameter.is_possible);
    let left = is_doubtful || !is_settled || has_turned;
    let outcome = match (left, found.is_empty()) {
        (true, _) => Outcome::Unexplained,
        (false, true) => Outcome::NothingMissing,
        (false, false) => Outcome::Explained,
    };
    let (findings, leads) = if outcome == Outcome::Explained {
        (found, Vec::new())
    } else {
        (Vec::new(), found)
    };
    Verdict {
        outcome,
        findings,
        leads,
        alternatives: alternatives(state),
        tried,
        before,
        after,
        left: Vec::new(),
        noise_floor: values.floor.clone(),
        turn_speeds: values.turn_speeds.clone(),
        series: Vec::new(),
        goes_on: false,
        is_settled,
    }
}

/// The verdict on a search that found a change of the arm, which is its last effect: what it leaves is not known yet.
pub(super) fn changed(
    state: &State,
    before: Vec<Structure>,
    values: &Told,
    tried: Vec<Tried>,
) -> Verdict {
    Verdict {
        outcome: Outcome::Explained,
        findings: findings(state, &values.std),
        leads: Vec::new(),
        alternatives: alternatives(state),
        tried,
        after: before.clone(),
        before,
        left: Vec::new(),
        noise_floor: values.floor.clone(),
        turn_speeds: values.turn_speeds.clone(),
        series: Vec::new(),
        goes_on: true,
        is_settled: true,
    }
}

/// Whether a value is below zero by more than its deviations.
fn is_below_zero(value: f64, std: Option<f64>) -> bool {
    std.is_some_and(|std| value < -TOLD * std)
}

/// Accepted effects with their values.
fn findings(state: &State, std: &[Vec<Option<f64>>]) -> Vec<Finding> {
    let mut places = state.placed();
    let last_part = |name: &str| name.rsplit('.').next().unwrap_or(name).to_owned();
    let found = state.accepted.iter().zip(std).filter_map(|(effect, std)| {
        let candidate = effect.trial.candidate;
        let mut parameters = Vec::new();
        if effect.changed.is_none() {
            let (_, place) = places.next().expect("one an effect");
            let values = &state.solution.estimate[place];
            let linear = candidate.unknowns().iter().zip(values);
            let linear = linear.zip(std);
            parameters.extend(linear.map(|((unknown, value), std)| FoundParameter {
                name: last_part(&unknown.name),
                value: *value,
                std: *std,
                shape: false,
                is_felt: true,
                is_possible: !(unknown.nonnegative && is_below_zero(*value, *std)),
            }));
        }
        // The unknowns of a change are its shapes.
        let names: Vec<&str> = match &effect.changed {
            Some(_) => candidate
                .unknowns()
                .iter()
                .map(|u| u.name.as_str())
                .collect(),
            None => candidate.shapes().iter().map(|s| s.name.as_str()).collect(),
        };
        let (shapes, std) = match &effect.changed {
            Some(own) => (&own.values, own.std.as_slice()),
            None => (&effect.trial.shapes, &std[effect.trial.count()..]),
        };
        let is_felt = |number: usize| effect.changed.is_some() || effect.trial.is_felt(number);
        let shapes = names.iter().zip(shapes).zip(std).enumerate();
        parameters.extend(shapes.map(|(number, ((name, value), std))| FoundParameter {
            name: last_part(name),
            value: *value,
            std: std.filter(|_| is_felt(number)),
            shape: true,
            is_felt: is_felt(number),
            is_possible: true,
        }));
        (!effect.is_small).then(|| Finding {
            kind: candidate.kind().to_owned(),
            effect: candidate.effect(),
            joints: candidate.joints().to_vec(),
            parameters,
            evidence: effect.evidence.clone(),
            precedes_change: false,
        })
    });
    found.collect()
}

/// The rivals of every accepted effect, with its place after pruning.
fn alternatives(state: &State) -> Vec<Alternative> {
    let named = state.accepted.iter().filter(|effect| !effect.is_small);
    named
        .enumerate()
        .flat_map(|(place, effect)| {
            effect.rivals.iter().map(move |rival| Alternative {
                instead_of: place,
                ..rival.clone()
            })
        })
        .collect()
}

/// Whether structure that matters is left which the findings should have accounted for, or which makes them doubtful.
///
/// Findings stand beside structure on other joints as long as they are most of the story: one law was enough for every
/// joint, and more of the joints on which something was missing are settled than not. Where names pile up on a joint, or
/// most of the structure is elsewhere, the names are those of something else.
fn unsettled(before: &[Structure], after: &[Structure], state: &State) -> bool {
    let laws = |joint: usize| state.acting(joint).count();
    let joints = 0..after.len();
    let left: Vec<usize> = joints
        .clone()
        .filter(|&j| after[j].is_material() && after[j].power > LEFT_SHARE * before[j].power)
        .collect();
    let settled = joints
        .clone()
        .filter(|j| laws(*j) > 0 && !left.contains(j))
        .count();
    // A level that changes is no law of the motion that another one stands for: beside one that is settled it is another story.
    let is_story = |joint: &&usize| settled == 0 || !after[**joint].is_of_level();
    let elsewhere = left.iter().filter(is_story).count();
    let one_law_each = joints.clone().all(|j| laws(j) <= 1);
    let is_doubtful =
        |j: usize| laws(j) > 0 && is_another_law(&before[j], &after[j], state.stays(j));
    joints.clone().any(is_doubtful)
        || left.iter().any(|&joint| laws(joint) > 0 || !one_law_each)
        || (elsewhere > 0 && elsewhere >= settled)
}

/// Whether a joint's findings leave what the right law would not: structure, while most of the held-out error `stays`, a share of it.
fn is_another_law(before: &Structure, after: &Structure, stays: f64) -> bool {
    after.share > LEFT_BY_FILTERS && after.power > LEFT_OF_LAW * before.power && stays > STAYS
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_is_below_zero_by_more_than_its_deviation() {
        assert!(is_below_zero(-3.2, Some(0.5)));
        assert!(!is_below_zero(-0.9, Some(0.5)) && !is_below_zero(3.2, Some(0.5)));
        assert!(!is_below_zero(-3.2, None));
    }

    #[test]
    fn a_law_that_leaves_structure_and_most_of_the_error_is_another_one() {
        let structure = |power: f64, share: f64| Structure {
            power,
            share,
            ratio: 2.0,
            stepped: 0.0,
        };
        let before = structure(1.0, 0.3);
        assert!(is_another_law(&before, &structure(0.4, 0.1), 0.6));
        // It takes most of the error, on an arm that has something else besides.
        assert!(!is_another_law(&before, &structure(0.4, 0.1), 0.4));
        // Filters leave as much of any law.
        assert!(!is_another_law(&before, &structure(0.4, 0.05), 0.6));
        // Nearly all that there was is gone.
        assert!(!is_another_law(&before, &structure(0.1, 0.1), 0.6));
    }
}
