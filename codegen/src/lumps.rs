//! Lumped parameters of a robot that says its energies: what stands before each function of the motion.
//!
//! In: the energies of a spec. Out: [`Lumps`]. Invariants gained: the lumps are independent, and the energies are sums of
//! `lump * function` with functions that do not contain parameters.
//!
//! The energies are expanded into products of rates, powers and one sine or cosine (see [`super::dynamics::fourier`]).
//! Such functions are independent, so the coefficients before them are all that any torque can tell of the parameters;
//! coefficients in proportion are one lump. This is how papers lump by hand.

mod choice;
mod function;

use std::collections::BTreeMap;

use robot_model_spec::model::{Energies, Monomial};
use robot_model_spec::polynomial::{Polynomial, expand_energies};

use crate::dynamics::energy::{EnergyForm, EnergyTerm};
use crate::dynamics::fourier::{Harmonic, Series, SeriesRing};
use crate::expr::{Dag, ExprId};
use choice::Choice;
use function::Function;

/// Lumped parameters with their energies.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Lumps {
    /// The lumps, by rising representative.
    pub lumps: Vec<Lump>,
    /// The energies, one term a lump, and one for what the spec gives in numbers.
    pub form: EnergyForm,
}

/// A combination of standard parameters that only occurs as a whole.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Lump {
    /// The standard parameter that stands for it.
    pub representative: usize,
    /// `(standard parameter, coefficient)`, ascending.
    pub combination: Vec<(usize, f64)>,
}

/// Which energy a function belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Part {
    Kinetic,
    Potential,
}

/// Coefficients of one function, one a standard parameter.
type Row = Vec<f64>;

/// Collects the lumps; `None` where the energies have functions without a series, or
/// coefficients of which it is not clear whether they are independent.
pub fn collect(dag: &mut Dag, energies: &Energies, dof: usize) -> Option<Lumps> {
    let mut ring = SeriesRing::new(dof);
    let expanded = expand_energies(&mut ring, energies).ok()?;
    if ring.is_exhausted() {
        return None;
    }
    let mut functions = function::merged(rows(energies, &expanded.kinetic, Part::Kinetic));
    functions.extend(function::merged(rows(
        energies,
        &expanded.potential,
        Part::Potential,
    )));
    let choice = Choice::of(&functions)?;

    let mut terms: Vec<EnergyTerm> = Vec::new();
    let mut lumps = Vec::new();
    for (k, combination) in choice.lumps.iter().enumerate() {
        let representative = choice.representatives[k];
        terms.push(term(dag, representative, &functions, &choice.shares[k]));
        lumps.push(Lump {
            representative,
            combination: combination
                .iter()
                .copied()
                .enumerate()
                .filter(|(_, coefficient)| *coefficient != 0.0)
                .collect(),
        });
    }
    terms.extend(known(dag, energies, &expanded.kinetic, &expanded.potential));
    lumps.sort_by_key(|lump| lump.representative);
    Some(Lumps {
        lumps,
        form: EnergyForm { terms },
    })
}

/// Per function its coefficients. Those of the kinetic energy are entries of the mass matrix: `T = 1/2 M_ii dq_i^2 + M_ij
/// dq_i dq_j + ..`
fn rows(
    energies: &Energies,
    energy: &Polynomial<Series>,
    part: Part,
) -> BTreeMap<Harmonic, (Part, Row)> {
    let mut rows = BTreeMap::new();
    for (k, monomial) in energies.monomials.iter().enumerate() {
        let series = energy.get(monomial).filter(|_| !monomial.is_one());
        for (harmonic, coefficient) in series.into_iter().flatten() {
            if part == Part::Potential && harmonic.is_still() {
                continue;
            }
            let entry = rows
                .entry(harmonic.clone())
                .or_insert_with(|| (part, vec![0.0; energies.monomials.len()]));
            entry.1[k] = coefficient.value / function::share_of_energy(harmonic);
        }
    }
    rows
}

/// The term of a lump: its share of every function.
fn term(dag: &mut Dag, parameter: usize, functions: &[Function], shares: &[f64]) -> EnergyTerm {
    let mut sum = |part: Part| -> ExprId {
        let mut energy = dag.zero();
        for (function, &share) in functions.iter().zip(shares) {
            if function.part == part && share != 0.0 {
                let value = function.energy(dag);
                let scaled = dag.scale(share, value);
                energy = dag.add(energy, scaled);
            }
        }
        energy
    };
    EnergyTerm {
        parameter,
        kinetic: sum(Part::Kinetic),
        potential: sum(Part::Potential),
    }
}

/// The term of what the spec gives in numbers.
fn known(
    dag: &mut Dag,
    energies: &Energies,
    kinetic: &Polynomial<Series>,
    potential: &Polynomial<Series>,
) -> Option<EnergyTerm> {
    let parameter = energies.monomials.iter().position(Monomial::is_one)?;
    let mut sum = |energy: &Polynomial<Series>, part: Part| {
        let mut total = dag.zero();
        let series = energy.get(&energies.monomials[parameter]);
        for (harmonic, coefficient) in series.into_iter().flatten() {
            let coefficient = coefficient.value;
            let function = Function::single(part, harmonic, Vec::new());
            let value = function.energy(dag);
            let scaled = dag.scale(coefficient / function::share_of_energy(harmonic), value);
            total = dag.add(total, scaled);
        }
        total
    };
    Some(EnergyTerm {
        parameter,
        kinetic: sum(kinetic, Part::Kinetic),
        potential: sum(potential, Part::Potential),
    })
}
