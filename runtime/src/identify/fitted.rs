//! How rows were fitted.

use super::stack::Stack;

/// How rows were fitted.
pub(super) struct Fitted {
    /// `100 || residual || / || tau ||` per joint.
    pub relative_percent: Vec<f64>,
    /// Samples per joint.
    pub samples: usize,
    /// Of these, at turns.
    pub turns: Vec<usize>,
    /// Of these, left out because torque stands at a limit.
    pub clipped: Vec<usize>,
    /// Of these, left out because dry friction holds the joint.
    pub held: Vec<usize>,
    /// Of these, independent ones per joint.
    pub effective_samples: Option<Vec<f64>>,
    /// Names of the unknowns.
    pub names: Vec<String>,
}

impl Fitted {
    /// By an estimate.
    pub fn new(stack: &Stack, estimate: &[f64]) -> Self {
        let residuals = stack.residuals(estimate);
        let times = stack.correlation_times(&residuals);
        let effective = stack.counts().into_iter().zip(times);
        let effective = effective.map(|(count, time)| count as f64 / time);
        Self {
            relative_percent: stack.relative_percent(estimate),
            samples: stack.samples(),
            turns: stack.turns.iter().map(Vec::len).collect(),
            clipped: stack.clipped.iter().map(Vec::len).collect(),
            held: stack.held.iter().map(Vec::len).collect(),
            effective_samples: Some(effective.collect()),
            names: stack.unknowns.iter().map(|x| x.name.clone()).collect(),
        }
    }
}
