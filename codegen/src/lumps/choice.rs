//! Which lumps: coefficients in proportion are one, a lump that contains another whole loses it, dependent ones go.

use super::Row;
use super::function::Function;
use crate::elimination::{Elimination, SAME};
use crate::selection::shortest;

/// The chosen lumps.
pub(super) struct Choice {
    /// Combinations of standard parameters, independent of each other.
    pub(super) lumps: Vec<Row>,
    /// Per lump a standard parameter of it that no other lump has for its own.
    pub(super) representatives: Vec<usize>,
    /// `shares[lump][function]`: the coefficients of a function are the sum of `share * lump`.
    pub(super) shares: Vec<Vec<f64>>,
}

impl Choice {
    /// `None` where rounding leaves a function that is no combination of the lumps.
    pub(super) fn of(functions: &[Function]) -> Option<Self> {
        let mut candidates = distinct(functions);
        // Stable: among lumps of one size the first written stays first.
        candidates.sort_by_key(size);
        subtract_contained(&mut candidates);
        candidates.sort_by_key(size);
        let mut elimination = Elimination::new(functions.first().map_or(0, |f| f.row.len()));
        let (mut lumps, mut representatives) = (Vec::new(), Vec::new());
        for row in candidates {
            // A standard parameter that the lump itself has, so that papers' names stay.
            let own = (0..row.len()).filter(|k| row[*k] != 0.0);
            if let Some(representative) = elimination.keep(&row, own) {
                representatives.push(representative);
                lumps.push(row);
            }
        }
        let mut shares = vec![vec![0.0; functions.len()]; lumps.len()];
        for (k, function) in functions.iter().enumerate() {
            for (own, share) in shares.iter_mut().zip(elimination.shares(&function.row)?) {
                own[k] = share;
            }
        }
        Some(Self {
            lumps,
            representatives,
            shares,
        })
    }
}

fn size(row: &Row) -> usize {
    row.iter().filter(|x| **x != 0.0).count()
}

/// One lump per direction of the functions' coefficients.
fn distinct(functions: &[Function]) -> Vec<Row> {
    let mut groups: Vec<Vec<Row>> = Vec::new();
    for function in functions {
        let row = &function.row;
        match groups
            .iter_mut()
            .find(|group| ratio(&group[0], row).is_some())
        {
            Some(group) => group.push(row.clone()),
            None => groups.push(vec![row.clone()]),
        }
    }
    groups.iter().map(|group| scaled(group)).collect()
}

/// The scale in which a person would write a lump. Where all coefficients are alike they are 1. Else it is the first
/// occurrence that begins with 1, a half or another power of two, nearest to 1; else the first occurrence. The first
/// coefficient is positive.
fn scaled(group: &[Row]) -> Row {
    let leading = |row: &Row| row.iter().copied().find(|x| *x != 0.0).unwrap_or(1.0);
    let first = &group[0];
    let size = leading(first).abs();
    if first
        .iter()
        .all(|x| *x == 0.0 || (x.abs() - size).abs() <= SAME * size)
    {
        return first
            .iter()
            .map(|x| {
                if *x == 0.0 {
                    0.0
                } else {
                    (x / leading(first)).signum()
                }
            })
            .collect();
    }
    let away_from_one = |row: &&Row| {
        let power = leading(row).abs().log2();
        ((power - power.round()).abs() < 1e-9).then(|| power.round().abs())
    };
    let chosen = group
        .iter()
        .filter(|row| away_from_one(row).is_some())
        .min_by(|x, y| {
            let (x, y) = (away_from_one(x), away_from_one(y));
            x.partial_cmp(&y).unwrap_or(std::cmp::Ordering::Equal)
        })
        .unwrap_or(first);
    let sign = leading(chosen).signum();
    // The lump is defined by these digits; the shares are then its exact ones.
    chosen
        .iter()
        .map(|x| shortest(sign * x, SAME * x.abs()))
        .collect()
}

/// `y / x` where the rows are in proportion, entry by entry: each stands in a unit of its own.
fn ratio(x: &Row, y: &Row) -> Option<f64> {
    let k = x.iter().position(|x| *x != 0.0)?;
    let ratio = y[k] / x[k];
    let mut pairs = x.iter().zip(y);
    (ratio != 0.0 && pairs.all(|(x, y)| (y - ratio * x).abs() <= SAME * y.abs())).then_some(ratio)
}

/// `I1 + m1*l^2 + I2` beside a lump `I2` is `I1 + m1*l^2`. Smaller lumps come first.
fn subtract_contained(lumps: &mut [Row]) {
    for k in 1..lumps.len() {
        let (smaller, rest) = lumps.split_at_mut(k);
        let lump = &mut rest[0];
        for part in smaller.iter() {
            let contained = |lump: &Row| {
                let of_part: Vec<f64> = lump
                    .iter()
                    .zip(part)
                    .map(|(x, p)| if *p == 0.0 { 0.0 } else { *x })
                    .collect();
                ratio(part, &of_part)
            };
            if size(lump) > size(part) && contained(lump).is_some() {
                for (x, p) in lump.iter_mut().zip(part) {
                    if *p != 0.0 {
                        *x = 0.0;
                    }
                }
            }
        }
    }
}
