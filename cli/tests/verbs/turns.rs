//! Rows around the turns of joints with dry friction are left out: intervals hold the truth of arms that move under a controller.

use crate::common::{Folder, json};
use crate::payload::folder;

/// The truth of the arm of `payload`.
const TRUTH: [(&str, f64); 10] = [
    ("up.mxr", 1.0),
    ("up.my", 0.0),
    ("up.izzr", -0.575),
    ("lo.mxr", 0.2),
    ("lo.my", 0.0),
    ("lo.izzr", -0.1),
    ("up.viscous_friction.fv", 1.0),
    ("lo.viscous_friction.fv", 0.5),
    ("up.coulomb_friction.fc", 1.5),
    ("lo.coulomb_friction.fc", 0.7),
];

const RUNS: usize = 48;

/// Errors over their deviations, as in [`TRUTH`], of a log with encoders of 14 bits and its own noise.
fn errors(folder: &Folder, run: usize) -> Vec<f64> {
    let (log, fit, seed) = (
        format!("log{run}.csv"),
        format!("fit{run}.json"),
        format!("{}", 100 + run),
    );
    let motion = ["--trajectory", "wanted.csv", "--parameters", "empty.json"];
    let noise = ["--encoder-bits", "14", "--torque-noise", "0.02"];
    let out = ["--seed", seed.as_str(), "--out", log.as_str()];
    folder.succeed(&[&["simulate", "arm.robot"][..], &motion, &noise, &out].concat());
    let said = folder.succeed(&["identify", "arm.robot", &log, "--json", &fit]);
    let fit = json(&folder.read(&fit));
    let turns = fit["samples_at_turns"].as_array().expect("a list");
    assert_eq!(turns.len(), 2);
    for (turns, joint) in turns.iter().zip(["up", "lo"]) {
        let turns = turns.as_u64().expect("a count");
        assert!(turns > 50, "{turns}");
        assert!(said.contains(&format!("{joint} {turns}")), "{said}");
    }
    let found = fit["parameters"].as_array().expect("a list");
    let of = found.iter().zip(TRUTH).map(|(parameter, (name, truth))| {
        assert_eq!(parameter["name"], name);
        let number = |key: &str| parameter[key].as_f64().expect("a number");
        (number("value") - truth) / number("std")
    });
    of.collect()
}

#[test]
fn intervals_hold_the_truth_where_joints_stick_and_encoders_have_steps() {
    let folder = folder("");
    let half = |first: usize| -> Vec<Vec<f64>> {
        let runs = (first..RUNS).step_by(2);
        runs.map(|run| errors(&folder, run)).collect()
    };
    let all = std::thread::scope(|scope| {
        let other = scope.spawn(|| half(1));
        let mut all = half(0);
        all.extend(other.join().expect("no panic"));
        all
    });
    let held = all.iter().flatten().filter(|z| z.abs() < 1.96).count();
    let share = held as f64 / (RUNS * TRUTH.len()) as f64;
    assert!((0.90..=0.98).contains(&share), "{share}");
    for (k, (name, _)) in TRUTH.iter().enumerate() {
        let mean = all.iter().map(|z| z[k]).sum::<f64>() / RUNS as f64;
        assert!(mean.abs() < 1.0, "{name}: {mean}");
    }
}
