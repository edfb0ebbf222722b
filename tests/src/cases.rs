//! The benchmark cases that stand beside the repository: an arm's URDF, the effects it declares, its logs, what is wrong with it.

use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

use robot_model_cli::close_the_loop::Loop;
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
    /// The log to judge on.
    pub validate: PathBuf,
    /// What a trace is to say.
    pub key: Key,
}

/// What a trace is to say of a case, and how small its error can get.
#[derive(Debug, Clone, Deserialize)]
pub struct Key {
    /// The outcome that a trace is to have.
    pub expected_outcome: String,
    /// What is in the arm and not in its spec.
    pub effects: Vec<KeyEffect>,
    /// Other answers that count.
    accept: Vec<Accepted>,
    /// Joints, from 1, whose errors count; all where there are none.
    scored_joints: Vec<usize>,
    validate: Achievable,
}

/// An effect of a key.
#[derive(Debug, Clone, Deserialize)]
pub struct KeyEffect {
    /// Its kind, as `SCHEMA.md` has it.
    pub kind: String,
    joint: Option<usize>,
    joints: Option<Vec<usize>>,
    /// Its parameters, SI.
    #[serde(default)]
    pub params: serde_json::Map<String, serde_json::Value>,
}

#[derive(Debug, Clone, Deserialize)]
struct Accepted {
    outcome: Option<String>,
    kind: Option<String>,
    joint: Option<usize>,
    #[serde(rename = "for")]
    stands_for: Option<String>,
}

#[derive(Debug, Clone, Deserialize)]
struct Achievable {
    achievable_rms_validate: Vec<f64>,
}

/// Kinds that are the same in these logs.
const SAME: [[&str; 2]; 1] = [["asymmetric-coulomb", "torque-offset"]];

/// Kinds of the arm as a whole, wherever they are said to be.
pub const WITHOUT_JOINT: [&str; 5] = [
    "base-tilt",
    "payload",
    "time-delay",
    "external-force",
    "corrupt-samples",
];

impl KeyEffect {
    /// Joints, from 1; none of the arm as a whole.
    fn joints(&self) -> Vec<usize> {
        let one = || self.joint.into_iter().collect();
        self.joints.clone().unwrap_or_else(one)
    }
}

impl Key {
    /// Whether a trace says what the key says or accepts: the outcome, and where effects are named each of them and nothing else. `said` are
    /// kinds with joints from 1.
    #[must_use]
    pub fn is_met(&self, outcome: &str, said: &[(String, Vec<usize>)]) -> bool {
        let is_quiet = said.is_empty() || outcome == "explained";
        let accepts = |one: &Accepted| one.outcome.as_deref() == Some(outcome);
        if is_quiet && self.accept.iter().any(accepts) {
            return true;
        }
        if self.expected_outcome != "explained" {
            let stands = |said| self.accept.iter().any(|one| self.is_accepted(one, said));
            let is_accepted = outcome == "explained" && said.len() == 1 && stands(&said[0]);
            return is_accepted || (is_quiet && outcome == self.expected_outcome);
        }
        let mut left: Vec<_> = said.iter().collect();
        for effect in &self.effects {
            let Some(place) = left.iter().position(|said| self.stands_for(effect, said)) else {
                return false;
            };
            left.remove(place);
        }
        outcome == "explained" && left.is_empty()
    }

    fn stands_for(&self, effect: &KeyEffect, said: &(String, Vec<usize>)) -> bool {
        let own = effect.joints();
        let is_there = own.is_empty()
            || WITHOUT_JOINT.contains(&effect.kind.as_str())
            || said.1.iter().any(|joint| own.contains(joint));
        let is_same = self.is_same((&effect.kind, &own), (&said.0, &said.1));
        let of_it = |one: &&Accepted| one.stands_for.as_ref().is_none_or(|of| *of == effect.kind);
        let mut accepted = self.accept.iter().filter(of_it);
        (is_there && is_same) || accepted.any(|one| self.is_accepted(one, said))
    }

    /// Whether an answer is this one, which the key accepts.
    fn is_accepted(&self, one: &Accepted, (kind, joints): &(String, Vec<usize>)) -> bool {
        let own: Vec<usize> = one.joint.into_iter().collect();
        let is_there = own.is_empty()
            || WITHOUT_JOINT.contains(&kind.as_str())
            || joints.iter().any(|joint| own.contains(joint));
        let is_same = |wanted: &String| self.is_same((wanted, &own), (kind, joints));
        is_there && one.kind.as_ref().is_some_and(is_same)
    }

    /// Whether two laws are the same in these logs: a payload is an error of the last link.
    fn is_same(&self, one: (&str, &[usize]), other: (&str, &[usize])) -> bool {
        let last = [self.validate.achievable_rms_validate.len()];
        let tagged = |(kind, joints): (&str, &[usize])| {
            if kind == "link-inertial-error" && joints == last {
                "payload".to_owned()
            } else {
                kind.to_owned()
            }
        };
        let (one, other) = (tagged(one), tagged(other));
        let both = |same: &[&str; 2]| same.contains(&&*one) && same.contains(&&*other);
        one == other || SAME.iter().any(both)
    }

    /// Errors on the log to judge on over the least that they can be, of the worst joint that counts.
    #[must_use]
    pub fn over_achievable(&self, rmse: &[f64]) -> f64 {
        let all = 1..=rmse.len();
        let counts =
            |joint: &usize| self.scored_joints.is_empty() || self.scored_joints.contains(joint);
        let of_joint =
            |joint: usize| rmse[joint - 1] / self.validate.achievable_rms_validate[joint - 1];
        all.filter(counts).map(of_joint).fold(0.0, f64::max)
    }
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

/// What the loop says is missing: faults of the logs, and effects, with joints from 1.
#[must_use]
pub fn named(closed: &Loop) -> Vec<(String, Vec<usize>)> {
    let from_one = |joints: &[usize]| joints.iter().map(|joint| joint + 1).collect();
    let faults = closed.faults.iter();
    let faults = faults.map(|fault| (fault.kind.to_owned(), from_one(&fault.joints)));
    let findings = closed.verdict.findings.iter();
    let findings = findings.map(|one| (one.kind.clone(), from_one(&one.joints)));
    faults.chain(findings).collect()
}

/// All open cases, where they are there.
#[must_use]
pub fn open() -> Vec<Case> {
    shared::find("cases", "the open benchmark cases").map_or_else(Vec::new, |root| all(&root))
}

/// All cases with keys of a folder, a folder each.
///
/// # Panics
/// Where a file is missing or not as `SCHEMA.md` says.
#[must_use]
pub fn all(root: &Path) -> Vec<Case> {
    let folders = fs::read_dir(root).unwrap_or_else(|error| panic!("{}: {error}", root.display()));
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
        validate: folder.join("validate.csv.gz"),
        key,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn key(outcome: &str, effects: &str, accept: &str) -> Key {
        let text = format!(
            r#"{{"expected_outcome": "{outcome}", "effects": {effects}, "accept": {accept},
                "scored_joints": [2], "validate": {{"achievable_rms_validate": [1.0, 0.5]}}}}"#
        );
        serde_json::from_str(&text).unwrap_or_else(|error| panic!("{error}: {text}"))
    }

    fn said(kind: &str, joints: &[usize]) -> (String, Vec<usize>) {
        (kind.to_owned(), joints.to_vec())
    }

    #[test]
    fn an_answer_has_every_effect_of_its_key_and_no_other() {
        let key = key("explained", r#"[{"kind": "stribeck", "joint": 2}]"#, "[]");
        assert!(key.is_met("explained", &[said("stribeck", &[2])]));
        assert!(!key.is_met("explained", &[said("stribeck", &[1])]));
        assert!(!key.is_met("explained", &[said("backlash", &[2])]));
        let both = [said("stribeck", &[2]), said("stribeck", &[2])];
        assert!(!key.is_met("explained", &both));
        assert!(!key.is_met("unexplained", &[]));
        assert!((key.over_achievable(&[9.0, 0.6]) - 1.2).abs() < 1e-12);
    }

    #[test]
    fn what_a_key_accepts_counts() {
        let accept = r#"[{"kind": "backlash", "joint": 2, "for": "stribeck"}]"#;
        let explained = key("explained", r#"[{"kind": "stribeck", "joint": 2}]"#, accept);
        assert!(explained.is_met("explained", &[said("backlash", &[2])]));
        let silent = key("nothing-missing", "[]", r#"[{"outcome": "unexplained"}]"#);
        assert!(silent.is_met("unexplained", &[]) && silent.is_met("nothing-missing", &[]));
        assert!(!silent.is_met("explained", &[said("stribeck", &[2])]));
        let quiet = key(
            "nothing-missing",
            "[]",
            r#"[{"kind": "stribeck", "joint": 2}]"#,
        );
        assert!(quiet.is_met("explained", &[said("stribeck", &[2])]));
        assert!(!quiet.is_met("explained", &[said("stribeck", &[1])]));
        assert!(!quiet.is_met("unexplained", &[]));
    }

    #[test]
    fn the_arm_as_a_whole_has_no_joint() {
        let key = key("explained", r#"[{"kind": "payload", "joint": null}]"#, "[]");
        assert!(key.is_met("explained", &[said("payload", &[])]));
        // Of two links.
        assert!(key.is_met("explained", &[said("link-inertial-error", &[2])]));
        assert!(!key.is_met("explained", &[said("link-inertial-error", &[1])]));
    }
}
