//! Arms that are let go.

use serde_json::Value;

use super::{costs, value, wanted};
use crate::verbs::common::{Folder, json};

/// Two links that are let go, as in Trojanova et al., and their parameters.
fn falling() -> (Folder, [(&'static str, f64); 10]) {
    let folder = Folder::new();
    let spec = "robot Arm {
        gravity = [0, -9.81, 0];
        convention = standard_dh;
        joint up: revolute { a = 0.552; alpha = 0; d = 0; }
        joint lo: revolute { a = 0.4; alpha = 0; d = 0; }
        effects { viscous_friction on all; coulomb_friction on all; }
    }";
    folder.write("arm.robot", spec);
    // Of their table 6, about the ends of the links.
    let (m, l, c, i) = ([6.813, 3.361], [0.552, 0.4], [0.346, 0.212], [0.264, 0.012]);
    let about_end = |k: usize| i[k] + m[k] * (c[k] - l[k]) * (c[k] - l[k]) - l[k] * l[k] * m[k];
    let truth = [
        ("up.mxr", m[0] * c[0] + m[1] * l[0]),
        ("up.my", 0.0),
        ("up.izzr", about_end(0) - l[0] * l[0] * m[1]),
        ("lo.mxr", m[1] * c[1]),
        ("lo.my", 0.0),
        ("lo.izzr", about_end(1)),
        ("up.viscous_friction.fv", 0.335),
        ("lo.viscous_friction.fv", 0.279),
        ("up.coulomb_friction.fc", 0.203),
        ("lo.coulomb_friction.fc", 0.076),
    ];
    let write = |file: &str, factor: &dyn Fn(usize) -> f64| {
        let entries = truth.iter().enumerate();
        let entries: Vec<String> = entries
            .map(|(k, (name, value))| format!("\"{name}\": {}", value * factor(k)))
            .collect();
        folder.write(file, &format!("{{{}}}", entries.join(",")));
    };
    write("values.json", &|_| 1.0);
    write("start.json", &|k| match k {
        0 => 1.0,
        k if k % 2 == 0 => 1.1,
        _ => 0.93,
    });
    folder.write("wanted.csv", &wanted(1.5, &[&|_| -1.1, &|_| 0.3]));
    let motion = ["--trajectory", "wanted.csv", "--out", "log.csv"];
    let free = ["--controller", "none", "--rate", "200"];
    let values = ["--parameters", "values.json"];
    folder.succeed(&[&["simulate", "arm.robot"], &motion[..], &free, &values].concat());
    // What is weighed.
    let bounds = format!("{{\"up.mxr\": [{0}, {0}]}}", truth[0].1);
    folder.write("bounds.json", &bounds);
    (folder, truth)
}

#[test]
fn what_falls_freely_needs_a_start() {
    let (folder, _) = falling();
    let identify = ["identify", "arm.robot", "log.csv", "--method"];
    let run = folder.run(&[&identify[..], &["output-error"]].concat());
    assert_ne!(run.code, Some(0));
    let said = &run.stderr;
    assert!(
        said.contains("if the arm falls freely, give `--start`"),
        "{said}"
    );
    assert!(!said.contains("does the arm move"), "{said}");
}

/// Without a torque nothing tells how heavy they are.
#[test]
fn what_falls_freely_is_known_up_to_a_common_factor() {
    let (folder, truth) = falling();
    let basics = [
        "identify",
        "arm.robot",
        "log.csv",
        "--method",
        "output-error",
    ];
    let options = [
        "--start",
        "start.json",
        "--window",
        "9",
        "--json",
        "fit.json",
    ];
    let searches = [
        vec!["--search", "levenberg-marquardt"],
        vec!["--search", "trust-region"],
        vec!["--search", "trust-region", "--bounds", "bounds.json"],
    ];
    for (k, search) in searches.iter().enumerate() {
        let said = folder.succeed(&[&basics[..], &options, search].concat());
        let report = json(&folder.read("fit.json"));
        assert_eq!(report["is_converged"], true, "{said}");
        let fits = report["position"]["nrmse_fit_percent"].as_array();
        for fit in fits.expect("a list") {
            assert!(fit.as_f64().expect("a number") > 99.999, "{said}");
        }
        // The rest is known up to a factor, or with what is weighed altogether.
        assert_eq!(report["rank"], truth.len() - 1, "{said}");
        let directions = report["directions"].as_array().expect("a list");
        if k == 2 {
            assert_eq!(report["at_bounds"], serde_json::json!(["up.mxr"]));
            assert!(
                said.contains("held by a bound, not by the logs: `up.mxr`"),
                "{said}"
            );
            assert!(
                directions
                    .iter()
                    .all(|direction| direction["is_silent"] == false)
            );
            for (name, expected) in &truth[1..] {
                let [found, std] = value(&report, name).expect("a value");
                assert!(
                    (found - expected).abs() < 1e-3 && std > 0.0,
                    "{name}: {found}"
                );
            }
        } else {
            let silent = directions.last().expect("one");
            assert_eq!(silent["is_silent"], true, "{said}");
            assert_eq!(silent["is_common_factor"], true, "{said}");
            assert!(said.contains("a common factor of up.mxr,"), "{said}");
            // No value of any is claimed, however little it does.
            for (name, truth) in &truth {
                assert!(
                    *truth == 0.0 || value(&report, name).is_none(),
                    "{name}: {said}"
                );
            }
            // The last iterate has the ratios.
            let last = report["iterates"]
                .as_array()
                .and_then(|all| all.last())
                .expect("one");
            let found = last["values"].as_array().expect("a list");
            let found: Vec<f64> = found
                .iter()
                .map(|x| x.as_f64().expect("a number"))
                .collect();
            for (k, (name, expected)) in truth.iter().enumerate() {
                let ratio = found[k] / found[0] * truth[0].1;
                assert!(
                    (ratio - expected).abs() < 1e-3,
                    "{name}: {ratio} {expected}"
                );
            }
        }
        let costs = costs(&report);
        assert!(costs.len() >= 4, "{said}");
        let stages: Vec<&Value> = report["iterates"]
            .as_array()
            .expect("a list")
            .iter()
            .map(|iterate| &iterate["stage"])
            .collect();
        for (pair, stage) in costs.windows(2).zip(stages.windows(2)) {
            assert!(pair[1] <= pair[0] || stage[0] != stage[1], "{said}");
        }
    }
}
