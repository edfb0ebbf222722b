//! `identify --payload --payload-mass`: gains of the drives, by a payload that was weighed.

use std::fmt::Write;

use serde_json::Value;

use crate::verbs::common::{Folder, json, numbers};
use crate::verbs::payload::{PAYLOAD, folder, parameter, spec};

/// Of the drives, N m/A.
const GAINS: [f64; 2] = [12.5, -0.7];

const IDENTIFY: [&str; 5] = [
    "identify",
    "drives.robot",
    "empty.csv",
    "--payload",
    "loaded.csv",
];

/// A log with what the drives have in place of torques.
fn in_amperes(log: &str) -> String {
    let mut lines = log.lines();
    let header: Vec<&str> = lines.next().expect("a header").split(',').collect();
    let mut text = header.join(",") + "\n";
    for line in lines {
        let fields = line.split(',').zip(&header).map(|(field, name)| {
            let gain = match *name {
                "tau1" => GAINS[0],
                "tau2" => GAINS[1],
                _ => return field.to_owned(),
            };
            let torque: f64 = field.parse().expect("a number");
            format!("{}", torque / gain)
        });
        let fields: Vec<String> = fields.collect();
        writeln!(text, "{}", fields.join(",")).expect("a string takes all");
    }
    text
}

/// The arm of `payload`, whose drives log currents, with gains of 1 N m/A in its spec.
fn driven(more: &str) -> Folder {
    let folder = folder(more);
    for log in ["empty.csv", "loaded.csv", "other.csv"] {
        folder.write(log, &in_amperes(&folder.read(log)));
    }
    let gains = spec(more).replace("d = 0; }", "d = 0; actuator_gain = 1 Nm/A; }");
    let log = "log { tau = \"tau1\": A, \"tau2\": A; } effects {";
    folder.write("drives.robot", &gains.replace("effects {", log));
    folder
}

fn is_near(found: &Value, std: &Value, truth: f64, share: f64) {
    let found = found.as_f64().expect("told");
    let std = std.as_f64().expect("told");
    assert!(
        (found - truth).abs() < 4.0 * std && std < share * truth.abs(),
        "{found} +- {std} for {truth}"
    );
}

#[test]
fn a_weighed_payload_tells_the_gains_of_all_drives() {
    let center = [PAYLOAD[1].1 / PAYLOAD[0].1, PAYLOAD[2].1 / PAYLOAD[0].1];
    let center = format!("{},{},0", center[0], center[1]);
    for (more, center) in [
        ("", None),
        ("", Some(center.as_str())),
        ("load_dependent_friction on all;", None),
    ] {
        let folder = driven(more);
        let mass = ["--payload-mass", "0.8", "--validate", "other.csv"];
        let mut arguments = [&IDENTIFY[..], &mass, &["--json", "fit.json"]].concat();
        arguments.extend(
            center
                .iter()
                .flat_map(|center| ["--payload-center", *center]),
        );
        let run = folder.run(&arguments);
        assert_eq!(run.code, Some(0), "{}", run.stderr);
        let fit = json(&folder.read("fit.json"));
        let gains = fit["drive_gains"].as_array().expect("a list");
        for ((gain, truth), joint) in gains.iter().zip(GAINS).zip(["up", "lo"]) {
            assert_eq!(
                (&gain["joint"], &gain["declared"]),
                (&joint.into(), &1.0.into())
            );
            is_near(&gain["actuator_gain"], &gain["std"], truth, 0.01);
        }
        let inertia = parameter(&fit["payload"], "lo.payload.izz");
        is_near(&inertia["value"], &inertia["std"], PAYLOAD[3].1, 0.1);
        let first = parameter(&fit, "up.mxr");
        is_near(&first["value"], &first["std"], 1.0, 0.01);
        let body = &fit["payload"];
        assert_eq!(body["mass"], 0.8);
        let x = body["center"][0].as_f64().expect("told");
        assert!((x - 0.15).abs() < 0.01, "{body}");
        for errors in [&body["relative_percent"], &fit["relative_percent_validate"]] {
            let most = numbers(errors).into_iter().fold(0.0, f64::max);
            assert!(most < 5.0, "{errors}");
        }
        assert!(run.stdout.contains("actuator_gain = 12."), "{}", run.stdout);
        assert!(
            run.stderr.contains("the gain of lo is negative: its drive")
                && !run.stderr.contains("of up is"),
            "{}",
            run.stderr
        );
    }
}

#[test]
fn a_payload_that_is_elsewhere_is_noted() {
    let folder = driven("");
    let notes = |center: &str| {
        let known = ["--payload-mass", "0.8", "--payload-center", center];
        let run = folder.run(&[&IDENTIFY[..], &known].concat());
        assert_eq!(run.code, Some(0), "{}", run.stderr);
        run.stderr
    };
    let told = "the logs place the payload's center of mass elsewhere, m: x = 0.1";
    assert!(!notes("0.15,-0.0625,0").contains("elsewhere"));
    let said = notes("0.05,-0.0625,0");
    assert!(said.contains(told), "{said}");
}

#[test]
fn a_payload_that_tells_no_gain_is_refused() {
    let folder = driven("");
    let said = |more: &[&str]| folder.refuse(&[&IDENTIFY[..], more].concat());
    for (more, reason) in [
        (&["--payload-mass", "0"][..], "a positive number in kg"),
        (&["--payload-center", "0,0,1"], "--payload-mass"),
        (
            &["--payload-mass", "1", "--payload-center", "0,0"],
            "three numbers in m",
        ),
    ] {
        let run = folder.run(&[&IDENTIFY[..], more].concat());
        assert_eq!(run.code, Some(2), "{}", run.stdout);
        assert!(run.stderr.contains(reason), "{}", run.stderr);
    }
    // On the first link a mass alone does what first moments do.
    let inner = ["--payload-mass", "0.8", "--payload-link", "up"];
    assert!(said(&inner).contains("no drive's gain is identified"));
    // Logs that have no payload, and the log itself.
    folder.write("again.csv", &(folder.read("empty.csv") + "\n"));
    for (payload, told) in [
        ("again.csv", "do all of them have it"),
        (
            "empty.csv",
            "is the same log as empty.csv, which has no payload",
        ),
    ] {
        let nothing = [
            "identify",
            "drives.robot",
            "empty.csv",
            "--payload",
            payload,
        ];
        let said = folder.refuse(&[&nothing[..], &["--payload-mass", "0.8"]].concat());
        assert!(said.contains(told), "{said}");
    }
}
