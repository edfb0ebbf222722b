//! Compiles every spec that is to compile, as a user's build script does.

use std::fs;
use std::path::PathBuf;

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
}
