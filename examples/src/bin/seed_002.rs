//! Liu et al. (a ROKAE arm): friction with a cubic law, weighted least squares, Hadamard's bound, hand guiding.

use std::process::ExitCode;

use robot_model_examples::{paper, seed_002};

fn main() -> ExitCode {
    paper::main("seed_002", seed_002::run)
}
