//! A fuzzer of the compiler, from spec text to emitted Rust.
//!
//! Stable Rust, no instrumentation: inputs are specs of this repository, damaged and spliced along their own grammar, and
//! what the compiler answers (which diagnostics, which size of model) takes the place of coverage. An input with an answer
//! not seen before is damaged further.

pub mod answer;
pub mod damage;
mod forms;
pub mod minimize;
pub mod mutate;
mod oracle;
pub mod run;
