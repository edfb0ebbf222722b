//! Fewer operations for the same values: what several outputs have in common is computed once.
//!
//! In: outputs of one function as expressions of a [`Dag`]. Out: the same outputs in a dag of their own, with fewer
//! multiplications and additions. Invariants: values change by no more than rounding; the same input gives the same output.

mod cost;
mod kernels;
mod network;
mod products;
mod rebuild;
mod terms;

#[cfg(test)]
mod tests;

use crate::expr::{Dag, ExprId};
pub use cost::Cost;
pub(crate) use cost::operations;
use network::Network;

/// A function's outputs, ready to be scheduled.
#[derive(Debug, Clone)]
pub struct Optimized {
    /// Where the outputs live. Its nodes are made as they are: no rule has been applied to them.
    pub dag: Dag,
    /// One per output that was asked for.
    pub outputs: Vec<ExprId>,
}

/// Beyond so many operations the best of several orders is not worth its time: arms of ten joints and more.
const LARGE: usize = 10_000;

/// Rewrites the outputs of one function.
///
/// What is taken out of sums leaves parts that only one other sum uses; written out there more may cancel. So what comes out
/// goes in again, to cancel and be shared anew, as long as that spares something.
#[must_use]
pub fn optimize(dag: &Dag, outputs: &[ExprId]) -> Optimized {
    let sum = |optimized: &Optimized| {
        let cost = optimized.cost();
        cost.mul + cost.add
    };
    let mut best = pass(dag, outputs);
    loop {
        let next = pass(&best.dag, &best.outputs);
        if sum(&next) >= sum(&best) {
            return best;
        }
        best = next;
    }
}

fn pass(dag: &Dag, outputs: &[ExprId]) -> Optimized {
    let mut network = Network::new(dag, outputs);
    terms::open(&mut network);
    let orders = [(false, false), (true, false), (false, true), (true, true)];
    let tried = if network.operations() > LARGE {
        1
    } else {
        orders.len()
    };
    let mut best: Option<Network> = None;
    for &(products_first, split) in &orders[..tried] {
        let candidate = shared(network.clone(), products_first, split);
        let fewest = best.as_ref().map_or(usize::MAX, Network::operations);
        if candidate.operations() < fewest {
            best = Some(candidate);
        }
    }
    rebuild::rebuild(dag, &best.unwrap_or(network))
}

/// What is shared is computed once, in the order that is said.
fn shared(mut network: Network, products_first: bool, split: bool) -> Network {
    if split {
        terms::split(&mut network);
    }
    if products_first {
        products::share(&mut network);
    }
    loop {
        let before = network.operations();
        kernels::share(&mut network);
        products::share(&mut network);
        if network.operations() >= before {
            break;
        }
    }
    terms::collect(&mut network);
    network
}
