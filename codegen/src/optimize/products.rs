//! Products of two factors that several products contain: `(a b) c`, `(a b) d` with `a b` once.

use std::collections::BTreeMap;

use rustc_hash::FxHashMap as HashMap;

use super::network::{Cell, Id, Network};

/// Takes out the most frequent pairs until none comes twice.
pub fn share(network: &mut Network) {
    while step(network) {}
}

fn step(network: &mut Network) -> bool {
    // Looked up only, but for the sorted list below.
    let mut count: HashMap<(Id, Id), usize> = HashMap::default();
    each_product(network, |_, factors| {
        each_pair(factors, |pair| *count.entry(pair).or_default() += 1);
    });
    let most = count.values().copied().max().unwrap_or(0);
    if most < 2 {
        return false;
    }
    // All pairs of this round come as often as the best; those that lose a place to another wait for the next round.
    let mut frequent: Vec<(Id, Id)> = count
        .into_iter()
        .filter_map(|(pair, times)| (times == most).then_some(pair))
        .collect();
    frequent.sort_unstable();
    let mut best = Best {
        pair_of: vec![None; network.cells.len()],
    };
    for pair in frequent {
        best.offer(pair);
    }
    best.extract(network);
    true
}

/// Pairs without a cell in common, and who has them.
struct Best {
    /// Per cell the pair that it is in.
    pair_of: Vec<Option<(Id, Id)>>,
}

impl Best {
    fn offer(&mut self, (p, q): (Id, Id)) {
        if self.pair_of[p].is_none() && self.pair_of[q].is_none() {
            self.pair_of[p] = Some((p, q));
            self.pair_of[q] = Some((p, q));
        }
    }

    fn extract(&self, network: &mut Network) {
        // The cell that is the pair, where there is one.
        let mut shared: BTreeMap<(Id, Id), Option<Id>> = self
            .pair_of
            .iter()
            .flatten()
            .map(|&pair| (pair, None))
            .collect();
        for (id, cell) in network.cells.iter().enumerate() {
            if let Cell::Product(factors) = cell
                && let &[p, q] = &factors[..]
                && let Some(known) = shared.get_mut(&(p, q))
            {
                known.get_or_insert(id);
            }
        }
        let shared: BTreeMap<(Id, Id), Id> = shared
            .into_iter()
            .map(|((p, q), known)| {
                let id = known.unwrap_or_else(|| network.push(Cell::Product(vec![p, q])));
                ((p, q), id)
            })
            .collect();
        each_product(network, |cell, factors| {
            let mut here: Vec<(Id, Id)> = Vec::new();
            each_pair(factors, |pair| {
                if self.pair_of[pair.0] == Some(pair) && shared[&pair] != cell {
                    here.push(pair);
                }
            });
            for (p, q) in here {
                for one in [p, q] {
                    let k = factors.iter().position(|&x| x == one);
                    factors.remove(k.expect("the pair is in the product"));
                }
                factors.push(shared[&(p, q)]);
                factors.sort_unstable();
            }
        });
    }
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
fn each_pair(factors: &[Id], mut visit: impl FnMut((Id, Id))) {
    for (i, &p) in factors.iter().enumerate() {
        // Of one that comes twice the first has made all pairs.
        if i > 0 && factors[i - 1] == p {
            continue;
        }
        for j in i + 1..factors.len() {
            if j == i + 1 || factors[j] != factors[j - 1] {
                visit((p, factors[j]));
            }
        }
    }
}
