//! From standard to base parameters: the smallest set that the torque determines, with the map between both.
//!
//! In: [`LinearForm`]. Out: [`BaseForm`]. Invariants gained: the columns of the kept parameters are independent, and
//! `Y * standard = Y_b * beta` with `beta = map * standard` for every value of the standard parameters.
//!
//! Columns are compared on the regressor's values at random states (Gautier 1991 does the same): a column is kept unless it
//! is a combination of the columns kept before it, from the first link to the last. So parameters of links near the tip
//! regroup into those near the base. Inside a link, inertia is looked at first, then first moments, then the mass: so
//! coefficients are lengths and squares of lengths, never one over a length.
//!
//! A column that is not zero by structure is never taken for one without influence because it is zero where we looked: it is
//! kept, and told. A column of an effect is a combination of others only where that holds state by state, in proportion to
//! what the columns are there.

mod names;
mod order;
mod rank;

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Add as _;

use robot_model_spec::model::Model;
use robot_model_spec::parameter::{Owner, StandardParameter, Status};

use crate::expr::Dag;
use crate::lumps::Lump;
use crate::regressor::LinearForm;
use crate::rounded::{Rounded, UNIT};
use crate::sample::{Column, Sample, sample};
use crate::selection::{Dependence, INDEPENDENT_ABOVE, Offer, Selection, norm, shortest};

pub use rank::{RankStatus, UnclearColumn};

/// The base parameters.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct BaseForm {
    /// Standard parameters whose columns are kept, ascending: one base parameter each.
    pub kept: Vec<usize>,
    /// Names of the base parameters: the kept parameter's, with `r` behind it where others are regrouped into it.
    pub names: Vec<String>,
    /// Per base parameter its combination `(standard parameter, coefficient)`. Of a chain: the kept one with coefficient 1,
    /// then those regrouped into it, ascending. Of a robot that says its energies: its lumped parameter, ascending.
    pub combinations: Vec<Vec<(usize, f64)>>,
    /// Standard parameters without influence on any torque.
    pub unidentifiable: Vec<usize>,
    /// Kept parameters whose torque was zero at every state that was tried: an effect behind a threshold that nothing reaches.
    pub asleep: Vec<usize>,
    /// Standard parameters that the spec fixes: neither kept nor regrouped.
    pub fixed: Vec<usize>,
    /// How clear the decisions were.
    pub rank: RankStatus,
}

impl BaseForm {
    /// Every parameter that moves anything and is not fixed, for itself.
    pub(crate) fn ungrouped(&self, standard: &[StandardParameter]) -> Self {
        let is_out = |k: &usize| self.fixed.contains(k) || self.unidentifiable.contains(k);
        let kept: Vec<usize> = (0..standard.len()).filter(|k| !is_out(k)).collect();
        Self {
            names: kept.iter().map(|&k| standard[k].name.clone()).collect(),
            combinations: kept.iter().map(|&k| vec![(k, 1.0)]).collect(),
            kept,
            ..self.clone()
        }
    }

    /// Writes lumps as the combinations of standard parameters that they are; until here each is its representative.
    pub(crate) fn spell_out(
        &mut self,
        model: &Model,
        standard: &[StandardParameter],
        lumps: &[Lump],
    ) {
        for combination in &mut self.combinations {
            let mut spelled: BTreeMap<usize, f64> = BTreeMap::new();
            for &(k, coefficient) in combination.iter() {
                match lumps.iter().find(|lump| lump.representative == k) {
                    Some(lump) => {
                        for &(part, share) in &lump.combination {
                            *spelled.entry(part).or_insert(0.0) += coefficient * share;
                        }
                    }
                    None => *spelled.entry(k).or_insert(0.0) += coefficient,
                }
            }
            *combination = spelled.into_iter().collect();
        }
        self.names = names::base_names(model, standard, &self.kept, &self.combinations);
        let used: BTreeSet<usize> = self
            .combinations
            .iter()
            .flatten()
            .map(|&(k, _)| k)
            .collect();
        self.unidentifiable.retain(|k| !used.contains(k));
    }

    /// What is remarkable about the effects that the spec declares, a sentence each: those that move nothing.
    #[must_use]
    pub fn remarks(&self, standard: &[StandardParameter]) -> Vec<String> {
        let names = |indices: &[usize]| -> Vec<String> {
            let of_effects = indices
                .iter()
                .map(|&k| &standard[k])
                .filter(|p| matches!(p.owner, Owner::Effect { .. }));
            of_effects.map(|p| format!("`{}`", p.name)).collect()
        };
        let (unidentifiable, asleep) = (names(&self.unidentifiable), names(&self.asleep));
        let mut remarks = Vec::new();
        if !unidentifiable.is_empty() {
            remarks.push(format!(
                "no torque depends on {}",
                unidentifiable.join(", ")
            ));
        }
        if !asleep.is_empty() {
            remarks.push(format!(
                "the torque of {} was zero at every tested state: is a threshold outside all motions?",
                asleep.join(", ")
            ));
        }
        remarks
    }

    /// `beta = map * standard`, of the numbers that the sum's rounding does not tell apart the one with the fewest digits: so
    /// 0.3 + 0.05 is 0.35.
    #[must_use]
    pub fn beta(&self, standard: &[f64]) -> Vec<f64> {
        self.combinations
            .iter()
            .map(|combination| {
                let mut terms = combination.iter().map(|&(k, coefficient)| {
                    // One times a number is that number.
                    let is_exact = coefficient.to_bits() == 1.0f64.to_bits();
                    let error = if is_exact { 0.0 } else { UNIT };
                    Rounded::relative(coefficient * standard[k], error)
                });
                let first = terms.next().unwrap_or_default();
                let sum = terms.fold(first, Rounded::add);
                shortest(sum.value, sum.error)
            })
            .collect()
    }
}

/// Decides which columns are independent and how the others regroup into them.
#[must_use]
pub fn reduce(dag: &Dag, model: &Model, linear: &LinearForm) -> BaseForm {
    let parameters = model.standard_parameters();
    let is_fixed = |k: &usize| matches!(parameters[*k].status, Status::Fixed(_));
    let mut base = BaseForm {
        kept: Vec::new(),
        names: Vec::new(),
        combinations: Vec::new(),
        unidentifiable: Vec::new(),
        asleep: Vec::new(),
        fixed: (0..parameters.len()).filter(is_fixed).collect(),
        rank: RankStatus::Clear {
            smallest_kept: 1.0,
            largest_dropped: 0.0,
        },
    };
    let sample = match sample(dag, model, linear, &parameters) {
        Ok(sample) => sample,
        Err(no_number) => {
            base.rank = RankStatus::NoNumber(no_number);
            return base;
        }
    };
    let mut reduction = Reduction::new(&sample);
    for k in order::of_choice(&parameters, &sample) {
        if is_fixed(&k) {
            continue;
        }
        match &sample.columns[k] {
            Some(column) if !column.values.is_empty() => {
                reduction.offer(k, column, &parameters[k].name);
            }
            Some(column) if column.is_asleep && !sample.is_analytic[k] => {
                base.asleep.push(k);
                reduction.combinations.insert(k, vec![(k, 1.0)]);
            }
            _ => base.unidentifiable.push(k),
        }
    }
    base.rank = reduction.status();
    // Inside a combination the kept one leads.
    for (k, mut combination) in reduction.combinations {
        combination[1..].sort_unstable_by_key(|&(k, _)| k);
        base.kept.push(k);
        base.combinations.push(combination);
    }
    base.unidentifiable.sort_unstable();
    base.asleep.sort_unstable();
    base.names = names::base_names(model, &parameters, &base.kept, &base.combinations);
    base
}

/// The scan over the columns.
struct Reduction<'a> {
    sample: &'a Sample,
    selection: Selection,
    /// Columns of the selection's basis.
    basis: Vec<usize>,
    /// Per kept parameter its combination.
    combinations: BTreeMap<usize, Vec<(usize, f64)>>,
    unclear: Vec<UnclearColumn>,
    smallest_kept: f64,
    largest_dropped: f64,
}

impl<'a> Reduction<'a> {
    fn new(sample: &'a Sample) -> Self {
        Self {
            sample,
            selection: Selection::default(),
            basis: Vec::new(),
            combinations: BTreeMap::new(),
            unclear: Vec::new(),
            smallest_kept: 1.0,
            largest_dropped: 0.0,
        }
    }

    fn offer(&mut self, k: usize, column: &Column, name: &str) {
        match self.selection.offer(&column.values) {
            Offer::Kept(residual) => {
                if residual < INDEPENDENT_ABOVE {
                    let name = name.to_owned();
                    self.unclear.push(UnclearColumn { name, residual });
                }
                self.smallest_kept = self.smallest_kept.min(residual);
                self.basis.push(k);
                self.combinations.insert(k, vec![(k, 1.0)]);
            }
            Offer::Dependent(dependence) => {
                if !self.sample.is_analytic[k] && !self.holds_at_every_state(column, &dependence) {
                    self.combinations.insert(k, vec![(k, 1.0)]);
                    return;
                }
                self.largest_dropped = self.largest_dropped.max(dependence.residual);
                for (kept, coefficient) in self.coefficients(column, &dependence) {
                    let combination = self.combinations.entry(kept);
                    combination.or_default().push((k, coefficient));
                }
            }
        }
    }

    fn column(&self, k: usize) -> &'a Column {
        let column = self.sample.columns[k].as_ref();
        column.expect("a column of the basis has values")
    }

    /// Whether the combination is the column in proportion to what both are at each state, at more states than any
    /// combination of so many columns would be.
    fn holds_at_every_state(&self, column: &Column, dependence: &Dependence) -> bool {
        /// Coefficients are known to far more digits; laws that differ do so by far more where they do.
        const ALIKE: f64 = 1e-6;
        /// Of the largest entry of its row: rounding.
        const NOTHING: f64 = 1e-13;
        let terms: Vec<(f64, &[f64])> = self
            .basis
            .iter()
            .zip(&dependence.weights)
            .filter(|(_, (weight, error))| weight.abs() > *error)
            .map(|(&k, &(weight, _))| (weight, self.column(k).values.as_slice()))
            .collect();
        let awake = column.values.iter().filter(|x| **x != 0.0).count();
        awake > 2 * terms.len() + 2
            && column.values.iter().enumerate().all(|(row, &wanted)| {
                let parts = terms.iter().map(|(weight, values)| weight * values[row]);
                let size = wanted.abs() + parts.clone().map(f64::abs).sum::<f64>();
                (wanted - parts.sum::<f64>()).abs() <= ALIKE * size + NOTHING
            })
    }

    /// Coefficients in the units of the parameters, with no more digits than they are known to.
    fn coefficients(&self, column: &Column, dependence: &Dependence) -> Vec<(usize, f64)> {
        /// Geometry is written with fewer digits than this.
        const DIGITS: f64 = 1e-12;
        /// Up to which a weight may be taken for nothing. Errors of weights may be large where those of the combination are
        /// not: they belong together, and to leave out some parts them. So it is tried from the most generous to none.
        const NOTHING: [f64; 3] = [1e-9, DIGITS, 0.0];
        let rounded = |nothing: f64| -> Vec<(usize, f64, f64)> {
            let weights = self.basis.iter().zip(&dependence.weights);
            weights
                .filter(|(_, (weight, error))| weight.abs() > error.min(nothing))
                .map(|(&kept, &(weight, error))| {
                    let unit = column.scale / self.column(kept).scale;
                    let tolerance = error.max(DIGITS * weight.abs()).min(DIGITS).min(nothing);
                    let coefficient = shortest(weight * unit, tolerance * unit);
                    (kept, coefficient, coefficient / unit)
                })
                .collect()
        };
        let residual = |terms: &[(usize, f64, f64)]| {
            let mut left = column.values.clone();
            for &(kept, _, weight) in terms {
                let values = &self.column(kept).values;
                left.iter_mut()
                    .zip(values)
                    .for_each(|(x, y)| *x -= weight * y);
            }
            norm(&left)
        };
        let size: f64 = dependence
            .weights
            .iter()
            .map(|(weight, _)| weight.abs())
            .sum();
        let good_enough = 4.0 * dependence.residual + DIGITS * (1.0 + size);
        let [generous, digits, none] = NOTHING.map(rounded);
        let chosen = [generous, digits]
            .into_iter()
            .find(|terms| residual(terms) <= good_enough)
            .unwrap_or(none);
        chosen.into_iter().map(|(kept, c, _)| (kept, c)).collect()
    }

    /// How clear the decisions were.
    fn status(&self) -> RankStatus {
        if self.unclear.is_empty() {
            RankStatus::Clear {
                smallest_kept: self.smallest_kept,
                largest_dropped: self.largest_dropped,
            }
        } else {
            RankStatus::Unclear(self.unclear.clone())
        }
    }
}

/// A value for every shape parameter of the declared effects: the spec's, else the geometric middle of its range.
#[must_use]
pub fn shape_values(model: &Model) -> Vec<f64> {
    model
        .effects
        .iter()
        .flat_map(|effect| {
            effect
                .shapes
                .iter()
                .zip(&effect.definition.shapes)
                .map(|(value, shape)| value.unwrap_or_else(|| middle(shape.low, shape.high)))
        })
        .collect()
}

/// Geometric middle of a range of positive numbers, arithmetic middle of any other.
#[must_use]
pub fn middle(low: f64, high: f64) -> f64 {
    if low > 0.0 && high > 0.0 {
        (low * high).sqrt()
    } else {
        f64::midpoint(low, high)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[expect(clippy::float_cmp, reason = "digits are kept, or the fewest taken")]
    fn sums_have_the_fewest_digits_and_given_numbers_their_own() {
        let base = BaseForm {
            kept: vec![0, 1],
            names: vec!["a".to_owned(), "b".to_owned()],
            combinations: vec![vec![(0, 1.0), (1, 0.5), (2, 1.0)], vec![(3, 1.0)]],
            unidentifiable: Vec::new(),
            asleep: Vec::new(),
            fixed: Vec::new(),
            rank: RankStatus::Clear {
                smallest_kept: 1.0,
                largest_dropped: 0.0,
            },
        };
        let given = 0.1 + 0.2;
        assert_eq!(given, 0.300_000_000_000_000_04);
        assert_eq!(base.beta(&[0.1, 0.4, 0.05, given]), [0.35, given]);
    }
}
