//! The benchmark cases that stand beside the repository: an arm's URDF, the effects it declares, its logs, what is wrong with it.

use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

use robot_model_spec::urdf::{ImportOptions, Inertials, import};
use serde::Deserialize;

use crate::shared;

/// A case.
#[derive(Debug, Clone)]
pub struct Case {
    /// Its name.
    pub name: String,
    /// The spec that import makes of it.
    pub spec: String,
    /// Degrees of freedom.
    pub dof: usize,
    /// The log to fit.
    pub identify: PathBuf,
    /// The outcome that a trace is to have.
    pub expected_outcome: String,
}

#[derive(Deserialize)]
struct Robot {
    dof: usize,
    gravity: [f64; 3],
    inertials: RobotInertials,
    declared: Vec<Declared>,
}

#[derive(Deserialize)]
struct RobotInertials {
    status: String,
}

#[derive(Deserialize)]
struct Declared {
    joint: usize,
    effects: Vec<String>,
}

#[derive(Deserialize)]
struct Key {
    expected_outcome: String,
}

/// All open cases, where they are there.
#[must_use]
pub fn open() -> Vec<Case> {
    let Some(root) = shared::find("cases", "the open benchmark cases") else {
        return Vec::new();
    };
    let folders = fs::read_dir(root).expect("a readable folder");
    let mut folders: Vec<PathBuf> = folders
        .map(|folder| folder.expect("a readable folder").path())
        .filter(|folder| folder.join("key.json").exists())
        .collect();
    folders.sort();
    folders.iter().map(|folder| read(folder)).collect()
}

fn read(folder: &Path) -> Case {
    let text = |file: &str| {
        let path = folder.join(file);
        fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
    };
    let robot: Robot = serde_json::from_str(&text("robot.json")).expect("as SCHEMA.md says");
    let key: Key = serde_json::from_str(&text("key.json")).expect("as SCHEMA.md says");
    let name = folder.file_name().expect("a case has a name");
    let name = name.to_string_lossy().into_owned();
    let mut effects = String::new();
    for declared in robot
        .declared
        .iter()
        .filter(|declared| !declared.effects.is_empty())
    {
        let names = declared.effects.join(",").replace('-', "_");
        write!(effects, "{}:{names};", declared.joint).expect("text takes any length");
    }
    let options = ImportOptions {
        effects,
        inertials: if robot.inertials.status == "known" {
            Inertials::Fixed
        } else {
            Inertials::Nominal
        },
        gravity: Some(robot.gravity),
        ..ImportOptions::default()
    };
    let imported =
        import(&text("robot.urdf"), &options).unwrap_or_else(|error| panic!("{name}: {error}"));
    Case {
        name,
        spec: imported.spec,
        dof: robot.dof,
        identify: folder.join("identify.csv.gz"),
        expected_outcome: key.expected_outcome,
    }
}
