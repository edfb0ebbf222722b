//! The kinetic energy is quadratic in the rates of the coordinates, the potential energy is free of them.

use super::monomials::{Coefficient, number};
use super::{Checked, Fault, Statement};
use crate::model::{BinaryOp, EnergyExpr, EnergyLeaf, Expr};
use crate::polynomial::{Polynomial, whole};

/// Degree in the rates of an expression whose terms all have the same one; `None` for zero, which has any.
pub(super) type Degree = Option<u32>;

/// The degree of a statement; `bindings` are those of the bindings before it, and `expanded` what these are.
pub(super) fn degree(
    statement: Statement,
    value: &EnergyExpr,
    bindings: &[Degree],
    expanded: &[Polynomial<Coefficient>],
) -> Checked<Degree> {
    let mut analysis = Analysis {
        statement,
        bindings,
        expanded,
        path: Vec::new(),
    };
    analysis.degree(value)
}

struct Analysis<'a> {
    statement: Statement,
    bindings: &'a [Degree],
    expanded: &'a [Polynomial<Coefficient>],
    path: Vec<usize>,
}

impl Analysis<'_> {
    fn degree(&mut self, expr: &EnergyExpr) -> Checked<Degree> {
        match expr {
            Expr::Number(value) if *value == 0.0 => Ok(None),
            Expr::Number(_) => Ok(Some(0)),
            Expr::Leaf(leaf) => self.leaf(*leaf),
            Expr::Neg(x) => self.operand(0, x),
            Expr::Call(_, x) => match self.operand(0, x)? {
                None | Some(0) => Ok(Some(0)),
                Some(_) => Err(self.fault(
                    "a rate stands inside a function",
                    "energies are quadratic in the rates",
                )),
            },
            Expr::Binary(op, x, y) => {
                let (left, right) = (self.operand(0, x)?, self.operand(1, y)?);
                self.binary(*op, y, left, right)
            }
            Expr::Min(..) | Expr::Max(..) | Expr::Choice(_) => {
                unreachable!("checked in energies::resolve: energies are smooth")
            }
        }
    }

    fn operand(&mut self, index: usize, expr: &EnergyExpr) -> Checked<Degree> {
        self.path.push(index);
        let degree = self.degree(expr)?;
        self.path.pop();
        Ok(degree)
    }

    fn leaf(&self, leaf: EnergyLeaf) -> Checked<Degree> {
        match leaf {
            EnergyLeaf::Coordinate(_) | EnergyLeaf::Parameter(_) => Ok(Some(0)),
            EnergyLeaf::Rate(_) => Ok(Some(1)),
            EnergyLeaf::Binding(k) => Ok(self.bindings[k]),
            EnergyLeaf::BindingRate(k) => match self.bindings[k] {
                None | Some(0) => Ok(Some(1)),
                Some(_) => Err(self.fault(
                    "the rate of a value that has rates in it",
                    "would be an acceleration",
                )),
            },
        }
    }

    fn binary(&self, op: BinaryOp, right: &EnergyExpr, x: Degree, y: Degree) -> Checked<Degree> {
        match op {
            BinaryOp::Add | BinaryOp::Sub => match (x, y) {
                (None, other) | (other, None) => Ok(other),
                (Some(x), Some(y)) if x == y => Ok(Some(x)),
                (Some(x), Some(y)) => Err(self.fault(
                    &format!("terms of degree {x} and {y} in the rates do not add up to an energy"),
                    "different degrees",
                )),
            },
            BinaryOp::Mul => Ok(x.zip(y).map(|(x, y)| x + y)),
            BinaryOp::Div if y.is_none_or(|y| y == 0) => Ok(x),
            BinaryOp::Div => Err(self.fault(
                "a rate stands in a denominator",
                "energies are quadratic in the rates",
            )),
            BinaryOp::Pow if x.is_none_or(|x| x == 0) && y.is_none_or(|y| y == 0) => Ok(Some(0)),
            BinaryOp::Pow => {
                let exponent = number(right, self.expanded).and_then(|value| whole(value, 16));
                match (x, exponent) {
                    (Some(x), Some(k)) if k > 0 => Ok(Some(x * k.unsigned_abs())),
                    _ => Err(self.exponent()),
                }
            }
        }
    }

    fn exponent(&self) -> Box<Fault> {
        self.fault(
            "a rate stands under or in an exponent that is not a small whole number",
            "energies are quadratic in the rates",
        )
    }

    #[track_caller]
    fn fault(&self, message: &str, label: &str) -> Box<Fault> {
        Fault::new(
            self.statement,
            self.path.clone(),
            message,
            label,
            "write the kinetic energy as a sum of products of two rates, and the potential energy without rates",
        )
    }
}
