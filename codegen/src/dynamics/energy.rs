//! Energies that are linear in parameters: `T = sum kinetic_k * p_k`, `V = sum potential_k * p_k`.
//!
//! In: the energies of a spec. Out: [`EnergyForm`], one term a standard parameter. Source of the idea: Gautier and Khalil
//! 1988, energy functions of the standard parameters.

use robot_model_spec::model::{Energies, EnergyExpr, Function as SpecFunction, Monomial};
use robot_model_spec::polynomial::{Ring, expand, expand_bindings, expand_energies};

use super::lower::expression_function;
use crate::expr::{Dag, ExprId, Symbol};

/// What one parameter contributes to the energies, per unit of the parameter.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct EnergyTerm {
    /// Index of the standard parameter whose symbol stands in the products.
    pub parameter: usize,
    /// Its part of the kinetic energy; quadratic in the rates.
    pub kinetic: ExprId,
    /// Its part of the potential energy; free of rates.
    pub potential: ExprId,
}

/// Kinetic and potential energy as linear forms.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct EnergyForm {
    /// One term a parameter; parameters without a term have no energy.
    pub terms: Vec<EnergyTerm>,
}

impl EnergyForm {
    /// `(T, V)` with an expression for every standard parameter.
    pub fn energies(&self, dag: &mut Dag, parameters: &[ExprId]) -> (ExprId, ExprId) {
        let mut sum = |part: fn(&EnergyTerm) -> ExprId| {
            let mut total = dag.zero();
            for term in &self.terms {
                let energy = dag.mul(parameters[term.parameter], part(term));
                total = dag.add(total, energy);
            }
            total
        };
        (sum(|term| term.kinetic), sum(|term| term.potential))
    }
}

/// The energies of a spec as it writes them.
pub fn written(dag: &mut Dag, energies: &Energies, dof: usize) -> EnergyForm {
    let expanded = expand_energies(&mut Coefficients { dag, dof }, energies)
        .expect("checked in model-spec: energies are polynomials in the parameters");
    let zero = dag.zero();
    let terms = energies.monomials.iter().enumerate();
    EnergyForm {
        terms: terms
            .map(|(parameter, monomial)| EnergyTerm {
                parameter,
                kinetic: expanded.kinetic.get(monomial).copied().unwrap_or(zero),
                potential: expanded.potential.get(monomial).copied().unwrap_or(zero),
            })
            .collect(),
    }
}

/// Positions of the points of a spec, each binding put in once. What parameters and rates a position is written with cancel.
pub fn positions(dag: &mut Dag, energies: &Energies, dof: usize) -> Vec<[ExprId; 3]> {
    const CHECKED: &str = "checked in model-spec: positions are polynomials in the parameters";
    let ring = &mut Coefficients { dag, dof };
    let bindings = expand_bindings(ring, energies).expect(CHECKED);
    let mut coordinate = |expr: &EnergyExpr| {
        let position = expand(ring, expr, &bindings).expect(CHECKED);
        let known = position.get(&Monomial::one());
        known.copied().unwrap_or_else(|| ring.dag.zero())
    };
    let points = energies.points.iter();
    points
        .map(|point| [0, 1, 2].map(|axis| coordinate(&point.position[axis])))
        .collect()
}

/// Coefficients as expressions of coordinates and rates.
struct Coefficients<'a> {
    dag: &'a mut Dag,
    dof: usize,
}

impl Ring for Coefficients<'_> {
    type Element = ExprId;

    fn number(&mut self, value: f64) -> ExprId {
        self.dag.constant(value)
    }

    fn as_number(&self, x: &ExprId) -> Option<f64> {
        self.dag.as_constant(*x)
    }

    fn coordinate(&mut self, joint: usize) -> ExprId {
        self.dag.symbol(Symbol::Q(joint))
    }

    fn rate(&mut self, joint: usize) -> ExprId {
        self.dag.symbol(Symbol::Dq(joint))
    }

    fn add(&mut self, x: &ExprId, y: &ExprId) -> ExprId {
        self.dag.add(*x, *y)
    }

    fn mul(&mut self, x: &ExprId, y: &ExprId) -> ExprId {
        self.dag.mul(*x, *y)
    }

    fn power(&mut self, x: &ExprId, y: &ExprId) -> Option<ExprId> {
        Some(self.dag.power(*x, *y))
    }

    fn call(&mut self, function: SpecFunction, x: &ExprId) -> Option<ExprId> {
        Some(self.dag.call(expression_function(function), *x))
    }

    fn derivative(&mut self, x: &ExprId) -> Option<ExprId> {
        let mut rate = self.dag.zero();
        for joint in 0..self.dof {
            let slope = self.dag.derivative(*x, Symbol::Q(joint));
            let dq = self.dag.symbol(Symbol::Dq(joint));
            let part = self.dag.mul(slope, dq);
            rate = self.dag.add(rate, part);
        }
        Some(rate)
    }

    fn is_zero(&self, x: &ExprId) -> bool {
        self.dag.is_zero(*x)
    }
}
