//! The specs of this crate, by the folder that says what becomes of them.

use std::fs;
use std::path::{Path, PathBuf};

use robot_model_codegen::{Compiled, compile_model};
use robot_model_spec::Model;

/// A spec file.
#[derive(Debug, Clone)]
pub struct Spec {
    /// File name without its extension.
    pub name: String,
    /// Its text.
    pub text: String,
}

impl Spec {
    /// The checked model.
    #[must_use]
    pub fn model(&self) -> Model {
        robot_model_spec::load(&format!("{}.robot", self.name), &self.text)
            .unwrap_or_else(|errors| panic!("{errors}"))
    }

    /// Everything that is derived from it.
    #[must_use]
    pub fn compiled(&self) -> Compiled {
        compile_model(&self.model())
    }
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("specs")
}

/// All specs of a folder of `specs/`, by name.
#[must_use]
pub fn folder(fate: &str) -> Vec<Spec> {
    let files = fs::read_dir(root().join(fate)).expect("the folder is in the repository");
    let mut specs: Vec<Spec> = files
        .map(|file| file.expect("a readable folder").path())
        .filter(|path| {
            path.extension()
                .is_some_and(|extension| extension == "robot")
        })
        .map(|path| read(&path))
        .collect();
    specs.sort_by(|x, y| x.name.cmp(&y.name));
    specs
}

/// One spec: `named("pass/two_link")`.
#[must_use]
pub fn named(name: &str) -> Spec {
    read(&root().join(name).with_extension("robot"))
}

fn read(path: &Path) -> Spec {
    let stem = path.file_stem().expect("a spec has a name");
    Spec {
        name: stem.to_string_lossy().into_owned(),
        text: fs::read_to_string(path)
            .unwrap_or_else(|error| panic!("{}: {error}", path.display())),
    }
}
