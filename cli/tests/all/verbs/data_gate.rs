//! `trace`: faults of the logs come before effects of the arm.

use serde_json::Value;

use crate::verbs::common::{CART, Folder, cart_log, cart_with, json};
use crate::verbs::delays::{late, late_columns};

const TRACE: [&str; 9] = [
    "trace",
    "cart.robot",
    "log.csv",
    "--validate",
    "other.csv",
    "--json",
    "out.json",
    "--amend",
    "found.robot",
];

#[test]
fn torque_that_is_late_is_a_delay_and_no_effect_of_the_arm() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    folder.write("log.csv", &late(&cart_log(20, 0.0, 0.0), 4));
    folder.write("other.csv", &late(&cart_log(20, 0.0, 0.7), 4));
    let told = folder.succeed(&TRACE);
    assert!(
        told.starts_with("explained:\n  time-delay: torque is late"),
        "{told}"
    );
    let out = json(&folder.read("out.json"));
    let [effect] = &out["effects"].as_array().expect("a list")[..] else {
        panic!("{out}");
    };
    assert_eq!(
        (
            &out["outcome"],
            &effect["kind"],
            &effect["joint"],
            &effect["evidence"]
        ),
        (
            &"explained".into(),
            &"time-delay".into(),
            &Value::Null,
            &Value::Null
        )
    );
    let delay = effect["parameters"][0]["value"].as_f64().expect("a value");
    assert!((delay - 0.02).abs() < 1e-4, "{delay}");
    let error = |key: &str| out[key][0].as_f64().expect("a number");
    assert!(error("rmse_after") < 0.3 * error("rmse_before"), "{out}");
    // The amended spec has the delay and is done with it.
    assert!(
        folder
            .read("found.robot")
            .contains("time_delay(delay = 0.02"),
        "{told}"
    );
    let again = folder.succeed(&["trace", "found.robot", "log.csv"]);
    assert!(again.starts_with("nothing missing"), "{again}");
}

/// No effect of the arm, and nothing that a spec could declare.
#[test]
fn a_late_encoder_is_a_fault_of_the_log() {
    let folder = crate::verbs::payload::folder("");
    let log = folder.read("empty.csv");
    folder.write(
        "late.csv",
        &late_columns(&log, 20, |name| name.ends_with("q2")),
    );
    let told = folder.succeed(&["trace", "arm.robot", "late.csv", "--json", "out.json"]);
    assert!(
        told.contains("time-delay: the position of") && told.contains("is late against"),
        "{told}"
    );
    let out = json(&folder.read("out.json"));
    let [effect] = &out["effects"].as_array().expect("a list")[..] else {
        panic!("{out}");
    };
    assert_eq!(
        (&effect["kind"], &effect["joint"]),
        (&"time-delay".into(), &2.into())
    );
}

#[test]
fn dry_friction_is_found_behind_a_delay() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    folder.write("log.csv", &late(&cart_log(40, 2.0, 0.0), 4));
    folder.write("other.csv", &late(&cart_log(20, 2.0, 0.7), 4));
    folder.succeed(&TRACE);
    let out = json(&folder.read("out.json"));
    let kinds: Vec<&Value> = (0..2).map(|k| &out["effects"][k]["kind"]).collect();
    assert_eq!(kinds, ["time-delay", "coulomb-friction"], "{out}");
}

#[test]
fn spikes_that_matter_are_corrupt_samples() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    folder.write("other.csv", &cart_log(20, 0.0, 0.7));
    let log = cart_log(20, 0.0, 0.0);
    let rows = log.lines().enumerate().map(|(k, row)| {
        let (rest, _) = row.rsplit_once(',').expect("columns");
        let is_bad = k > 0 && k % 397 == 0;
        if is_bad {
            format!("{rest},400\n")
        } else {
            format!("{row}\n")
        }
    });
    folder.write("log.csv", &rows.collect::<String>());
    let told = folder.succeed(&TRACE);
    assert!(
        told.starts_with("explained:\n  corrupt-samples: log.csv: tau1"),
        "{told}"
    );
    assert_eq!(folder.read("found.robot"), CART);
    folder.write("log.csv", &log);
    assert!(folder.succeed(&TRACE).starts_with("nothing missing"));
}

/// A bad sample that is little beside what the arm lacks is mended and said, and explains nothing.
#[test]
fn a_spike_that_does_not_matter_is_a_note() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    let log = cart_log(40, 2.0, 0.0);
    let spiked = log.lines().map(|row| match row.strip_prefix("10.000,") {
        Some(rest) => {
            let (q, _) = rest.split_once(',').expect("columns");
            format!("10.000,{q},25\n")
        }
        None => format!("{row}\n"),
    });
    folder.write("log.csv", &spiked.collect::<String>());
    let run = folder.run(&["trace", "cart.robot", "log.csv", "--json", "out.json"]);
    assert!(
        run.stderr.contains("tau1: 1 samples are far from both"),
        "{}",
        run.stderr
    );
    let out = json(&folder.read("out.json"));
    let effects = out["effects"].as_array().expect("a list");
    assert_eq!(effects.len(), 1, "{out}");
    assert_eq!(effects[0]["kind"], "coulomb-friction");
}

/// A log whose torque went through a filter of the first order at `hz`, and its positions did not.
fn smoothed(log: &str, rate: f64, hz: f64) -> String {
    let kept = (-std::f64::consts::TAU * hz / rate).exp();
    let mut state = None;
    let rows = log.lines().enumerate().map(|(k, row)| {
        let (rest, tau) = row.rsplit_once(',').expect("columns");
        if k == 0 {
            return format!("{row}\n");
        }
        let tau: f64 = tau.parse().expect("a number");
        let next = state.map_or(tau, |state: f64| kept * state + (1.0 - kept) * tau);
        state = Some(next);
        format!("{rest},{next:.9}\n")
    });
    rows.collect()
}

/// Torque behind a low-pass is round where a joint turns. No law of friction is, and none is named.
#[test]
fn torques_behind_a_low_pass_are_corrupt_samples_and_no_law_of_friction() {
    let folder = Folder::new();
    let declared = CART.replace(
        "viscous_friction",
        "coulomb_friction on rail; viscous_friction",
    );
    folder.write("cart.robot", &declared);
    let raw = |phase| cart_log(40, 4.0, phase);
    folder.write("log.csv", &smoothed(&raw(0.0), 200.0, 4.0));
    folder.write("other.csv", &smoothed(&raw(0.7), 200.0, 4.0));
    let told = folder.succeed(&TRACE);
    assert!(
        told.starts_with(
            "explained:\n  corrupt-samples: log.csv: torques, but not positions, were low-pass"
        ),
        "{told}"
    );
    let out = json(&folder.read("out.json"));
    assert_eq!(out["outcome"], "explained", "{out}");
    assert_eq!(out["effects"].as_array().map(Vec::len), Some(1), "{out}");
    folder.write("log.csv", &raw(0.0));
    folder.write("other.csv", &raw(0.7));
    assert!(folder.succeed(&TRACE).starts_with("nothing missing"));
}

/// Dry friction that goes over from one side to the other within some millimeters a second is no bristles.
#[test]
fn a_joint_that_creeps_where_it_turns_lacks_nothing() {
    let folder = Folder::new();
    let declared = CART.replace(
        "viscous_friction",
        "coulomb_friction on rail; viscous_friction",
    );
    folder.write("cart.robot", &declared);
    let slow = |phase| {
        [
            [0.2, 0.5, phase],
            [0.05, 1.1, 1.0 + phase],
            [0.02, 1.9, 2.0],
        ]
    };
    let creeping = |width: f64, phase| {
        cart_with(200, 80, &slow(phase), move |_, dq| {
            4.0 * (dq / width).tanh()
        })
    };
    // An encoder of a micrometer.
    let encoded = |log: &str| -> String {
        let rows = log.lines().enumerate().map(|(k, row)| {
            let mut fields: Vec<String> = row.split(',').map(str::to_owned).collect();
            if k > 0 {
                let q: f64 = fields[1].parse().expect("a number");
                fields[1] = format!("{q:.6}");
            }
            fields.join(",") + "\n"
        });
        rows.collect()
    };
    let exact = |log: &str| log.to_owned();
    // The last is 2.4 % of the speed, which a cart that is slow has.
    let encoded = &encoded as &dyn Fn(&str) -> String;
    for (measured, width) in [(encoded, 0.0006), (&exact, 0.0006), (encoded, 0.002)] {
        folder.write("log.csv", &measured(&creeping(width, 0.0)));
        folder.write("other.csv", &measured(&creeping(width, 0.7)));
        let told = folder.succeed(&TRACE);
        assert!(told.starts_with("nothing missing"), "{told}");
        let out = json(&folder.read("out.json"));
        let speed = out["turn_speeds"][0].as_f64().expect("a number");
        assert!((speed - width).abs() < width / 6.0, "{speed}");
    }
}
