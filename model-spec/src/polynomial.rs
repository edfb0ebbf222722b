//! Energies as polynomials in the unknown parameters: which products of parameters there are, and what stands before each.
//!
//! One traversal serves all who ask: the check, which only wants to know which products occur, and the compiler, for which
//! coefficients are expressions. They differ in the [`Ring`] of the coefficients.

use std::collections::BTreeMap;

use crate::model::{BinaryOp, Energies, EnergyExpr, EnergyLeaf, Expr, Function, Monomial};

/// More products than a robot has that a person wrote down.
pub const MOST_MONOMIALS: usize = 2000;

/// More products of terms than the expansion of one expression takes: beyond this a spec would compile for minutes.
const MOST_TERMS: usize = 50_000;

/// The largest power of a sum of parameters.
const LARGEST_POWER: i32 = 16;

/// The whole number that `value` is, up to rounding, if its magnitude is at most `largest`.
#[must_use]
pub fn whole(value: f64, largest: i32) -> Option<i32> {
    (-largest..=largest).find(|k| (f64::from(*k) - value).abs() < 1e-12)
}

/// Coefficients: what is left of an expression when the parameters are taken out. `None` where a ring has no such element.
pub trait Ring {
    /// A coefficient.
    type Element: Clone;
    /// A number.
    fn number(&mut self, value: f64) -> Self::Element;
    /// The number, if the element is one.
    fn as_number(&self, x: &Self::Element) -> Option<f64>;
    /// A coordinate.
    fn coordinate(&mut self, joint: usize) -> Self::Element;
    /// The rate of a coordinate.
    fn rate(&mut self, joint: usize) -> Self::Element;
    /// `x + y`
    fn add(&mut self, x: &Self::Element, y: &Self::Element) -> Self::Element;
    /// `x * y`
    fn mul(&mut self, x: &Self::Element, y: &Self::Element) -> Self::Element;
    /// `x ^ y`
    fn power(&mut self, x: &Self::Element, y: &Self::Element) -> Option<Self::Element>;
    /// `f(x)`
    fn call(&mut self, function: Function, x: &Self::Element) -> Option<Self::Element>;
    /// `dx/dt`; zero where `x` does not change.
    fn derivative(&mut self, x: &Self::Element) -> Option<Self::Element>;
    /// Whether the element is zero.
    fn is_zero(&self, x: &Self::Element) -> bool;
}

/// A sum of products of parameters with coefficients.
pub type Polynomial<Element> = BTreeMap<Monomial, Element>;

/// Why an expression is no polynomial in the parameters, and which part of it: a path of operands from the whole.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct NotPolynomial {
    /// What keeps it from being one.
    pub reason: Reason,
    /// The offending part.
    pub path: Vec<usize>,
}

/// What keeps an expression from being a polynomial in the parameters.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Reason {
    /// A parameter inside a function.
    InsideFunction,
    /// A sum with parameters in a denominator.
    Denominator,
    /// A parameter in an exponent, or under a power that is not whole.
    Power,
    /// More products than [`MOST_MONOMIALS`], or more work than finding them is worth.
    TooMany,
    /// The ring has no such coefficient.
    OutsideRing,
}

/// Both energies and the points, with the bindings put in.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Expanded<Element> {
    /// Per binding.
    pub bindings: Vec<Polynomial<Element>>,
    /// Kinetic energy.
    pub kinetic: Polynomial<Element>,
    /// Potential energy.
    pub potential: Polynomial<Element>,
}

/// Expands the energies of a robot.
///
/// # Errors
/// A coefficient that the ring does not have; after `check`, nothing else.
pub fn expand_energies<R: Ring>(
    ring: &mut R,
    energies: &Energies,
) -> Result<Expanded<R::Element>, NotPolynomial> {
    let bindings = expand_bindings(ring, energies)?;
    Ok(Expanded {
        kinetic: expand(ring, &energies.kinetic, &bindings)?,
        potential: expand(ring, &energies.potential, &bindings)?,
        bindings,
    })
}

/// Expands the bindings of a robot, each with those before it.
///
/// # Errors
/// As [`expand_energies`].
pub fn expand_bindings<R: Ring>(
    ring: &mut R,
    energies: &Energies,
) -> Result<Vec<Polynomial<R::Element>>, NotPolynomial> {
    let mut bindings = Vec::new();
    for binding in &energies.bindings {
        let value = expand(ring, &binding.value, &bindings)?;
        bindings.push(value);
    }
    Ok(bindings)
}

/// Expands one expression whose bindings are expanded already.
///
/// # Errors
/// See [`Reason`].
pub fn expand<R: Ring>(
    ring: &mut R,
    expr: &EnergyExpr,
    bindings: &[Polynomial<R::Element>],
) -> Result<Polynomial<R::Element>, NotPolynomial> {
    let mut expansion = Expansion {
        ring,
        bindings,
        path: Vec::new(),
        terms: 0,
    };
    expansion.expand(expr)
}

struct Expansion<'a, R: Ring> {
    ring: &'a mut R,
    bindings: &'a [Polynomial<R::Element>],
    path: Vec<usize>,
    /// Products of two terms so far.
    terms: usize,
}

type Expanding<R> = Result<Polynomial<<R as Ring>::Element>, NotPolynomial>;

impl<R: Ring> Expansion<'_, R> {
    fn expand(&mut self, expr: &EnergyExpr) -> Expanding<R> {
        match expr {
            Expr::Number(value) => {
                let number = self.ring.number(*value);
                Ok(self.free(number))
            }
            Expr::Leaf(leaf) => self.leaf(*leaf),
            Expr::Neg(x) => {
                let x = self.operand(0, x)?;
                let minus = self.ring.number(-1.0);
                let minus = self.free(minus);
                self.product(&minus, &x)
            }
            Expr::Binary(op, x, y) => {
                let (x, y) = (self.operand(0, x)?, self.operand(1, y)?);
                self.binary(*op, x, &y)
            }
            Expr::Min(..) | Expr::Max(..) | Expr::Choice(_) => {
                unreachable!("checked in energies::resolve: energies are smooth")
            }
            Expr::Call(function, x) => {
                let x = self.operand(0, x)?;
                let x = self.coefficient(x, Reason::InsideFunction)?;
                let value = self.ring.call(*function, &x);
                self.known(value)
            }
        }
    }

    fn operand(&mut self, index: usize, expr: &EnergyExpr) -> Expanding<R> {
        self.path.push(index);
        let value = self.expand(expr)?;
        self.path.pop();
        Ok(value)
    }

    fn leaf(&mut self, leaf: EnergyLeaf) -> Expanding<R> {
        Ok(match leaf {
            EnergyLeaf::Coordinate(joint) => {
                let coordinate = self.ring.coordinate(joint);
                self.free(coordinate)
            }
            EnergyLeaf::Rate(joint) => {
                let rate = self.ring.rate(joint);
                self.free(rate)
            }
            EnergyLeaf::Parameter(k) => {
                let one = self.ring.number(1.0);
                Polynomial::from([(Monomial::of(k), one)])
            }
            EnergyLeaf::Binding(k) => self.bindings[k].clone(),
            EnergyLeaf::BindingRate(k) => {
                let mut rate = Polynomial::new();
                for (monomial, coefficient) in &self.bindings[k] {
                    let derivative = self.ring.derivative(coefficient);
                    let derivative = derivative.ok_or_else(|| self.refuse(Reason::OutsideRing))?;
                    if !self.ring.is_zero(&derivative) {
                        rate.insert(monomial.clone(), derivative);
                    }
                }
                rate
            }
        })
    }

    fn binary(
        &mut self,
        op: BinaryOp,
        x: Polynomial<R::Element>,
        y: &Polynomial<R::Element>,
    ) -> Expanding<R> {
        match op {
            BinaryOp::Add => self.sum(x, y),
            BinaryOp::Sub => {
                let minus = self.ring.number(-1.0);
                let minus = self.free(minus);
                let y = self.product(&minus, y)?;
                self.sum(x, &y)
            }
            BinaryOp::Mul => self.product(&x, y),
            BinaryOp::Div => {
                let y = self.reciprocal(y)?;
                self.product(&x, &y)
            }
            BinaryOp::Pow => self.power(x, y.clone()),
        }
    }

    fn sum(&mut self, mut x: Polynomial<R::Element>, y: &Polynomial<R::Element>) -> Expanding<R> {
        for (monomial, coefficient) in y {
            self.accumulate(&mut x, monomial.clone(), coefficient.clone());
        }
        self.limited(x)
    }

    fn product(&mut self, x: &Polynomial<R::Element>, y: &Polynomial<R::Element>) -> Expanding<R> {
        self.terms += x.len().saturating_mul(y.len());
        if self.terms > MOST_TERMS {
            return Err(self.refuse(Reason::TooMany));
        }
        let mut product = Polynomial::new();
        for (left, a) in x {
            for (right, b) in y {
                let coefficient = self.ring.mul(a, b);
                self.accumulate(&mut product, left.times(right), coefficient);
            }
        }
        self.limited(product)
    }

    fn accumulate(
        &mut self,
        sum: &mut Polynomial<R::Element>,
        monomial: Monomial,
        coefficient: R::Element,
    ) {
        let total = match sum.get(&monomial) {
            Some(before) => self.ring.add(before, &coefficient),
            None => coefficient,
        };
        if self.ring.is_zero(&total) {
            sum.remove(&monomial);
        } else {
            sum.insert(monomial, total);
        }
    }

    fn reciprocal(&mut self, x: &Polynomial<R::Element>) -> Expanding<R> {
        let (monomial, coefficient) = match x.len() {
            0 => (Monomial::one(), self.ring.number(0.0)),
            1 => {
                let (monomial, coefficient) = x.first_key_value().expect("it has one term");
                (monomial.clone(), coefficient.clone())
            }
            _ => return Err(self.refuse(Reason::Denominator)),
        };
        let minus_one = self.ring.number(-1.0);
        let reciprocal = self.ring.power(&coefficient, &minus_one);
        let reciprocal = reciprocal.ok_or_else(|| self.refuse(Reason::OutsideRing))?;
        Ok(Polynomial::from([(monomial.power(-1), reciprocal)]))
    }

    fn power(
        &mut self,
        x: Polynomial<R::Element>,
        exponent: Polynomial<R::Element>,
    ) -> Expanding<R> {
        let exponent = self.coefficient(exponent, Reason::Power)?;
        if x.keys().all(Monomial::is_one) {
            let x = self.coefficient(x, Reason::Power)?;
            let value = self.ring.power(&x, &exponent);
            return self.known(value);
        }
        let exponent = self
            .ring
            .as_number(&exponent)
            .and_then(|number| whole(number, LARGEST_POWER))
            .ok_or_else(|| self.refuse(Reason::Power))?;
        let base = if exponent < 0 {
            self.reciprocal(&x)?
        } else {
            x
        };
        let one = self.ring.number(1.0);
        let mut power = self.free(one);
        for _ in 0..exponent.unsigned_abs() {
            power = self.product(&power, &base)?;
        }
        Ok(power)
    }

    /// The value of an expression without parameters.
    fn coefficient(
        &mut self,
        x: Polynomial<R::Element>,
        reason: Reason,
    ) -> Result<R::Element, NotPolynomial> {
        let mut terms = x.into_iter();
        match (terms.next(), terms.next()) {
            (None, _) => Ok(self.ring.number(0.0)),
            (Some((monomial, coefficient)), None) if monomial.is_one() => Ok(coefficient),
            _ => Err(self.refuse(reason)),
        }
    }

    fn known(&mut self, value: Option<R::Element>) -> Expanding<R> {
        let value = value.ok_or_else(|| self.refuse(Reason::OutsideRing))?;
        Ok(self.free(value))
    }

    /// An expression without parameters.
    fn free(&self, x: R::Element) -> Polynomial<R::Element> {
        if self.ring.is_zero(&x) {
            Polynomial::new()
        } else {
            Polynomial::from([(Monomial::one(), x)])
        }
    }

    fn limited(&self, x: Polynomial<R::Element>) -> Expanding<R> {
        if x.len() > MOST_MONOMIALS {
            return Err(self.refuse(Reason::TooMany));
        }
        Ok(x)
    }

    fn refuse(&self, reason: Reason) -> NotPolynomial {
        NotPolynomial {
            reason,
            path: self.path.clone(),
        }
    }
}
