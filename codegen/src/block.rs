//! Columns of a regressor, to run.

use crate::expr::{Dag, ExprId};
use crate::interpreter::Program;

/// The entries of some regressor columns that are not zero by structure, with the program that evaluates them.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Block {
    /// `(joint, column)` of output `k` of the program; both from 0.
    pub entries: Vec<(usize, usize)>,
    /// One output per entry.
    pub program: Program,
}

impl Block {
    pub(crate) fn new(dag: &Dag, entries: Vec<(usize, usize, ExprId)>) -> Self {
        let outputs: Vec<ExprId> = entries.iter().map(|entry| entry.2).collect();
        let entries = entries
            .into_iter()
            .map(|(joint, column, _)| (joint, column))
            .collect();
        Self {
            entries,
            program: Program::new(dag, &outputs),
        }
    }
}
