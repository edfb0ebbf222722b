//! `robot-model`: write an arm down once, identify it, find what the model lacks.

use std::process::ExitCode;

fn main() -> ExitCode {
    robot_model_cli::main()
}
