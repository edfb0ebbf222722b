//! Terms of a sum that are multiples of one product: `c x + y - c x = y`, `x + y + x = 2 x + y`, and for a while the other way.

use super::network::{Cell, Id, Network, Term};
use crate::rounded::Rounded;

/// Collects them in every sum. Parts of a sum that were apart in the dag are next to each other in the network. Numbers of a
/// product are one.
pub fn collect(network: &mut Network) {
    for id in 0..network.cells.len() {
        fold(network, id);
        let Cell::Sum(terms) = &network.cells[id] else {
            continue;
        };
        if let Some(terms) = collected(network, terms.clone()) {
            network.cells[id] = if terms.is_empty() {
                Cell::Number(0.0)
            } else {
                Cell::Sum(terms)
            };
        }
    }
}

/// Writes a sum out where another uses it and cancels with it: `x - (x + y) = -y`, although others use `x + y` as well; or two
/// of them, `(x + y) - (x - y) = 2 y`.
pub fn open(network: &mut Network) {
    for id in 0..network.cells.len() {
        while let Some(terms) = opened(network, id) {
            network.cells[id] = Cell::Sum(terms);
        }
    }
}

/// A sum that costs no more and in which something has canceled; `None` where there is none. No sum uses itself, not by
/// others either, and what is written out is sums nearer to the symbols: so this comes to an end.
fn opened(network: &mut Network, id: Id) -> Option<Vec<Term>> {
    let Cell::Sum(terms) = &network.cells[id] else {
        return None;
    };
    let terms = terms.clone();
    let sums: Vec<(usize, Vec<Term>)> = (0..terms.len())
        .filter_map(|k| Some((k, written_out(network, &terms[k])?)))
        .collect();
    for (k, inner) in &sums {
        let mut written = terms.clone();
        written.remove(*k);
        written.extend_from_slice(inner);
        if let Some(collected) = collected(network, written)
            && !collected.is_empty()
            && collected.len() <= terms.len()
            && operations(&collected) <= operations(&terms)
        {
            return Some(collected);
        }
    }
    for (j, (l, second)) in sums.iter().enumerate() {
        for (k, first) in &sums[..j] {
            let mut written = terms.clone();
            written.remove(*l);
            written.remove(*k);
            written.extend(first.iter().chain(second).cloned());
            if let Some(collected) = collected(network, written)
                && !collected.is_empty()
                && collected.len() < terms.len()
                && operations(&collected) <= operations(&terms)
            {
                return Some(collected);
            }
        }
    }
    None
}

/// The terms of a multiple of a sum.
fn written_out(network: &mut Network, term: &Term) -> Option<Vec<Term>> {
    let (number, rest) = apart(network, term);
    let &[sum] = &rest[..] else {
        return None;
    };
    let Cell::Sum(inner) = &network.cells[sum] else {
        return None;
    };
    let inner = inner.clone().into_iter().map(|inner| {
        let (own, rest) = apart(network, &inner);
        let number = number * own;
        number.is_normal().then(|| together(network, number, rest))
    });
    inner.collect()
}

/// `2 x` as `x + x`, which costs as much: so `y + 2 x` has `y + x` in it.
pub fn split(network: &mut Network) {
    let two = network.number(2.0);
    for cell in &mut network.cells {
        let Cell::Sum(terms) = cell else { continue };
        let doubled = |term: &Term| term.factors.len() == 2 && term.factors.contains(&two);
        for k in (0..terms.len())
            .filter(|&k| doubled(&terms[k]))
            .collect::<Vec<_>>()
        {
            terms[k].factors.retain(|&factor| factor != two);
            let once = terms[k].clone();
            terms.push(once);
        }
    }
}

/// `None` where there is nothing to collect.
fn collected(network: &mut Network, mut terms: Vec<Term>) -> Option<Vec<Term>> {
    let before = terms.len();
    let mut parts: Vec<(f64, Vec<Id>)> = terms.iter().map(|term| apart(network, term)).collect();
    let mut j = 1;
    while j < terms.len() {
        let same = (0..j).find(|&i| parts[i].1 == parts[j].1);
        let Some(i) = same else {
            j += 1;
            continue;
        };
        let sum = sum_of_numbers(parts[i].0, parts[j].0);
        if !sum.is_finite() {
            j += 1;
            continue;
        }
        terms.remove(j);
        let (_, rest) = parts.remove(j);
        if sum == 0.0 {
            terms.remove(i);
            parts.remove(i);
            j -= 1;
        } else {
            terms[i] = together(network, sum, rest);
            parts[i] = apart(network, &terms[i]);
        }
    }
    (terms.len() < before).then_some(terms)
}

/// A named rounding step: 0 where nothing but rounding is left of two numbers, as of those of a [`Dag`](crate::expr::Dag).
fn sum_of_numbers(c: f64, d: f64) -> f64 {
    (Rounded::constant(c) + Rounded::constant(d))
        .cleaned()
        .value
}

/// Makes the numbers of each product of a cell one.
fn fold(network: &mut Network, id: Id) {
    let has_several = |network: &Network, factors: &[Id]| {
        let numbers = factors.iter();
        let numbers = numbers.filter(|&&x| matches!(network.cells[x], Cell::Number(_)));
        numbers.count() > 1
    };
    match &network.cells[id] {
        Cell::Sum(terms) if terms.iter().any(|term| has_several(network, &term.factors)) => {
            let terms = terms.clone().into_iter().map(|term| {
                let (number, rest) = apart(network, &term);
                together(network, number, rest)
            });
            network.cells[id] = Cell::Sum(terms.collect());
        }
        Cell::Product(factors) if has_several(network, factors) => {
            let factors = factors.clone();
            let negative = false;
            let (number, rest) = apart(network, &Term { negative, factors });
            network.cells[id] = Cell::Product(together(network, number, rest).factors);
        }
        _ => {}
    }
}

/// Multiplications and additions of a sum.
fn operations(terms: &[Term]) -> usize {
    terms
        .iter()
        .map(|term| term.factors.len())
        .sum::<usize>()
        .saturating_sub(1)
}

/// A number and the other factors. Numbers stay where they are if they are too large or too small to be one.
fn apart(network: &Network, term: &Term) -> (f64, Vec<Id>) {
    let sign = if term.negative { -1.0 } else { 1.0 };
    let (mut number, mut has_zero) = (sign, false);
    let mut rest = Vec::with_capacity(term.factors.len());
    for &factor in &term.factors {
        match network.cells[factor] {
            Cell::Number(value) => {
                number *= value;
                has_zero |= value == 0.0;
            }
            _ => rest.push(factor),
        }
    }
    if number.is_normal() || has_zero && number == 0.0 {
        (number, rest)
    } else {
        (sign, term.factors.clone())
    }
}

fn together(network: &mut Network, number: f64, mut factors: Vec<Id>) -> Term {
    let size = number.abs();
    if size.to_bits() != 1.0f64.to_bits() || factors.is_empty() {
        factors.push(network.number(size));
        factors.sort_unstable();
    }
    Term {
        negative: number < 0.0,
        factors,
    }
}
