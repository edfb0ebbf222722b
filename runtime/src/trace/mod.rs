//! Residual tracing: which effect, that the spec does not declare, does the residual come from?
//!
//! In: an arm's columns, candidate effects and the identification logs. Out: a [`Verdict`]. The validation log is not seen
//! here. Every candidate is judged three times. Its *score* asks whether it explains more of the residual than chance, with
//! all model columns projected out and neighboring samples not counted as independent. The *gate* asks whether it lowers the
//! error on data that it was not fitted on, by an amount that matters, in nearly every fold, with steady coefficients of
//! the right sign; each time the full system of all joints is fitted again. Last, *structure* asks whether what is left
//! still follows the motion; then no name is given.

mod conclude;
mod folds;
mod gate;
mod gram;
mod residual;
mod score;
mod search;
mod structure;
mod trial;
mod verdict;

pub use search::Trace;
pub use structure::Structure;
pub use verdict::{Alternative, Evidence, Finding, FoundParameter, Outcome, Verdict};
