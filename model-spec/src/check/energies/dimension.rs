//! Dimensions of energies: every sum has terms of one dimension, every function a plain number, every energy is an energy.
//!
//! Parameters and constants without a unit have unknown dimensions. They are inferred: each rule is a linear equation
//! between exponents, and only a contradiction is a mistake. Angles count as plain numbers, as they do in energies.

use super::monomials::{Coefficient, number};
use super::resolve::Resolved;
use super::{Checked, Fault, Statement};
use crate::check::unit::Dimension;
use crate::model::{BinaryOp, EnergyExpr, EnergyLeaf, Expr, Function, JointKind};
use crate::polynomial::Polynomial;

/// Exponents of kg, m, s and A, with unknown dimensions as further factors: `known + sum of exponent * unknown`.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Dimensions {
    known: [f64; 4],
    /// `(unknown, exponent)`, by rising unknown; no exponent is zero.
    unknown: Vec<(usize, f64)>,
}

/// Exponents closer than this are equal; roots of roots keep them far from it.
const SAME: f64 = 1e-9;

impl Dimensions {
    /// kg m^2/s^2
    pub(super) const ENERGY: [f64; 4] = [1.0, 2.0, -2.0, 0.0];

    pub(super) fn of(dimension: Dimension) -> Self {
        let Dimension {
            mass,
            length,
            time,
            angle: _,
            current,
        } = dimension;
        Self::from_known([mass, length, time, current].map(f64::from))
    }

    pub(super) fn from_known(known: [f64; 4]) -> Self {
        Self {
            known,
            unknown: Vec::new(),
        }
    }

    fn times(&self, other: &Self, exponent: f64) -> Self {
        let mut product = self.clone();
        for (x, y) in product.known.iter_mut().zip(other.known) {
            *x += exponent * y;
        }
        for &(unknown, power) in &other.unknown {
            product.add_unknown(unknown, exponent * power);
        }
        product
    }

    fn add_unknown(&mut self, unknown: usize, power: f64) {
        match self.unknown.binary_search_by_key(&unknown, |(k, _)| *k) {
            Ok(place) => {
                self.unknown[place].1 += power;
                if self.unknown[place].1.abs() < SAME {
                    self.unknown.remove(place);
                }
            }
            Err(place) => self.unknown.insert(place, (unknown, power)),
        }
    }

    /// "kg m^2/s^2", "a plain number"
    fn describe(&self) -> String {
        let factor = |name: &str, exponent: f64| {
            if (exponent - 1.0).abs() < SAME {
                name.to_owned()
            } else {
                format!("{name}^{exponent}")
            }
        };
        let named = || ["kg", "m", "s", "A"].into_iter().zip(self.known);
        let above: Vec<String> = named()
            .filter(|(_, k)| *k > SAME)
            .map(|(name, k)| factor(name, k))
            .collect();
        let below: Vec<String> = named()
            .filter(|(_, k)| *k < -SAME)
            .map(|(name, k)| factor(name, -k))
            .collect();
        match (above.is_empty(), below.is_empty()) {
            (true, true) => "a plain number".to_owned(),
            (false, true) => above.join(" "),
            (true, false) => format!("1/{}", below.join(" ")),
            (false, false) => format!("{}/{}", above.join(" "), below.join(" ")),
        }
    }
}

/// What is known of dimensions so far.
pub(super) struct Inference {
    /// Dimensions of the coordinates.
    pub(super) coordinates: Vec<Dimensions>,
    /// Dimensions of the parameters.
    pub(super) parameters: Vec<Dimensions>,
    /// Dimensions of the bindings checked so far.
    pub(super) bindings: Vec<Dimensions>,
    unknowns: usize,
    /// Solved unknowns in terms of others, in the order they were solved.
    solved: Vec<(usize, Dimensions)>,
}

impl Inference {
    pub(super) fn new(coordinates: &[JointKind]) -> Self {
        Self {
            coordinates: coordinates
                .iter()
                .map(|kind| match kind {
                    JointKind::Revolute => Dimensions::default(),
                    JointKind::Prismatic => Dimensions::of(Dimension::LENGTH),
                })
                .collect(),
            parameters: Vec::new(),
            bindings: Vec::new(),
            unknowns: 0,
            solved: Vec::new(),
        }
    }

    /// A dimension that is not known yet.
    pub(super) fn unknown(&mut self) -> Dimensions {
        self.unknowns += 1;
        Dimensions {
            known: [0.0; 4],
            unknown: vec![(self.unknowns - 1, 1.0)],
        }
    }

    /// The dimensions of a statement's value; `expanded` are the bindings before it, some of which are numbers.
    pub(super) fn infer(
        &mut self,
        statement: Statement,
        resolved: &Resolved,
        expanded: &[Polynomial<Coefficient>],
    ) -> Checked<Dimensions> {
        Walk {
            inference: self,
            statement,
            constants: &resolved.constants,
            expanded,
            path: Vec::new(),
        }
        .infer(&resolved.value)
    }

    /// Says that a statement's value has these dimensions.
    pub(super) fn expect(
        &mut self,
        statement: Statement,
        found: &Dimensions,
        wanted: [f64; 4],
        what: &str,
    ) -> Checked<()> {
        let wanted = Dimensions::from_known(wanted);
        if self.unify(found, &wanted) {
            return Ok(());
        }
        Err(Fault::new(
            statement,
            Vec::new(),
            format!("{what} is in {}", wanted.describe()),
            format!("this is {}", self.reduced(found).describe()),
            "check the powers of masses, lengths and rates; write the unit of every constant, as in `g = 9.81 m/s^2`",
        ))
    }

    /// With what is solved put in.
    fn reduced(&self, dimensions: &Dimensions) -> Dimensions {
        let mut reduced = dimensions.clone();
        for (unknown, value) in &self.solved {
            if let Some(&(_, power)) = reduced.unknown.iter().find(|(k, _)| k == unknown) {
                reduced.add_unknown(*unknown, -power);
                reduced = reduced.times(value, power);
            }
        }
        reduced
    }

    /// Makes both the same; `false` where they contradict each other.
    fn unify(&mut self, x: &Dimensions, y: &Dimensions) -> bool {
        let difference = self.reduced(&x.times(y, -1.0));
        let Some(&(unknown, power)) = difference.unknown.last() else {
            return difference.known.iter().all(|k| k.abs() < SAME);
        };
        let mut rest = difference;
        rest.add_unknown(unknown, -power);
        let value = Dimensions::default().times(&rest, -1.0 / power);
        self.solved.push((unknown, value));
        true
    }
}

/// Dimensions of the named constants of a statement by the path where they stand.
pub(super) type Constants = std::collections::BTreeMap<Vec<usize>, Dimensions>;

struct Walk<'a> {
    inference: &'a mut Inference,
    statement: Statement,
    constants: &'a Constants,
    expanded: &'a [Polynomial<Coefficient>],
    path: Vec<usize>,
}

impl Walk<'_> {
    fn infer(&mut self, expr: &EnergyExpr) -> Checked<Dimensions> {
        match expr {
            Expr::Number(value) => match self.constants.get(&self.path) {
                Some(dimensions) => Ok(dimensions.clone()),
                // Zero is a mass, a length, anything.
                None if *value == 0.0 => Ok(self.inference.unknown()),
                None => Ok(Dimensions::default()),
            },
            Expr::Leaf(leaf) => Ok(self.leaf(*leaf)),
            Expr::Neg(x) => self.operand(0, x),
            Expr::Call(function, x) => self.call(*function, x),
            Expr::Binary(op, x, y) => {
                let left = self.operand(0, x)?;
                let right = self.operand(1, y)?;
                self.binary(*op, y, left, &right)
            }
            Expr::Min(..) | Expr::Max(..) | Expr::Choice(_) => {
                unreachable!("checked in energies::resolve: energies are smooth")
            }
        }
    }

    fn operand(&mut self, index: usize, expr: &EnergyExpr) -> Checked<Dimensions> {
        self.path.push(index);
        let dimensions = self.infer(expr)?;
        self.path.pop();
        Ok(dimensions)
    }

    fn leaf(&self, leaf: EnergyLeaf) -> Dimensions {
        let second = Dimensions::from_known([0.0, 0.0, 1.0, 0.0]);
        match leaf {
            EnergyLeaf::Coordinate(k) => self.inference.coordinates[k].clone(),
            EnergyLeaf::Rate(k) => self.inference.coordinates[k].times(&second, -1.0),
            EnergyLeaf::Parameter(k) => self.inference.parameters[k].clone(),
            EnergyLeaf::Binding(k) => self.inference.bindings[k].clone(),
            EnergyLeaf::BindingRate(k) => self.inference.bindings[k].times(&second, -1.0),
        }
    }

    fn call(&mut self, function: Function, x: &EnergyExpr) -> Checked<Dimensions> {
        let argument = self.operand(0, x)?;
        match function {
            Function::Abs => Ok(argument),
            Function::Sqrt => Ok(Dimensions::default().times(&argument, 0.5)),
            Function::Sign => Ok(Dimensions::default()),
            Function::Sin | Function::Cos | Function::Exp | Function::Tanh => {
                self.path.push(0);
                self.plain(&argument, "the argument of a function")?;
                self.path.pop();
                Ok(Dimensions::default())
            }
        }
    }

    fn binary(
        &mut self,
        op: BinaryOp,
        exponent: &EnergyExpr,
        left: Dimensions,
        right: &Dimensions,
    ) -> Checked<Dimensions> {
        match op {
            BinaryOp::Add | BinaryOp::Sub => {
                if self.inference.unify(&left, right) {
                    return Ok(left);
                }
                Err(self.terms_differ(&left, right))
            }
            BinaryOp::Mul => Ok(left.times(right, 1.0)),
            BinaryOp::Div => Ok(left.times(right, -1.0)),
            BinaryOp::Pow => {
                self.path.push(1);
                self.plain(right, "an exponent")?;
                self.path.pop();
                if let Some(exponent) = number(exponent, self.expanded) {
                    return Ok(Dimensions::default().times(&left, exponent));
                }
                self.path.push(0);
                self.plain(&left, "the base of an exponent that is not a number")?;
                self.path.pop();
                Ok(Dimensions::default())
            }
        }
    }

    fn plain(&mut self, found: &Dimensions, what: &str) -> Checked<()> {
        if self.inference.unify(found, &Dimensions::default()) {
            return Ok(());
        }
        Err(Fault::new(
            self.statement,
            self.path.clone(),
            format!("{what} is a plain number or an angle"),
            format!("this is {}", self.inference.reduced(found).describe()),
            "divide by a quantity of the same dimension",
        ))
    }

    fn terms_differ(&self, left: &Dimensions, right: &Dimensions) -> Box<Fault> {
        let at = |operand: usize| [self.path.as_slice(), &[operand]].concat();
        Fault::new(
            self.statement,
            at(0),
            "terms of different dimensions cannot be added",
            format!("this is {}", self.inference.reduced(left).describe()),
            "check which factor one of them lacks; a plain number in a product has no dimension, so write the unit of \
             every constant, as in `g = 9.81 m/s^2`",
        )
        .also(
            at(1),
            format!("this is {}", self.inference.reduced(right).describe()),
        )
    }
}
