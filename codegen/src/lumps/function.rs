//! Functions of the motion: harmonics, and products of two where a pair of harmonics has one coefficient.

use std::collections::BTreeMap;

use super::{Part, Row};
use crate::dynamics::fourier::{Harmonic, turned_positive};
use crate::elimination::SAME;
use crate::expr::{Dag, ExprId, Function as DagFunction, Symbol};

/// `(sine, multiples)`: the sine, or the cosine, of a sum of multiples of the coordinates.
type Wave = (bool, Vec<i32>);

/// A function with the coefficients of the standard parameters before it.
#[derive(Debug, Clone)]
pub(super) struct Function {
    pub(super) part: Part,
    rates: Vec<i32>,
    powers: Vec<i32>,
    /// Sines and cosines in the product.
    factors: Vec<Wave>,
    pub(super) row: Row,
}

/// `1/2` before a square of a rate: then the coefficient is the entry of the mass matrix.
pub(super) fn share_of_energy(harmonic: &Harmonic) -> f64 {
    share(&harmonic.rates)
}

fn share(rates: &[i32]) -> f64 {
    if rates.contains(&2) { 0.5 } else { 1.0 }
}

impl Function {
    pub(super) fn single(part: Part, harmonic: &Harmonic, row: Row) -> Self {
        Self {
            part,
            rates: harmonic.rates.clone(),
            powers: harmonic.powers.clone(),
            factors: vec![(harmonic.sine, harmonic.multiples.clone())],
            row,
        }
    }

    /// Its energy per unit of the coefficient.
    pub(super) fn energy(&self, dag: &mut Dag) -> ExprId {
        let mut product = dag.constant(share(&self.rates));
        for (exponents, symbol) in [
            (&self.powers, Symbol::Q as fn(usize) -> Symbol),
            (&self.rates, Symbol::Dq),
        ] {
            for (joint, &exponent) in exponents.iter().enumerate() {
                let base = dag.symbol(symbol(joint));
                let exponent = dag.constant(f64::from(exponent));
                let power = dag.power(base, exponent);
                product = dag.mul(product, power);
            }
        }
        for (sine, multiples) in &self.factors {
            let mut argument = dag.zero();
            for (joint, &multiple) in multiples.iter().enumerate() {
                let q = dag.symbol(Symbol::Q(joint));
                let part = dag.scale(f64::from(multiple), q);
                argument = dag.add(argument, part);
            }
            let function = if *sine {
                DagFunction::Sin
            } else {
                DagFunction::Cos
            };
            let factor = dag.call(function, argument);
            product = dag.mul(product, factor);
        }
        product
    }
}

/// One function a harmonic; pairs with the same coefficients become products: `cos(a + b) + cos(a - b) = 2 cos a cos b`.
pub(super) fn merged(rows: BTreeMap<Harmonic, (Part, Row)>) -> Vec<Function> {
    let mut left: Vec<(Harmonic, Part, Row)> = rows
        .into_iter()
        .map(|(harmonic, (part, row))| (harmonic, part, row))
        .collect();
    // `dq1^2` before `dq1 dq2` before `dq2^2`: the order of the mass matrix.
    left.sort_by(|x, y| y.0.rates.cmp(&x.0.rates));
    let mut functions = Vec::new();
    while !left.is_empty() {
        let (harmonic, part, row) = left.remove(0);
        let pair = left.iter().enumerate().find_map(|(k, (other, _, second))| {
            let sign = same_or_opposite(&row, second)?;
            product(&harmonic, other, sign).map(|found| (k, found))
        });
        let Some((k, (factors, scale))) = pair else {
            functions.push(Function::single(part, &harmonic, row));
            continue;
        };
        left.remove(k);
        functions.push(Function {
            factors,
            row: row.iter().map(|x| scale * x).collect(),
            ..Function::single(part, &harmonic, Vec::new())
        });
    }
    functions
}

/// The product that `first + sign * second` is, with its scale.
fn product(first: &Harmonic, second: &Harmonic, sign: f64) -> Option<(Vec<Wave>, f64)> {
    if (&first.rates, &first.powers, first.sine) != (&second.rates, &second.powers, second.sine) {
        return None;
    }
    let halves = |sign: i32| -> Option<Vec<i32>> {
        let pairs = first.multiples.iter().zip(&second.multiples);
        pairs
            .map(|(x, y)| {
                let sum = x + sign * y;
                (sum % 2 == 0).then_some(sum / 2)
            })
            .collect()
    };
    let (mean, difference) = (halves(1)?, halves(-1)?);
    // With a = mean and b = difference: first = f(a + b), second = f(a - b).
    let (sines, scale) = match (first.sine, sign > 0.0) {
        (false, true) => ([false, false], 2.0),
        (false, false) => ([true, true], -2.0),
        (true, true) => ([true, false], 2.0),
        (true, false) => ([false, true], 2.0),
    };
    let mut factors = Vec::new();
    let mut scale = scale;
    for (sine, mut multiples) in sines.into_iter().zip([mean, difference]) {
        if turned_positive(&mut multiples) && sine {
            scale = -scale;
        }
        factors.push((sine, multiples));
    }
    factors.sort();
    Some((factors, scale))
}

/// 1 or -1 where one row is the other or its negative, entry by entry.
fn same_or_opposite(x: &Row, y: &Row) -> Option<f64> {
    [1.0, -1.0].into_iter().find(|sign| {
        let mut pairs = x.iter().zip(y);
        pairs.all(|(x, y)| (x - sign * y).abs() <= SAME * x.abs())
    })
}
