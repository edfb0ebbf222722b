//! Energies are sums of products of parameters: which products there are.

use super::{Checked, Fault, Statement};
use crate::check::resolve::NOT_COMPUTABLE;
use crate::model::{EnergyExpr, EnergyLeaf, Function, Monomial};
use crate::polynomial::{self, NotPolynomial, Polynomial, Reason, Ring};
use crate::transform::{LARGEST, LARGEST_EXPONENT};

/// What the check needs to know of a coefficient.
#[derive(Debug, Clone, Copy)]
pub(super) struct Coefficient {
    /// Its value, where it is a number.
    number: Option<f64>,
    /// Whether it changes when the robot moves.
    varies: bool,
    /// Whether no number that it is made of is beyond what can be computed with.
    is_computable: bool,
}

/// The ring of what may change and what does not. A sum of two coefficients counts as one that is not zero.
struct Structure;

impl Ring for Structure {
    type Element = Coefficient;

    fn number(&mut self, value: f64) -> Coefficient {
        Coefficient {
            number: Some(value),
            varies: false,
            is_computable: true,
        }
    }

    fn as_number(&self, x: &Coefficient) -> Option<f64> {
        x.number
    }

    fn coordinate(&mut self, _: usize) -> Coefficient {
        VARYING
    }

    fn rate(&mut self, _: usize) -> Coefficient {
        VARYING
    }

    fn add(&mut self, x: &Coefficient, y: &Coefficient) -> Coefficient {
        both(x, y, |x, y| x + y)
    }

    fn mul(&mut self, x: &Coefficient, y: &Coefficient) -> Coefficient {
        both(x, y, |x, y| x * y)
    }

    fn power(&mut self, x: &Coefficient, y: &Coefficient) -> Option<Coefficient> {
        let is_steep = x.varies && y.number.is_some_and(|y| y.abs() > LARGEST_EXPONENT);
        let power = computable(both(x, y, f64::powf));
        power.filter(|_| !is_steep)
    }

    fn call(&mut self, function: Function, x: &Coefficient) -> Option<Coefficient> {
        computable(Coefficient {
            number: x.number.map(|x| function.apply(x)),
            ..*x
        })
    }

    fn derivative(&mut self, x: &Coefficient) -> Option<Coefficient> {
        Some(if x.varies { VARYING } else { self.number(0.0) })
    }

    fn is_zero(&self, x: &Coefficient) -> bool {
        x.number == Some(0.0)
    }
}

const VARYING: Coefficient = Coefficient {
    number: None,
    varies: true,
    is_computable: true,
};

/// None for a number that is none, or too large to compute with.
fn computable(x: Coefficient) -> Option<Coefficient> {
    (x.is_computable && is_computable(x.number)).then_some(x)
}

fn is_computable(number: Option<f64>) -> bool {
    number.is_none_or(|number| number.abs() <= LARGEST)
}

fn both(x: &Coefficient, y: &Coefficient, combine: impl Fn(f64, f64) -> f64) -> Coefficient {
    let number = x.number.zip(y.number).map(|(x, y)| combine(x, y));
    Coefficient {
        number,
        varies: x.varies || y.varies,
        is_computable: x.is_computable && y.is_computable && is_computable(number),
    }
}

/// Expands one statement; later ones may use it.
pub(super) fn expand(
    statement: Statement,
    value: &EnergyExpr,
    bindings: &[Polynomial<Coefficient>],
) -> Checked<Polynomial<Coefficient>> {
    let expanded = polynomial::expand(&mut Structure, value, bindings)
        .map_err(|error| fault(statement, error))?;
    // Sums and products have no place to refuse.
    if expanded.values().all(|x| computable(*x).is_some()) {
        return Ok(expanded);
    }
    Err(not_computable(statement, Vec::new()))
}

/// The value of an expression that is made of numbers and of bindings that are numbers.
pub(super) fn number(expr: &EnergyExpr, bindings: &[Polynomial<Coefficient>]) -> Option<f64> {
    expr.number(&|leaf| match leaf {
        EnergyLeaf::Binding(k) => match bindings[*k].iter().collect::<Vec<_>>().as_slice() {
            [] => Some(0.0),
            [(monomial, coefficient)] if monomial.is_one() => coefficient.number,
            _ => None,
        },
        _ => None,
    })
}

/// The products in both energies, lowest degree first, then in the order of the parameters. A constant part of the
/// potential energy has no torque.
pub(super) fn monomials(
    kinetic: &Polynomial<Coefficient>,
    potential: &Polynomial<Coefficient>,
) -> Vec<Monomial> {
    let felt = potential.iter().filter(|(_, value)| value.varies);
    let mut monomials: Vec<Monomial> = kinetic.iter().chain(felt).map(|(m, _)| m.clone()).collect();
    monomials.sort_by(|x, y| (x.degree(), x).cmp(&(y.degree(), y)));
    monomials.dedup();
    monomials
}

fn fault(statement: Statement, NotPolynomial { reason, path }: NotPolynomial) -> Box<Fault> {
    let not_linear = "the energy is not linear in products of parameters here";
    match reason {
        Reason::InsideFunction => Fault::new(
            statement,
            path,
            "an unknown parameter stands inside a function",
            not_linear,
            "make it a constant, or write the energy as a sum of products of parameters",
        ),
        Reason::Denominator => Fault::new(
            statement,
            path,
            "a sum of unknown parameters stands in a denominator",
            not_linear,
            "make them constants, or give the quotient a parameter of its own",
        ),
        Reason::Power => Fault::new(
            statement,
            path,
            "an unknown parameter has an exponent that is not a small whole number",
            not_linear,
            "write a whole exponent between -16 and 16, or give the power a parameter of its own",
        ),
        Reason::TooMany => Fault::new(
            statement,
            path,
            "the energy has too many products of parameters",
            "more than the compiler takes",
            "give sums of parameters a parameter of their own",
        ),
        Reason::OutsideRing => not_computable(statement, path),
    }
}

fn not_computable(statement: Statement, path: Vec<usize>) -> Box<Fault> {
    Fault::new(
        statement,
        path,
        "this is not a finite number, or too large to compute with",
        "wherever the robot is",
        NOT_COMPUTABLE,
    )
}
