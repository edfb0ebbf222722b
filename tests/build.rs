//! Compiles every spec that is to compile, as a user's build script does.

use std::fs;
use std::path::{Path, PathBuf};

use robot_model_codegen::base::shape_values;
use robot_model_codegen::{Compiled, compile_model, emit};
use robot_model_spec::Model;

/// Specs whose pages are written for one arm too, `baked_NAME.rs`.
const BAKED: [&str; 3] = ["puma560", "memory", "phantom"];

fn main() {
    for folder in ["specs/pass", "specs/run"] {
        println!("cargo:rerun-if-changed={folder}");
        let files = fs::read_dir(folder).expect("the folder is in the repository");
        let mut specs: Vec<PathBuf> = files
            .map(|file| file.expect("a readable folder").path())
            .collect();
        specs.sort();
        for spec in specs {
            robot_model_codegen::compile(spec).unwrap();
        }
    }
    for name in BAKED {
        bake(name);
    }
    // For shows of control: friction that falls with speed, and no coupling of the wrist's gears.
    let puma = load("puma560", |text| {
        text.replace(
            "gear_coupling on (wrist_pitch, wrist_yaw)",
            "stribeck on all",
        )
    });
    write("puma560_stribeck", &compile_model(&puma));
}

/// A spec of `specs/pass`, its text edited.
fn load(name: &str, edit: impl Fn(&str) -> String) -> Model {
    let text =
        fs::read_to_string(format!("specs/pass/{name}.robot")).expect("a spec of the repository");
    robot_model_spec::load(name, &edit(&text)).unwrap_or_else(|errors| panic!("{errors}"))
}

/// The page of an arm for `include_robot!`.
fn write(name: &str, arm: &Compiled) {
    let page = emit::rust::module(arm);
    let out = std::env::var_os("OUT_DIR").expect("cargo says where");
    fs::write(Path::new(&out).join(format!("{name}.rs")), page).expect("a writable folder");
}

/// Numbers without meaning for the base parameters, some of them zero; the spec's for shapes.
fn bake(name: &str) {
    let model = load(name, str::to_owned);
    let compiled = compile_model(&model);
    let beta: Vec<f64> = (0..compiled.base.kept.len())
        .map(|k| match k % 4 {
            3 => 0.0,
            _ => 0.3 + 0.25 * (1.7 * k as f64).sin(),
        })
        .collect();
    let baked = compiled.baked(&beta, &shape_values(&model));
    let baked = baked.unwrap_or_else(|error| panic!("{error}"));
    write(&format!("baked_{name}"), &baked);
}
