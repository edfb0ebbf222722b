//! Programs of their own that use the core of the runtime: no `std` in it, specs compiled by their build script, release.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use tempfile::TempDir;

/// A package in a temporary folder.
#[derive(Debug)]
pub struct Program {
    folder: TempDir,
    name: &'static str,
}

impl Program {
    /// Writes the package, all but its source; `specs` are names and texts.
    #[must_use]
    pub fn new(name: &'static str, specs: &[(&str, &str)]) -> Self {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let program = Self { folder, name };
        fs::create_dir(program.path("src")).expect("a writable folder");
        for (spec, text) in specs {
            program.write(&format!("{spec}.robot"), text);
        }
        let names: Vec<&str> = specs.iter().map(|(name, _)| *name).collect();
        program.write(
            "build.rs",
            &format!(
                "fn main() {{\n    for name in {names:?} {{\n        robot_model_codegen::compile(&format!(\"{{name}}.robot\")).unwrap();\n    }}\n}}\n"
            ),
        );
        let workspace = workspace();
        program.write(
            "Cargo.toml",
            &format!(
                r#"[package]
name = "{name}"
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
debug = "line-tables-only"

[workspace]
"#,
                workspace.join("runtime").display(),
                workspace.join("codegen").display()
            ),
        );
        // The same versions of everything, from the registry's cache.
        fs::copy(workspace.join("Cargo.lock"), program.path("Cargo.lock"))
            .expect("the workspace has a lock file");
        program
    }

    /// A file of the package.
    #[must_use]
    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// Builds the program from this source, and says how that went.
    #[must_use]
    pub fn build(&self, main: &str) -> Output {
        self.write("src/main.rs", main);
        Command::new(env!("CARGO"))
            .args(["build", "--quiet", "--offline", "--release"])
            .current_dir(self.folder.path())
            .env("CARGO_TARGET_DIR", target())
            .output()
            .expect("cargo runs")
    }

    /// What was built.
    #[must_use]
    pub fn executable(&self) -> PathBuf {
        target().join("release").join(self.name)
    }

    fn write(&self, name: &str, text: &str) {
        fs::write(self.path(name), text).expect("a writable folder");
    }
}

fn workspace() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .parent()
        .expect("this crate is in a workspace")
}

/// The target folder of the build that this crate belongs to.
fn target() -> PathBuf {
    let executable = std::env::current_exe().expect("a test is a program");
    // `target/PROFILE/deps/TEST`
    let folder = executable.ancestors().nth(3);
    folder
        .expect("cargo puts tests three folders deep")
        .to_owned()
}
