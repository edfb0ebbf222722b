//! A PUMA's shoulder by output error: tables, figures, and what is wrong in them.

use std::process::ExitCode;

use robot_model_examples::{paper, seed_000};

fn main() -> ExitCode {
    paper::main("seed_000", seed_000::run)
}
