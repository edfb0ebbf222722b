//! Which lumps: coefficients in proportion are one, a lump that contains another whole loses it, dependent ones go.

use super::Row;
use super::function::{Function, SAME};
use crate::selection::{Selection, norm, snap};

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
    /// `None` where lengths are so different that coefficients are neither clearly dependent nor clearly independent.
    pub(super) fn of(functions: &[Function]) -> Option<Self> {
        let mut candidates = distinct(functions);
        // Stable: among lumps of one size the first written stays first.
        candidates.sort_by_key(size);
        subtract_contained(&mut candidates);
        candidates.sort_by_key(size);
        let lumps = independent(candidates);
        let shares = shares(&lumps, functions)?;
        Some(Self {
            representatives: representatives(&lumps)?,
            lumps,
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
    chosen.iter().map(|x| snap(sign * x)).collect()
}

/// `y / x` where the rows are in proportion.
fn ratio(x: &Row, y: &Row) -> Option<f64> {
    let k = x.iter().position(|x| *x != 0.0)?;
    let ratio = y[k] / x[k];
    let size = y.iter().fold(0.0, |size: f64, y| size.max(y.abs()));
    let mut pairs = x.iter().zip(y);
    (ratio != 0.0 && pairs.all(|(x, y)| (y - ratio * x).abs() <= SAME * size)).then_some(ratio)
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

fn independent(candidates: Vec<Row>) -> Vec<Row> {
    let mut selection = Selection::default();
    for (k, row) in candidates.iter().enumerate() {
        selection.take(k, unit(row), "");
    }
    let kept = selection.kept;
    candidates
        .into_iter()
        .enumerate()
        .filter(|(k, _)| kept.contains(k))
        .map(|(_, row)| row)
        .collect()
}

fn unit(row: &Row) -> Row {
    let length = norm(row);
    row.iter().map(|x| x / length).collect()
}

/// Offers the functions' rows after the lumps: all of them are combinations of lumps, but for rounding.
fn shares(lumps: &[Row], functions: &[Function]) -> Option<Vec<Vec<f64>>> {
    let mut selection = Selection::default();
    let rows = || lumps.iter().chain(functions.iter().map(|f| &f.row));
    for (k, row) in rows().enumerate() {
        selection.take(k, unit(row), "");
    }
    let lengths: Vec<f64> = rows().map(|row| norm(row)).collect();
    let mut shares = vec![vec![0.0; functions.len()]; lumps.len()];
    for combination in selection.combinations(&lengths) {
        let own = shares.get_mut(combination[0].0)?;
        for &(row, share) in &combination[1..] {
            *own.get_mut(row.checked_sub(lumps.len())?)? = share;
        }
    }
    Some(shares)
}

/// A distinct standard parameter per lump, by elimination; the first that the lump itself has.
fn representatives(lumps: &[Row]) -> Option<Vec<usize>> {
    let mut reduced: Vec<Row> = lumps.to_vec();
    let mut representatives = Vec::new();
    for k in 0..lumps.len() {
        let largest = reduced[k]
            .iter()
            .fold(0.0, |size: f64, x| size.max(x.abs()));
        let left = |c: &usize| reduced[k][*c].abs() > 1e-9 * largest;
        let columns = || 0..reduced[k].len();
        let pivot = columns()
            .filter(left)
            .find(|c| lumps[k][*c] != 0.0)
            .or_else(|| columns().find(left))?;
        representatives.push(pivot);
        let row = reduced[k].clone();
        for other in &mut reduced[k + 1..] {
            let factor = other[pivot] / row[pivot];
            for (x, y) in other.iter_mut().zip(&row) {
                *x -= factor * y;
            }
            other[pivot] = 0.0;
        }
    }
    Some(representatives)
}
