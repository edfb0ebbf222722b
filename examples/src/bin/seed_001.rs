//! The pneumatic arm of two joints that is let go.

use std::process::ExitCode;

use robot_model_examples::{paper, seed_001};

fn main() -> ExitCode {
    paper::main("seed_001", seed_001::run)
}
