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

/// Rewrites the outputs of one function.
#[must_use]
pub fn optimize(dag: &Dag, outputs: &[ExprId]) -> Optimized {
    let mut network = Network::new(dag, outputs);
    terms::open(&mut network);
    let orders = [(false, false), (true, false), (false, true), (true, true)];
    let candidates = orders.map(|(products_first, split)| {
        let mut network = network.clone();
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
    });
    let [first, rest @ ..] = candidates;
    let best = rest.into_iter().fold(first, |best, other| {
        if other.operations() < best.operations() {
            other
        } else {
            best
        }
    });
    rebuild::rebuild(dag, &best)
}
