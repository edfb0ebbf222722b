//! Compiles `arm.robot`, with the numbers of `arm.json` in its equations, to `OUT_DIR/arm.rs`, which `src/lib.rs` includes.

fn main() {
    robot_model_codegen::compile_with("arm.robot", "arm.json").unwrap();
}
