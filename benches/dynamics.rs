//! `cargo bench --bench dynamics -- --json FILE`

use std::path::Path;
use std::process::ExitCode;

fn main() -> ExitCode {
    robot_model_benches::run(&Path::new(env!("CARGO_TARGET_TMPDIR")).join("dynamics"))
}
