//! Compiles every spec that is to compile, as a user's build script does.

use std::fs;
use std::path::{Path, PathBuf};

use robot_model_codegen::base::shape_values;
use robot_model_codegen::{compile_model, emit};

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
}

/// Numbers without meaning for the base parameters, some of them zero; the spec's for shapes.
fn bake(name: &str) {
    let text =
        fs::read_to_string(format!("specs/pass/{name}.robot")).expect("a spec of the repository");
    let model = robot_model_spec::load(name, &text).unwrap_or_else(|errors| panic!("{errors}"));
    let compiled = compile_model(&model);
    let beta: Vec<f64> = (0..compiled.base.kept.len())
        .map(|k| match k % 4 {
            3 => 0.0,
            _ => 0.3 + 0.25 * (1.7 * k as f64).sin(),
        })
        .collect();
    let baked = compiled.baked(&beta, &shape_values(&model));
    let page = emit::rust::module(&baked.unwrap_or_else(|error| panic!("{error}")));
    let out = std::env::var_os("OUT_DIR").expect("cargo says where");
    fs::write(Path::new(&out).join(format!("baked_{name}.rs")), page).expect("a writable folder");
}
