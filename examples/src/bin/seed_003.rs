//! One joint with the `LuGre` model's friction: what the paper identifies, and what its equations and numbers come to.

use std::process::ExitCode;

use robot_model_examples::{paper, seed_003};

fn main() -> ExitCode {
    paper::main("seed_003", seed_003::run)
}
