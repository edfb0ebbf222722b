//! Taati, Tahmasebi and Hashtrudi-Zaad (PHANTOM): identification without accelerations, friction traced, control, contact.

use std::process::ExitCode;

use robot_model_examples::{paper, seed_004};

fn main() -> ExitCode {
    paper::main("seed_004", seed_004::run)
}
