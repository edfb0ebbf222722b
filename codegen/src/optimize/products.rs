//! Products of two factors that several products contain: `(a b) c`, `(a b) d` with `a b` once.

use std::collections::BTreeMap;

use super::network::{Cell, Id, Network};

/// Takes out the most frequent pairs until none comes twice.
pub fn share(network: &mut Network) {
    while step(network) {}
}

fn step(network: &mut Network) -> bool {
    let mut count: BTreeMap<(Id, Id), usize> = BTreeMap::new();
    each_product(network, |_, factors| {
        for pair in pairs(factors) {
            *count.entry(pair).or_default() += 1;
        }
    });
    let Some(&most) = count.values().max() else {
        return false;
    };
    if most < 2 {
        return false;
    }
    // All pairs of this round come as often as the best; those that lose a place to another wait for the next round.
    let mut best: Vec<(Id, Id)> = Vec::new();
    for (&pair, &times) in &count {
        let apart = |other: &(Id, Id)| {
            ![other.0, other.1].contains(&pair.0) && ![other.0, other.1].contains(&pair.1)
        };
        if times == most && best.iter().all(apart) {
            best.push(pair);
        }
    }
    for pair in best {
        extract(network, pair);
    }
    true
}

fn extract(network: &mut Network, (p, q): (Id, Id)) {
    let own = [p, q];
    let existing = network
        .cells
        .iter()
        .position(|cell| matches!(cell, Cell::Product(factors) if factors[..] == own));
    let shared = existing.unwrap_or_else(|| network.push(Cell::Product(own.to_vec())));
    each_product(network, |cell, factors| {
        if cell == shared {
            return;
        }
        if pairs(factors).any(|pair| pair == (p, q)) {
            for one in own {
                let k = factors.iter().position(|&x| x == one);
                factors.remove(k.expect("the pair is in the product"));
            }
            factors.push(shared);
            factors.sort_unstable();
        }
    });
}

/// Every product of a sum, and every product of its own.
fn each_product(network: &mut Network, mut visit: impl FnMut(Id, &mut Vec<Id>)) {
    for (id, cell) in network.cells.iter_mut().enumerate() {
        match cell {
            Cell::Sum(terms) => {
                for term in terms {
                    visit(id, &mut term.factors);
                }
            }
            Cell::Product(factors) => visit(id, factors),
            Cell::Number(_) | Cell::Atom(..) => {}
        }
    }
}

/// Different pairs of an ascending list, each once.
fn pairs(factors: &[Id]) -> impl Iterator<Item = (Id, Id)> {
    let mut pairs: Vec<(Id, Id)> = (1..factors.len())
        .flat_map(|j| (0..j).map(move |i| (factors[i], factors[j])))
        .collect();
    pairs.sort_unstable();
    pairs.dedup();
    pairs.into_iter()
}
