//! Sums of two products that several sums contain, or that one sum contains with a common factor:
//! `a x + a y = a (x + y)`, and `x + y` once where many use it.
//!
//! Source: two-term kernels of Hosangadi, Fallah and Kastner 2006, "Optimizing polynomial expressions by algebraic
//! factorization and common subexpression elimination".

use std::collections::BTreeMap;

use super::network::{Cell, Id, Network, Term};

/// `x + y`, or `x - y`; both products ascending, `x` before `y`.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
struct Kernel {
    x: Vec<Id>,
    y: Vec<Id>,
    minus: bool,
}

/// Two terms of a sum that are `+-factor * kernel`.
#[derive(Debug, Clone)]
struct Place {
    sum: Id,
    terms: (usize, usize),
    factor: Vec<Id>,
    negative: bool,
}

/// Takes out what saves most until nothing saves any more.
pub fn share(network: &mut Network) {
    while step(network) {}
}

/// One round: every kernel that saves as much as the best one, in sums that this round has not changed before.
fn step(network: &mut Network) -> bool {
    let mut candidates: Vec<(usize, Kernel, Vec<Place>)> = places(network)
        .into_iter()
        .map(|(kernel, places)| (saving(&kernel, &disjoint(&places, &[])), kernel, places))
        .filter(|candidate| candidate.0 > 0)
        .collect();
    let Some(best) = candidates.iter().map(|candidate| candidate.0).max() else {
        return false;
    };
    candidates.retain(|candidate| candidate.0 == best);
    let mut changed = vec![false; network.cells.len()];
    for (_, kernel, places) in candidates {
        let places = disjoint(&places, &changed);
        if saving(&kernel, &places) < best {
            continue;
        }
        for place in &places {
            changed[place.sum] = true;
        }
        extract(network, &kernel, &places);
    }
    true
}

fn places(network: &Network) -> BTreeMap<Kernel, Vec<Place>> {
    let mut found: BTreeMap<Kernel, Vec<Place>> = BTreeMap::new();
    for (sum, cell) in network.cells.iter().enumerate() {
        let Cell::Sum(terms) = cell else { continue };
        for j in 1..terms.len() {
            for i in 0..j {
                let common = common(&terms[i].factors, &terms[j].factors);
                let mut add = |factor: Vec<Id>| {
                    let mut x = without(&terms[i].factors, &factor);
                    let mut y = without(&terms[j].factors, &factor);
                    if x.is_empty() || y.is_empty() {
                        return;
                    }
                    let minus = terms[i].negative != terms[j].negative;
                    let mut negative = terms[i].negative;
                    if y < x {
                        std::mem::swap(&mut x, &mut y);
                        negative = terms[j].negative;
                    }
                    found
                        .entry(Kernel { x, y, minus })
                        .or_default()
                        .push(Place {
                            sum,
                            terms: (i, j),
                            factor,
                            negative,
                        });
                };
                add(Vec::new());
                if common.len() > 1 {
                    for &one in &common {
                        add(vec![one]);
                    }
                }
                if !common.is_empty() {
                    add(common);
                }
            }
        }
    }
    found
}

/// Places that have no term in common, in sums that are not changed.
fn disjoint(places: &[Place], changed: &[bool]) -> Vec<Place> {
    let mut taken: Vec<(Id, usize)> = Vec::new();
    let mut kept: Vec<Place> = Vec::new();
    for place in places {
        let terms = [(place.sum, place.terms.0), (place.sum, place.terms.1)];
        let free = terms.iter().all(|term| !taken.contains(term));
        if free && !changed.get(place.sum).copied().unwrap_or(false) {
            taken.extend(terms);
            kept.push(place.clone());
        }
    }
    kept
}

/// Operations less when the kernel is computed once.
fn saving(kernel: &Kernel, places: &[Place]) -> usize {
    let own = kernel.x.len() + kernel.y.len() - 1;
    let each = places.iter().map(|place| own + place.factor.len());
    each.sum::<usize>().saturating_sub(own)
}

fn extract(network: &mut Network, kernel: &Kernel, places: &[Place]) {
    let whole = |place: &Place| {
        place.factor.is_empty()
            && !place.negative
            && matches!(&network.cells[place.sum], Cell::Sum(terms) if terms.len() == 2)
    };
    // A sum that is the kernel already is used as it is.
    let existing = places.iter().find(|place| whole(place)).map(|p| p.sum);
    let shared = existing.unwrap_or_else(|| {
        network.push(Cell::Sum(vec![
            Term {
                negative: false,
                factors: kernel.x.clone(),
            },
            Term {
                negative: kernel.minus,
                factors: kernel.y.clone(),
            },
        ]))
    });
    for place in places.iter().filter(|place| place.sum != shared) {
        let mut factors = place.factor.clone();
        factors.push(shared);
        factors.sort_unstable();
        let replaced = Term {
            negative: place.negative,
            factors,
        };
        replace(network, place, replaced, places);
    }
}

/// The two terms of a place become one. Other places of the same sum keep their numbers: the second term is emptied first and
/// taken away by the last place of its sum.
fn replace(network: &mut Network, place: &Place, term: Term, places: &[Place]) {
    let Cell::Sum(terms) = &mut network.cells[place.sum] else {
        return;
    };
    let (i, j) = place.terms;
    terms[i] = term;
    terms[j].factors.clear();
    let last = places.iter().rev().find(|other| other.sum == place.sum);
    if last.is_some_and(|last| last.terms == place.terms) {
        terms.retain(|term| !term.factors.is_empty());
    }
}

/// What two ascending lists share, as often as both have it.
fn common(x: &[Id], y: &[Id]) -> Vec<Id> {
    let (mut i, mut j) = (0, 0);
    let mut common = Vec::new();
    while i < x.len() && j < y.len() {
        match x[i].cmp(&y[j]) {
            std::cmp::Ordering::Less => i += 1,
            std::cmp::Ordering::Greater => j += 1,
            std::cmp::Ordering::Equal => {
                common.push(x[i]);
                i += 1;
                j += 1;
            }
        }
    }
    common
}

/// The list without the elements of an ascending part of it.
fn without(list: &[Id], part: &[Id]) -> Vec<Id> {
    let mut part = part.iter().peekable();
    list.iter()
        .filter(|x| part.next_if_eq(x).is_none())
        .copied()
        .collect()
}
