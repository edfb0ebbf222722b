//! The rows that candidates are asked on.

use super::slopes::slopes;
use crate::columns::{Candidate, Entry};
use crate::identify::{Stack, filtered_columns};
use crate::signal::Prepared;

/// Logs, and which of their rows a fit of them leaves out: there a candidate's columns are zero as the model's are, or such a row would say
/// that its torque is nothing.
#[derive(Clone, Copy)]
pub(super) struct Rows<'a> {
    pub(super) logs: &'a [Prepared],
    stack: &'a Stack,
}

impl<'a> Rows<'a> {
    /// Those of a stack of these logs.
    pub(super) fn new(logs: &'a [Prepared], stack: &'a Stack) -> Self {
        Self { logs, stack }
    }

    /// Filtered columns of a candidate with these shapes.
    pub(super) fn columns(&self, candidate: &dyn Candidate, shapes: &[f64]) -> Vec<Entry> {
        self.left(filtered_columns(candidate, self.logs, shapes))
    }

    /// Filtered columns, one a shape, of what the torque of a candidate with these parameters changes by with it.
    pub(super) fn slopes(
        &self,
        candidate: &dyn Candidate,
        shapes: &[f64],
        gain: &[f64],
    ) -> Vec<Entry> {
        self.left(slopes(candidate, shapes, gain, self.logs))
    }

    fn left(&self, mut entries: Vec<Entry>) -> Vec<Entry> {
        self.stack.clear_left_out(&mut entries);
        entries
    }
}
