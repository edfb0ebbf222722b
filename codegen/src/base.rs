//! From standard to base parameters: the smallest set that the torque determines, with the map between both.
//!
//! In: [`LinearForm`]. Out: [`BaseForm`]. Invariants gained: the columns of the kept parameters are independent, and
//! `Y * standard = Y_b * beta` with `beta = map * standard` for every value of the standard parameters.
//!
//! Columns are compared on the regressor's values at random states (Gautier 1991 does the same): a column is kept unless it
//! is a combination of the columns kept before it, from the first link to the last. So parameters of links near the tip
//! regroup into those near the base. Inside a link, inertia is looked at first, then first moments, then the mass: so
//! coefficients are lengths and squares of lengths, never one over a length.

use std::collections::{BTreeMap, BTreeSet};

use robot_model_spec::model::Model;
use robot_model_spec::parameter::{InertialElement, Owner, StandardParameter, Status};

use crate::expr::{Dag, Symbol};
use crate::interpreter::{Operand, Program};
use crate::lumps::Lump;
use crate::random::Generator;
use crate::regressor::LinearForm;
use crate::selection::{Selection, norm};

/// A scaled column is independent of those before it when this much of it is left after projecting them out.
pub const INDEPENDENT_ABOVE: f64 = 1e-7;
/// A scaled column is a combination of those before it when no more than this is left.
pub const DEPENDENT_BELOW: f64 = 1e-10;
/// A column this much smaller than the largest is rounding: gravity along an axis that is tilted by 35 degrees, say. Columns
/// of parameters differ by squares of lengths, far less than that.
const ROUNDING: f64 = 1e-13;
/// Random states are this many times as many as the parameters, over the degrees of freedom.
const OVERSAMPLING: usize = 3;

/// The base parameters.
#[derive(Debug, Clone, PartialEq)]
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
    /// Standard parameters that the spec fixes: neither kept nor regrouped.
    pub fixed: Vec<usize>,
    /// How clear the decisions were.
    pub rank: RankStatus,
}

/// How clearly the independent columns are told from the dependent ones.
#[derive(Debug, Clone, PartialEq)]
pub enum RankStatus {
    /// Every column was on one side of the gap.
    Clear {
        /// Least that was left of a kept column.
        smallest_kept: f64,
        /// Most that was left of a dropped column.
        largest_dropped: f64,
    },
    /// Some columns were inside the gap; they are kept.
    Unclear(Vec<UnclearColumn>),
}

/// A column that is neither clearly independent nor clearly dependent.
#[derive(Debug, Clone, PartialEq)]
pub struct UnclearColumn {
    /// Name of the standard parameter.
    pub name: String,
    /// What is left of its scaled column.
    pub residual: f64,
}

impl std::fmt::Display for RankStatus {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Clear {
                smallest_kept,
                largest_dropped,
            } => write!(
                f,
                "rank is clear: least left of a kept column {smallest_kept:.1e}, most left of a dropped one {largest_dropped:.1e}"
            ),
            Self::Unclear(columns) => {
                write!(
                    f,
                    "rank is not clear between {DEPENDENT_BELOW:.0e} and {INDEPENDENT_ABOVE:.0e}:"
                )?;
                for column in columns {
                    write!(f, " `{}` has {:.1e} left", column.name, column.residual)?;
                }
                Ok(())
            }
        }
    }
}

impl BaseForm {
    /// Writes lumps as the combinations of standard parameters that they are; until here each is its representative.
    pub(crate) fn spell_out(&mut self, standard: &[StandardParameter], lumps: &[Lump]) {
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
        self.names = base_names(standard, &self.kept, &self.combinations);
        let used: BTreeSet<usize> = self
            .combinations
            .iter()
            .flatten()
            .map(|&(k, _)| k)
            .collect();
        self.unidentifiable.retain(|k| !used.contains(k));
    }

    /// `beta = map * standard`
    #[must_use]
    pub fn beta(&self, standard: &[f64]) -> Vec<f64> {
        self.combinations
            .iter()
            .map(|combination| {
                combination
                    .iter()
                    .map(|&(k, coefficient)| coefficient * standard[k])
                    .sum()
            })
            .collect()
    }
}

/// Decides which columns are independent and how the others regroup into them.
#[must_use]
pub fn reduce(dag: &Dag, model: &Model, linear: &LinearForm) -> BaseForm {
    let parameters = model.standard_parameters();
    let mut columns = sample_columns(dag, model, linear, parameters.len());
    let scale: Vec<f64> = columns.iter().map(|column| norm(column)).collect();
    for (column, &scale) in columns.iter_mut().zip(&scale) {
        for x in column {
            *x /= scale.max(f64::MIN_POSITIVE);
        }
    }

    let rounding = ROUNDING * scale.iter().fold(0.0, |largest: f64, x| largest.max(*x));
    let mut selection = Selection::default();
    let (mut unidentifiable, mut fixed) = (Vec::new(), Vec::new());
    for k in order_of_choice(&parameters) {
        let column = std::mem::take(&mut columns[k]);
        if matches!(parameters[k].status, Status::Fixed(_)) {
            fixed.push(k);
        } else if linear.column(dag, k).next().is_none() || scale[k] <= rounding {
            unidentifiable.push(k);
        } else {
            selection.take(k, column, &parameters[k].name);
        }
    }
    unidentifiable.sort_unstable();
    fixed.sort_unstable();
    let combinations = selection.combinations(&scale);
    selection.kept.sort_unstable();
    let names = base_names(&parameters, &selection.kept, &combinations);
    BaseForm {
        rank: selection.status(),
        kept: selection.kept,
        names,
        combinations,
        unidentifiable,
        fixed,
    }
}

/// The order in which columns are offered: link by link inertia, first moments, mass; then the effects'.
fn order_of_choice(parameters: &[StandardParameter]) -> Vec<usize> {
    use InertialElement::{M, Mx, My, Mz};
    let mut order: Vec<usize> = (0..parameters.len()).collect();
    order.sort_by_key(|&k| match parameters[k].owner {
        Owner::Link { link, element: M } => (link, 2),
        Owner::Link {
            link,
            element: Mx | My | Mz,
        } => (link, 1),
        Owner::Link { link, .. } => (link, 0),
        Owner::Monomial(_) => (0, 0),
        Owner::Effect { .. } => (usize::MAX, 0),
    });
    order
}

fn base_names(
    parameters: &[StandardParameter],
    kept: &[usize],
    combinations: &[Vec<(usize, f64)>],
) -> Vec<String> {
    kept.iter()
        .zip(combinations)
        .map(|(&k, combination)| {
            format!(
                "{}{}",
                parameters[k].name,
                if *combination == [(k, 1.0)] { "" } else { "r" }
            )
        })
        .collect()
}

/// One state in so many has a given joint at rest.
const REST_EVERY: usize = 7;

/// The regressor's columns at random states, stacked over joints.
fn sample_columns(dag: &Dag, model: &Model, linear: &LinearForm, count: usize) -> Vec<Vec<f64>> {
    /// Any fixed number: same spec, same states.
    const SEED: u64 = 0x726f_626f_745f_6d6f;
    let dof = model.joints.len();
    let samples = OVERSAMPLING * count.div_ceil(dof) + 16;
    let parameters = model.standard_parameters();
    let entries: Vec<(usize, usize)> = (0..count)
        .flat_map(|k| linear.column(dag, k).map(move |(joint, _)| (joint, k)))
        .collect();
    let outputs: Vec<_> = entries
        .iter()
        .map(|&(joint, k)| linear.regressor[joint][k])
        .collect();
    let program = Program::new(dag, &outputs);

    let mut generator = Generator::new(SEED);
    let shapes = generic_shapes(model, &mut generator);
    // Drawn for every symbol in a fixed order, so that a state does not depend on what the program reads.
    let mut draw = |scale: f64| -> Vec<f64> {
        (0..samples)
            .map(|_| scale * generator.symmetric())
            .collect()
    };
    let q: Vec<Vec<f64>> = (0..dof).map(|_| draw(3.0)).collect();
    let mut dq: Vec<Vec<f64>> = (0..dof).map(|_| draw(2.0)).collect();
    let ddq: Vec<Vec<f64>> = (0..dof).map(|_| draw(4.0)).collect();
    let rigid_torque: Vec<Vec<f64>> = (0..dof).map(|_| draw(10.0)).collect();
    let time: Vec<f64> = draw(20.0).into_iter().map(f64::abs).collect();
    let measured_torque: Vec<Vec<f64>> = (0..dof).map(|_| draw(10.0)).collect();
    let inputs: Vec<Vec<f64>> = model.inputs().iter().map(|_| draw(30.0)).collect();
    let states: Vec<Vec<f64>> = model.states().iter().map(|_| draw(1.0)).collect();
    // Some states have a joint at rest: laws that jump there are told from those that do not.
    for (joint, velocities) in dq.iter_mut().enumerate() {
        velocities
            .iter_mut()
            .skip(joint)
            .step_by(REST_EVERY)
            .for_each(|v| *v = 0.0);
    }
    let bind = |symbol: Symbol| match symbol {
        Symbol::Q(joint) => Operand::Column(&q[joint]),
        Symbol::Dq(joint) => Operand::Column(&dq[joint]),
        Symbol::Ddq(joint) => Operand::Column(&ddq[joint]),
        Symbol::RigidTorque(joint) => Operand::Column(&rigid_torque[joint]),
        Symbol::Time => Operand::Column(&time),
        Symbol::MeasuredTorque(joint) => Operand::Column(&measured_torque[joint]),
        Symbol::Input(k) => Operand::Column(&inputs[k]),
        Symbol::State(k) => Operand::Column(&states[k]),
        Symbol::Shape(k) => Operand::Constant(shapes[k]),
        Symbol::Parameter(_) => unreachable!("checked in regressor::linearize"),
    };
    let mut values = vec![Vec::new(); outputs.len()];
    program.eval_batch(samples, &bind, &mut values);

    let mut columns = vec![vec![0.0; samples * dof]; count];
    for (&(joint, k), values) in entries.iter().zip(values) {
        columns[k][joint * samples..(joint + 1) * samples].copy_from_slice(&values);
    }
    // A torque that acts at none of these states acts beyond them: above a limit, behind a stop. Any column stands for it,
    // since logs will tell whether it is one of its own. A body that shows nowhere has no such elsewhere.
    let is_torque = |k: usize| match parameters[k].owner {
        Owner::Effect { effect, parameter } => {
            !model.effects[effect].definition.is_of_body(parameter)
        }
        Owner::Link { .. } | Owner::Monomial(_) => false,
    };
    let silent: Vec<bool> = (0..count)
        .map(|k| is_torque(k) && columns[k].iter().all(|x| *x == 0.0))
        .collect();
    for &(joint, k) in entries.iter().filter(|(_, k)| silent[*k]) {
        for x in &mut columns[k][joint * samples..(joint + 1) * samples] {
            *x = generator.symmetric();
        }
    }
    columns
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

/// The spec's values of shape parameters, and a value without meaning inside the range for every other: no law may look like
/// another one because both stand at a special value.
fn generic_shapes(model: &Model, generator: &mut Generator) -> Vec<f64> {
    let effects = model.effects.iter();
    effects
        .flat_map(|effect| effect.shapes.iter().zip(&effect.definition.shapes))
        .map(|(value, shape)| {
            let part = 0.5 + 0.4 * generator.symmetric();
            value.unwrap_or(shape.low + part * (shape.high - shape.low))
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
