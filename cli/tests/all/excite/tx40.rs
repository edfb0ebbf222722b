//! Staubli TX40: a motion in place of the one of its published log, at the same limits.

use std::path::{Path, PathBuf};
use std::process::Command;

use nalgebra::DMatrix;
use serde_json::{Value, json};

use crate::excite::{design, limited, number, spec};

/// The published log, where it is there.
fn log() -> Option<PathBuf> {
    let path = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../shared/data/tx40/identification.csv"
    );
    let found = Path::new(path).exists();
    if !found {
        eprintln!("not run: no log of a TX40 beside the repository");
    }
    found.then(|| path.into())
}

/// Means of 50 samples, which are 10 ms.
fn positions(log: &Path) -> Vec<[f64; 6]> {
    let text = std::fs::read_to_string(log).expect("a log");
    let rows: Vec<[f64; 6]> = text
        .lines()
        .skip(1)
        .map(|line| {
            let mut numbers = line.split(',').skip(1);
            std::array::from_fn(|_| {
                let number = numbers.next().expect("six positions");
                number.parse().expect("a number")
            })
        })
        .collect();
    let mean = |rows: &[[f64; 6]]| -> [f64; 6] {
        std::array::from_fn(|joint| {
            rows.iter().map(|row| row[joint]).sum::<f64>() / rows.len() as f64
        })
    };
    rows.chunks_exact(50).map(mean).collect()
}

/// Between the means, s.
const STEP: f64 = 0.01;

fn speed([before, _, after]: [f64; 3]) -> f64 {
    (after - before) / (2.0 * STEP)
}

fn bend([before, now, after]: [f64; 3]) -> f64 {
    (after - 2.0 * now + before) / (STEP * STEP)
}

/// Largest size of what `f` makes of neighbors.
fn most(rows: &[[f64; 6]], joint: usize, f: impl Fn([f64; 3]) -> f64) -> String {
    let of = |window: &[[f64; 6]]| f([window[0][joint], window[1][joint], window[2][joint]]).abs();
    let most = rows.windows(3).map(of).fold(0.0, f64::max);
    format!("{most:.6}")
}

#[test]
fn a_motion_at_the_limits_of_the_published_log_is_ten_times_better_conditioned() {
    let Some(log) = log() else { return };
    let folder = tempfile::tempdir().expect("a temporary folder");
    let rows = positions(&log);
    let joints = 0..6;
    let range = |joint: usize| {
        let all = rows.iter().map(|row| row[joint]);
        let low = all.clone().fold(f64::INFINITY, f64::min);
        format!("{low:.6} .. {:.6}", all.fold(f64::NEG_INFINITY, f64::max))
    };
    let limits = |f: &dyn Fn(usize) -> String| -> Vec<String> { joints.clone().map(f).collect() };
    let of_log = [
        ("position", limits(&range)),
        ("velocity", limits(&|joint| most(&rows, joint, speed))),
        ("acceleration", limits(&|joint| most(&rows, joint, bend))),
    ];
    let mut arm = spec("run/tx40");
    std::fs::write(folder.path().join("plain.robot"), &arm).expect("a file");
    for (what, limits) in &of_log {
        let limits: Vec<&str> = limits.iter().map(String::as_str).collect();
        arm = limited(&arm, what, &limits);
    }
    std::fs::write(folder.path().join("tx40.robot"), arm).expect("a file");

    let fit = run(
        folder.path(),
        &["identify", "plain.robot", log.to_str().expect("text")],
        "--json",
    );
    let noise: Vec<f64> = numbers(&fit["rmse"]);
    let published = condition(folder.path(), &rows, &noise);
    assert!(published > 1500.0, "{published}");
    let noise: Vec<String> = noise.iter().map(f64::to_string).collect();
    let settings = ["--period", "5", "--starts", "1", "--criterion", "condition"];
    let report = design(
        folder.path(),
        &[
            &["tx40.robot"],
            &settings[..],
            &["--noise", &noise.join(",")],
        ]
        .concat(),
    );
    assert!(number(&report, "max_violation") <= 0.0, "{report}");
    let ours = number(&report, "condition");
    assert!(ours < 0.1 * published, "{ours} {published}");
}

/// Condition number of the base regressor on the published motion, each joint's rows over its noise.
fn condition(folder: &Path, rows: &[[f64; 6]], noise: &[f64]) -> f64 {
    let state = |window: &[[f64; 6]]| {
        let of = |f: &dyn Fn([f64; 3]) -> f64| -> Vec<f64> {
            (0..6)
                .map(|joint| f([window[0][joint], window[1][joint], window[2][joint]]))
                .collect()
        };
        json!({ "q": of(&|[_, now, _]| now), "dq": of(&speed), "ddq": of(&bend) })
    };
    let states: Vec<Value> = rows.windows(3).map(state).collect();
    let states = json!({ "states": states }).to_string();
    std::fs::write(folder.join("states.json"), states).expect("a file");
    let eval = ["eval", "plain.robot", "--states", "states.json"];
    let regressors = run(
        folder,
        &[&eval[..], &["--parameters", "out.json"]].concat(),
        "",
    );
    let regressors = regressors["states"].as_array().expect("a list");
    let rows = regressors.iter().flat_map(|state| {
        let rows = state["base_regressor"].as_array().expect("a matrix");
        let weighted = |(row, noise): (&Value, &f64)| -> Vec<f64> {
            numbers(row).iter().map(|x| x / noise).collect()
        };
        rows.iter().zip(noise).map(weighted).collect::<Vec<_>>()
    });
    let rows: Vec<Vec<f64>> = rows.collect();
    let matrix = DMatrix::from_fn(rows.len(), rows[0].len(), |i, k| rows[i][k]);
    let singular = matrix.singular_values();
    singular.max() / singular.min()
}

fn numbers(list: &Value) -> Vec<f64> {
    let list = list.as_array().expect("a list");
    list.iter().map(|x| x.as_f64().expect("a number")).collect()
}

/// What a verb writes as JSON: to the file of an option, or to standard output where there is none.
fn run(folder: &Path, arguments: &[&str], option: &str) -> Value {
    let mut verb = Command::new(env!("CARGO_BIN_EXE_robot-model"));
    verb.current_dir(folder).args(arguments);
    if !option.is_empty() {
        verb.args([option, "out.json"]);
    }
    let output = verb.output().expect("the program starts");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{arguments:?}: {said}");
    let text = if option.is_empty() {
        String::from_utf8(output.stdout).expect("text")
    } else {
        std::fs::read_to_string(folder.join("out.json")).expect("a report")
    };
    serde_json::from_str(&text).expect("JSON")
}
