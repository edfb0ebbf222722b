//! Emitted code in a program without `std`, allocator and panics: built, linked and run.
//!
//! The program's panic handler calls a function that does not exist. It links only if no path of the code that it calls ends in
//! a panic.

use std::fs;
use std::path::Path;
use std::process::Command;

use robot_model_tests::specs;

/// Friction that depends on the load: its accelerations take Newton's method.
const LOADED: &str = "robot Loaded {
    gravity = [0, -9.81, 0];
    convention = standard_dh;
    joint first: revolute { a = 0.4; alpha = 0; d = 0; }
    joint second: prismatic { a = 0; alpha = 0; theta = 0; }
    effects { load_dependent_friction on all; coulomb_friction on all; }
}
";

/// With an arm of links and one whose effects remember. Small: an arm of seven joints has more of the same.
const SPECS: [&str; 3] = ["two_link", "loaded", "memory"];

const MAIN: &str = r#"
#![no_std]
#![no_main]

use core::hint::black_box;

use robot_model::scalar::{Dual, Lanes4};
use robot_model::{FromParameters, Kinematics, Mechanics, Memory, Scalar, State, Vector};

mod two_link {
    robot_model::include_robot!("two_link");
}
mod loaded {
    robot_model::include_robot!("loaded");
}
mod memory {
    robot_model::include_robot!("memory");
}

#[link(name = "c")]
unsafe extern "C" {
    fn a_path_that_panics() -> !;
}

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    unsafe { a_path_that_panics() }
}

/// A number that depends on every function of the arm in the scalar `N`; its zeros and ones are opaque to the optimizer.
#[inline(never)]
fn everything<
    R,
    N: Scalar,
    const D: usize,
    const S: usize,
    const B: usize,
    const H: usize,
    const M: usize,
    const I: usize,
>() -> f64
where
    R: FromParameters<D, S, B, H, M, I> + Mechanics<D, S, B, H, M, I>,
{
    let some = |value: f64| N::of(black_box(value));
    let arm = R::from_parameters(&Vector::from_element(black_box(0.3)), &Vector::from_element(black_box(0.2)));
    let state = State {
        q: nalgebra::SVector::from_element(some(0.1)),
        dq: nalgebra::SVector::from_element(some(0.2)),
        ddq: nalgebra::SVector::from_element(some(0.3)),
        rigid_torque: nalgebra::SVector::from_element(some(3.0)),
        measured_torque: nalgebra::SVector::from_element(some(3.0)),
        time: some(1.0),
        memory: nalgebra::SVector::from_element(some(0.1)),
        inputs: nalgebra::SVector::from_element(some(30.0)),
    };
    let (q, dq) = (&state.q, &state.dq);
    let mut sum = arm.inverse_dynamics_at(&state).sum() + arm.mass_matrix(q).sum() + arm.gravity(q).sum();
    sum += arm.coriolis_matrix(q, dq).sum() + arm.bias(q, dq).sum() + arm.kinetic_energy(q, dq) + arm.potential_energy(q);
    sum += arm.regressor_of_at(&state).sum() + arm.base_regressor_of_at(&state).sum();
    sum += arm.inverse_dynamics_by_position_at(&state).sum() + arm.inverse_dynamics_by_velocity_at(&state).sum();
    sum += R::momentum_regressor_at(&state, &arm.shapes()).sum() + R::drift_regressor_at(&state, &arm.shapes()).sum();
    if let Some(ddq) = arm.forward_dynamics_at(&state, dq) {
        sum += ddq.sum();
    }
    sum.most()
}

#[unsafe(no_mangle)]
pub extern "C" fn main() -> i32 {
    let mut sum = everything::<two_link::TwoLink, f64, _, _, _, _, _, _>();
    sum += everything::<two_link::TwoLink, Lanes4, _, _, _, _, _, _>();
    sum += everything::<loaded::Loaded, f64, _, _, _, _, _, _>();
    sum += everything::<loaded::Loaded, f32, _, _, _, _, _, _>();
    sum += everything::<memory::Memory, f64, _, _, _, _, _, _>();
    sum += everything::<memory::Memory, Dual, _, _, _, _, _, _>();
    let some = Vector::from_element(black_box(0.1));
    let arm = two_link::TwoLink::from_standard(&Vector::from_element(black_box(0.3)));
    sum += arm.jacobian(&some).sum() + arm.forward_kinematics(&some)[1].sum();
    let arm = memory::Memory::from_standard(&Vector::from_element(black_box(0.3)));
    let some = Vector::from_element(black_box(0.1));
    let state = State::new(some, some, some)
        .with_memory(Vector::from_element(black_box(0.1)))
        .with_inputs(Vector::from_element(black_box(0.1)));
    sum += arm.memory_after(&state, black_box(1e-3)).sum();
    if sum.is_finite() { 0 } else { 1 }
}
"#;

fn build(folder: &Path, main: &str) -> std::process::Output {
    fs::write(folder.join("src/main.rs"), main).expect("a writable folder");
    let target = Path::new(env!("CARGO_TARGET_TMPDIR"))
        .parent()
        .expect("a folder of the target directory");
    Command::new(env!("CARGO"))
        .args(["run", "--quiet", "--offline", "--release"])
        .current_dir(folder)
        .env("CARGO_TARGET_DIR", target)
        .output()
        .expect("cargo runs")
}

#[test]
fn a_program_without_std_links_without_a_panic() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    let workspace = Path::new(env!("CARGO_MANIFEST_DIR"))
        .parent()
        .expect("this crate is in a workspace");
    let write =
        |name: &str, text: &str| fs::write(folder.join(name), text).expect("a writable folder");
    fs::create_dir(folder.join("src")).expect("a writable folder");
    write("loaded.robot", LOADED);
    for name in ["two_link", "memory"] {
        write(
            &format!("{name}.robot"),
            &specs::named(&format!("pass/{name}")).text,
        );
    }
    write(
        "build.rs",
        &format!(
            "fn main() {{\n    for name in {SPECS:?} {{\n        robot_model_codegen::compile(&format!(\"{{name}}.robot\")).unwrap();\n    }}\n}}\n"
        ),
    );
    write(
        "Cargo.toml",
        &format!(
            r#"[package]
name = "firmware"
version = "0.0.0"
edition = "2024"

[dependencies]
robot-model = {{ path = '{}', default-features = false }}
nalgebra = {{ version = "0.35", default-features = false, features = ["libm"] }}

[build-dependencies]
robot-model-codegen = {{ path = '{}' }}

[profile.release]
panic = "abort"
lto = true
codegen-units = 1

[workspace]
"#,
            workspace.join("runtime").display(),
            workspace.join("codegen").display()
        ),
    );
    // The same versions of everything, from the registry's cache.
    fs::copy(workspace.join("Cargo.lock"), folder.join("Cargo.lock"))
        .expect("the workspace has a lock file");

    let output = build(folder, MAIN);
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{errors}");

    // The test can fail: an index that is not known to be in range.
    let main = MAIN.replace(
        "    if sum.is_finite()",
        "    sum += [1.0, 2.0][black_box(1_usize)];\n    if sum.is_finite()",
    );
    let output = build(folder, &main);
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(
        !output.status.success() && errors.contains("a_path_that_panics"),
        "{errors}"
    );
}
