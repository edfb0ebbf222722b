//! Every coordinate has an inertia: what stands on the diagonal of the mass matrix is neither nothing nor negative.
//!
//! Only what is certain is refused. A diagonal entry is twice the kinetic energy while the other rates are zero, so each
//! coefficient knows its sign for every coordinate that moves alone.

use std::collections::BTreeSet;

use crate::ast::Robot;
use crate::check::Errors;
use crate::diagnostic::Diagnostic;
use crate::model::{Effect, EffectLeaf, Energies, Expr, Function, Monomial, Signal};
use crate::polynomial::{self, Polynomial, Ring, whole};

/// What is known of a number's sign.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Sign {
    Zero,
    /// Zero, or above it.
    Above,
    /// Zero, or below it.
    Below,
    Unknown,
}

/// A coefficient of the expanded energy.
#[derive(Debug, Clone)]
struct Coefficient {
    number: Option<f64>,
    /// The coordinates that it may change with.
    changes: BTreeSet<usize>,
    /// Its sign while this coordinate moves and no other.
    alone: Vec<Sign>,
}

/// Reports coordinates without inertia. A kinetic energy of zero is a model of statics, and meant.
pub(in crate::check) fn check_inertia(
    robot: &Robot,
    energies: &Energies,
    effects: &[Effect],
    errors: &mut Errors,
) {
    let mut signs = Signs {
        coordinates: robot.energies.coordinates.len(),
    };
    // What cannot be expanded is reported by the rules of energies.
    let Ok(expanded) = polynomial::expand_energies(&mut signs, energies) else {
        return;
    };
    if expanded.kinetic.is_empty() {
        return;
    }
    for (k, coordinate) in robot.energies.coordinates.iter().enumerate() {
        let name = &coordinate.name;
        let fault = match alone(&expanded.kinetic, energies, k) {
            Sign::Zero if !has_inertia_of_its_own(k, effects) => Diagnostic::new(
                name.span(),
                format!("coordinate `{name}` has no inertia"),
                "no kinetic energy while it moves alone",
            )
            .help(format!(
                "add the energy of what moves with it, such as `m/2*dot({name})^2`, or declare `motor_inertia on {name}`; a model \
                 of statics has `kinetic = 0;`"
            )),
            Sign::Below => Diagnostic::new(
                name.span(),
                format!("coordinate `{name}` has a negative kinetic energy"),
                "negative while it moves alone, where parameters are positive",
            )
            .help("check the signs of the terms of `kinetic`"),
            _ => continue,
        };
        errors.push(fault);
    }
}

/// Whether an effect on the coordinate reads an acceleration, as the inertia of a rotor does.
fn has_inertia_of_its_own(coordinate: usize, effects: &[Effect]) -> bool {
    let acceleration = |part: &Expr<EffectLeaf>| {
        matches!(
            part,
            Expr::Leaf(EffectLeaf::Signal(Signal::Acceleration, _))
        )
    };
    effects
        .iter()
        .filter(|effect| effect.joints.contains(&coordinate))
        .any(|effect| {
            let definition = &effect.definition;
            let torques = definition.torques.iter().map(|torque| &torque.value);
            let bindings = definition.bindings.iter().map(|binding| &binding.value);
            torques
                .chain(bindings)
                .any(|value| value.contains(&acceleration))
        })
}

/// Sign of the kinetic energy while one coordinate moves, where all parameters have the sign of their nominal values or are
/// positive.
fn alone(kinetic: &Polynomial<Coefficient>, energies: &Energies, coordinate: usize) -> Sign {
    let terms = kinetic.iter().map(|(monomial, coefficient)| {
        coefficient.alone[coordinate].times(sign_of(monomial, energies))
    });
    terms.fold(Sign::Zero, Sign::plus)
}

fn sign_of(monomial: &Monomial, energies: &Energies) -> Sign {
    let factors = monomial.factors.iter();
    let signs = factors.map(|&(parameter, exponent)| {
        let nominal = energies.parameters[parameter].nominal;
        Sign::of(nominal.unwrap_or(1.0)).power(f64::from(exponent))
    });
    signs.fold(Sign::Above, Sign::times)
}

impl Sign {
    fn of(value: f64) -> Self {
        if value == 0.0 {
            Self::Zero
        } else if value > 0.0 {
            Self::Above
        } else {
            Self::Below
        }
    }

    const fn plus(self, other: Self) -> Self {
        match (self, other) {
            (Self::Zero, sign) | (sign, Self::Zero) => sign,
            (Self::Above, Self::Above) => Self::Above,
            (Self::Below, Self::Below) => Self::Below,
            _ => Self::Unknown,
        }
    }

    const fn times(self, other: Self) -> Self {
        match (self, other) {
            (Self::Zero, _) | (_, Self::Zero) => Self::Zero,
            (Self::Unknown, _) | (_, Self::Unknown) => Self::Unknown,
            (Self::Above, Self::Above) | (Self::Below, Self::Below) => Self::Above,
            _ => Self::Below,
        }
    }

    /// Of a power that is a number.
    fn power(self, exponent: f64) -> Self {
        let is_even = whole(exponent / 2.0, i32::from(i16::MAX)).is_some();
        match self {
            Self::Zero if exponent > 0.0 => Self::Zero,
            Self::Zero => Self::Unknown,
            _ if is_even => Self::Above,
            sign => sign,
        }
    }
}

/// The ring of what is known of signs.
struct Signs {
    coordinates: usize,
}

impl Signs {
    fn same(&self, sign: Sign) -> Vec<Sign> {
        vec![sign; self.coordinates]
    }
}

impl Ring for Signs {
    type Element = Coefficient;

    fn number(&mut self, value: f64) -> Coefficient {
        Coefficient {
            number: Some(value),
            changes: BTreeSet::new(),
            alone: self.same(Sign::of(value)),
        }
    }

    fn as_number(&self, x: &Coefficient) -> Option<f64> {
        x.number
    }

    fn coordinate(&mut self, joint: usize) -> Coefficient {
        Coefficient {
            number: None,
            changes: BTreeSet::from([joint]),
            alone: self.same(Sign::Unknown),
        }
    }

    fn rate(&mut self, joint: usize) -> Coefficient {
        let mut alone = self.same(Sign::Zero);
        alone[joint] = Sign::Unknown;
        Coefficient {
            number: None,
            changes: BTreeSet::new(),
            alone,
        }
    }

    fn add(&mut self, x: &Coefficient, y: &Coefficient) -> Coefficient {
        both(x, y, |x, y| x + y, Sign::plus)
    }

    fn mul(&mut self, x: &Coefficient, y: &Coefficient) -> Coefficient {
        both(x, y, |x, y| x * y, Sign::times)
    }

    fn power(&mut self, x: &Coefficient, y: &Coefficient) -> Option<Coefficient> {
        Some(match y.number {
            Some(exponent) => both(x, y, f64::powf, |sign, _| sign.power(exponent)),
            None => both(x, y, f64::powf, |_, _| Sign::Unknown),
        })
    }

    fn call(&mut self, function: Function, x: &Coefficient) -> Option<Coefficient> {
        let number = x.number.map(|x| function.apply(x));
        let sign = match (number, function) {
            (Some(number), _) => Sign::of(number),
            (None, Function::Exp | Function::Sqrt | Function::Abs) => Sign::Above,
            _ => Sign::Unknown,
        };
        Some(Coefficient {
            number,
            changes: x.changes.clone(),
            alone: self.same(sign),
        })
    }

    fn derivative(&mut self, x: &Coefficient) -> Option<Coefficient> {
        if x.changes.is_empty() {
            return Some(self.number(0.0));
        }
        let mut alone = self.same(Sign::Zero);
        for &coordinate in &x.changes {
            alone[coordinate] = Sign::Unknown;
        }
        Some(Coefficient {
            number: None,
            changes: x.changes.clone(),
            alone,
        })
    }

    fn is_zero(&self, x: &Coefficient) -> bool {
        x.number == Some(0.0)
    }
}

fn both(
    x: &Coefficient,
    y: &Coefficient,
    numbers: impl Fn(f64, f64) -> f64,
    signs: impl Fn(Sign, Sign) -> Sign,
) -> Coefficient {
    Coefficient {
        number: x.number.zip(y.number).map(|(x, y)| numbers(x, y)),
        changes: x.changes.union(&y.changes).copied().collect(),
        alone: x
            .alone
            .iter()
            .zip(&y.alone)
            .map(|(x, y)| signs(*x, *y))
            .collect(),
    }
}
