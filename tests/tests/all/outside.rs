//! Both routes in a crate outside of this workspace: it is built and run, its specs change, and the change is seen.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const MAIN: &str = r#"
use robot_model::{FromParameters, Link, RobotModel, Vector};

mod generated {
    robot_model::include_robot!("pendulum");
}

#[derive(RobotModel)]
#[robot(file = "derived.robot")]
struct Derived {
    pivot: Link,
}

fn main() {
    // The mass at the tip: 1 kg at the length of the pendulum.
    let q = Vector::from([0.0]);
    let generated = generated::Pendulum::from_standard(&generated::Pendulum::NOMINAL.into());
    let derived = Derived::from_standard(&Derived::NOMINAL.into());
    println!("generated {:.3} derived {:.3}", generated.gravity(&q)[0], derived.gravity(&q)[0]);
}
"#;

fn pendulum(length: &str) -> String {
    format!(
        "robot Pendulum {{
    gravity = [0, -10, 0];
    convention = standard_dh;
    joint pivot: revolute {{ a = {length}; alpha = 0; d = 0; }}
    link pivot {{ mass = 1; com = [0, 0, 0]; inertia = [0, 0, 0, 0, 0, 0]; }}
}}
"
    )
}

/// The crate, and the target directory that it shares with this workspace: what both need is built once.
struct Outside {
    folder: tempfile::TempDir,
    target: PathBuf,
}

impl Outside {
    fn new() -> Self {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let workspace = Path::new(env!("CARGO_MANIFEST_DIR"))
            .parent()
            .expect("this crate is in a workspace");
        let target = Path::new(env!("CARGO_TARGET_TMPDIR"))
            .parent()
            .expect("a folder of the target directory");
        let outside = Self {
            target: target.to_owned(),
            folder,
        };
        let manifest = format!(
            r#"[package]
name = "outside"
version = "0.0.0"
edition = "2024"

[dependencies]
robot-model = {{ path = '{}', default-features = false, features = ["derive"] }}

[build-dependencies]
robot-model-codegen = {{ path = '{}' }}

[profile.dev]
opt-level = 1

[profile.dev.package."*"]
opt-level = 3

[workspace]
"#,
            workspace.join("runtime").display(),
            workspace.join("codegen").display()
        );
        outside.write("Cargo.toml", &manifest);
        outside.write(
            "build.rs",
            "fn main() {\n    robot_model_codegen::compile(\"specs/pendulum.robot\").unwrap();\n}\n",
        );
        outside.write("src/main.rs", MAIN);
        // The same versions of everything, from the registry's cache.
        fs::copy(
            workspace.join("Cargo.lock"),
            outside.folder.path().join("Cargo.lock"),
        )
        .expect("the workspace has a lock file");
        outside
    }

    fn write(&self, name: &str, text: &str) {
        let path = self.folder.path().join(name);
        fs::create_dir_all(path.parent().expect("a folder")).expect("a writable folder");
        fs::write(path, text).expect("a writable folder");
    }

    fn run(&self) -> Output {
        Command::new(env!("CARGO"))
            .args(["run", "--quiet", "--offline"])
            .current_dir(self.folder.path())
            .env("CARGO_TARGET_DIR", &self.target)
            .output()
            .expect("cargo runs")
    }

    #[track_caller]
    fn prints(&self, wanted: &str) {
        let output = self.run();
        let text = String::from_utf8_lossy(&output.stdout);
        let errors = String::from_utf8_lossy(&output.stderr);
        assert_eq!(text.trim(), wanted, "{errors}");
    }

    #[track_caller]
    fn refuses(&self, wanted: &str) {
        let output = self.run();
        let errors = String::from_utf8_lossy(&output.stderr);
        assert!(!output.status.success(), "a mistake is no failure");
        assert!(errors.contains(wanted), "{errors}");
    }
}

#[test]
fn a_crate_outside_of_the_workspace_follows_its_specs() {
    let outside = Outside::new();
    outside.write("specs/pendulum.robot", &pendulum("0.5"));
    outside.write("derived.robot", &pendulum("0.25"));
    outside.prints("generated 5.000 derived 2.500");

    outside.write("specs/pendulum.robot", &pendulum("0.7"));
    outside.prints("generated 7.000 derived 2.500");

    outside.write("derived.robot", &pendulum("0.9"));
    outside.prints("generated 7.000 derived 9.000");

    outside.write("derived.robot", &pendulum("30 deg"));
    outside.refuses("derived.robot:4:");

    outside.write("derived.robot", &pendulum("0.9"));
    outside.write("specs/pendulum.robot", &pendulum("30 deg"));
    outside.refuses("pendulum.robot:4:");

    outside.write("specs/pendulum.robot", &pendulum("0.1"));
    outside.prints("generated 1.000 derived 9.000");
}
