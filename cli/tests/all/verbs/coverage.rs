//! Whether what is found is within what its deviations say, over draws of noise and with coarse encoders.

use std::fmt::Write;

use serde_json::Value;

use crate::verbs::common::{Folder, json, white};
use crate::verbs::payload;
use crate::verbs::turns::TRUTH;

/// Three joints whose axes have all directions.
const SPATIAL: &str = "robot Spatial {
    gravity = [0, 0, -9.81];
    convention = standard_dh;
    joint a: revolute { a = 0; alpha = 90 deg; d = 0.3; }
    joint b: revolute { a = 0.4; alpha = 0; d = 0.1; }
    joint c: revolute { a = 0.1; alpha = -90 deg; d = 0; }
    link a { mass = 3; com = [0, -0.1, 0.02]; inertia = [0.03, 0, 0, 0.02, 0, 0.03]; }
    link b { mass = 2; com = [-0.2, 0, 0.05]; inertia = [0.005, 0, 0, 0.04, 0, 0.04]; }
    link c { mass = 1; com = [-0.05, 0.02, 0.1]; inertia = [0.02, 0, 0, 0.02, 0, 0.005]; }
    effects { viscous_friction on all; }
}
";

/// A body on the last link: 0.8 kg, 0.1 m, -0.05 m and 0.15 m from the frame's origin.
const BODY: [(&str, f64); 10] = [
    ("m", 0.8),
    ("mx", 0.08),
    ("my", -0.04),
    ("mz", 0.12),
    ("ixx", 0.03),
    ("ixy", 0.004),
    ("ixz", -0.012),
    ("iyy", 0.03),
    ("iyz", 0.006),
    ("izz", 0.02),
];

const FRICTION: &str =
    r#""a.viscous_friction.fv": 2.0, "b.viscous_friction.fv": 1.5, "c.viscous_friction.fv": 0.5"#;

/// A motion of all three joints.
fn wanted(phase: f64) -> String {
    let mut text = String::from("time,q1,q2,q3\n");
    for k in 0..=2000 {
        let t = f64::from(k) / 200.0;
        let a = 0.8 * (1.1 * t + phase).sin() + 0.2 * (4.3 * t).sin();
        let b = -0.6 + 0.7 * (1.7 * t + 2.0 * phase).sin() + 0.2 * (5.1 * t).cos();
        let c = 0.8 * (2.3 * t + phase).sin() + 0.3 * (3.7 * t + 1.0).cos();
        writeln!(text, "{t},{a},{b},{c}").expect("a string takes all");
    }
    text
}

/// A log with white noise of 0.06 N m on every torque.
fn noisy(log: &str, state: &mut u64) -> String {
    let mut lines = log.lines();
    let header = lines.next().expect("a header");
    let is_torque: Vec<bool> = header
        .split(',')
        .map(|name| name.starts_with("tau"))
        .collect();
    let mut text = format!("{header}\n");
    for line in lines {
        let fields = line.split(',').zip(&is_torque).map(|(field, is_torque)| {
            if !is_torque {
                return field.to_owned();
            }
            let torque: f64 = field.parse().expect("a number");
            (torque + 0.2 * white(state)).to_string()
        });
        let fields: Vec<String> = fields.collect();
        writeln!(text, "{}", fields.join(",")).expect("a string takes all");
    }
    text
}

/// Its error over its deviation.
fn error(of: &Value, name: &str, truth: f64) -> f64 {
    let found = payload::parameter(of, name);
    let number = |key: &str| found[key].as_f64().expect("told");
    (number("value") - truth) / number("std")
}

#[test]
fn intervals_of_a_payload_in_space_hold_it() {
    const DRAWS: usize = 30;
    let folder = Folder::new();
    folder.write("arm.robot", SPATIAL);
    let loaded = SPATIAL.replace(
        "viscous_friction on all;",
        "viscous_friction on all; payload on c;",
    );
    folder.write("loaded.robot", &loaded);
    folder.write("arm.json", &format!("{{{FRICTION}}}"));
    let body = BODY.map(|(name, value)| format!(r#""c.payload.{name}": {value}"#));
    folder.write(
        "loaded.json",
        &format!("{{{FRICTION}, {}}}", body.join(", ")),
    );
    for (name, phase) in [("arm", 0.4), ("loaded", 2.1)] {
        folder.write("wanted.csv", &wanted(phase));
        let (spec, values, log) = (
            format!("{name}.robot"),
            format!("{name}.json"),
            format!("{name}.csv"),
        );
        let motion = ["--trajectory", "wanted.csv", "--rate", "500", "--out", &log];
        folder.succeed(&[&["simulate", &spec, "--parameters", &values][..], &motion].concat());
    }
    let mut state = 7;
    let (mut held, mut centers) = (0, 0);
    for _ in 0..DRAWS {
        for log in ["arm.csv", "loaded.csv"] {
            let text = noisy(&folder.read(log), &mut state);
            folder.write(&format!("noisy_{log}"), &text);
        }
        let identify = [
            "identify",
            "arm.robot",
            "noisy_arm.csv",
            "--json",
            "fit.json",
        ];
        folder.succeed(&[&identify[..], &["--payload", "noisy_loaded.csv"]].concat());
        let fit = json(&folder.read("fit.json"));
        let errors =
            BODY.map(|(name, truth)| error(&fit["payload"], &format!("c.payload.{name}"), truth));
        held += errors.iter().filter(|z| z.abs() < 1.96).count();
        for (axis, (_, moment)) in BODY[1..4].iter().enumerate() {
            let number = |key: &str| fit["payload"][key][axis].as_f64().expect("told");
            let error = number("center") - moment / BODY[0].1;
            centers += usize::from(error.abs() < 1.96 * number("center_std"));
        }
    }
    let share = |held: usize, of: usize| held as f64 / (DRAWS * of) as f64;
    for share in [share(held, BODY.len()), share(centers, 3)] {
        assert!((0.8..=0.99).contains(&share), "{share}");
    }
}

/// Steps of 1.5 mrad, as a small encoder has them.
#[test]
fn what_encoders_of_twelve_bits_tell_is_within_its_deviations() {
    let folder = payload::folder("");
    let motion = ["--trajectory", "wanted.csv", "--parameters", "empty.json"];
    let sensors = ["--encoder-bits", "12", "--torque-noise", "0.02"];
    for seed in ["1", "2", "3", "4"] {
        let out = ["--seed", seed, "--out", "coarse.csv"];
        folder.succeed(&[&["simulate", "arm.robot"][..], &motion, &sensors, &out].concat());
        let identify = ["identify", "arm.robot", "coarse.csv", "--method", "wls"];
        folder.succeed(&[&identify[..], &["--json", "fit.json"]].concat());
        let fit = json(&folder.read("fit.json"));
        for (name, truth) in TRUTH {
            let z = error(&fit, name, truth);
            assert!(z.abs() < 3.0, "{name} of seed {seed}: {z} deviations");
        }
    }
}
