//! Compiles `arm.robot` to `OUT_DIR/arm.rs`, which `src/lib.rs` includes.

fn main() {
    robot_model_codegen::compile("arm.robot").unwrap();
}
