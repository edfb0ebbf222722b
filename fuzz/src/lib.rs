//! A fuzzer of all that reads files: the compiler, from spec text to emitted Rust, and the readers of logs, URDFs and JSON.
//!
//! Stable Rust, no instrumentation: inputs are sound files, damaged and spliced along their own grammar, and what the reader
//! answers (which diagnostics, which size of model) takes the place of coverage. An input with an answer not seen before is
//! damaged further. A [kind](kind::Kind) of files is one module: what is sound, and what has to hold of whatever is read.

pub mod answer;
mod bytes;
pub mod damage;
mod forms;
pub mod json;
pub mod kind;
mod log;
pub mod minimize;
pub mod mutate;
mod oracle;
pub mod run;
mod urdf;
