//! Torque that is not of the time of the position.

use std::fmt::Write;

use crate::verbs::common::{CART, Folder, cart_log, json};
use crate::verbs::elsewhere::{PENDULUM, swinging};

/// A log whose torques are so many samples late, or early where that is negative.
pub(crate) fn late(log: &str, samples: isize) -> String {
    late_columns(log, samples, |name| name.starts_with("tau"))
}

/// A log with some of its columns so many samples late.
pub(crate) fn late_columns(log: &str, samples: isize, is_late: impl Fn(&str) -> bool) -> String {
    let mut rows = log.lines().map(|row| row.split(',').collect::<Vec<&str>>());
    let header = rows.next().expect("a header");
    let rows: Vec<Vec<&str>> = rows.collect();
    let mut text = header.join(",") + "\n";
    for (k, row) in rows.iter().enumerate() {
        let before = k.checked_add_signed(-samples).and_then(|k| rows.get(k));
        if let Some(before) = before {
            let fields = header.iter().zip(row.iter().zip(before));
            let of = |(name, (now, before)): (&&str, (&&str, &&str))| {
                if is_late(name) {
                    (*before).to_owned()
                } else {
                    (*now).to_owned()
                }
            };
            let fields: Vec<String> = fields.map(of).collect();
            writeln!(text, "{}", fields.join(",")).expect("a string takes all");
        }
    }
    text
}

#[test]
fn torque_that_is_late_is_told_with_its_delay() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    let log = cart_log(20, 0.0, 0.0);
    for samples in [4, -4, 20] {
        let delay = 0.005 * f64::from(i32::try_from(samples).expect("small"));
        folder.write("log.csv", &late(&log, samples));
        let identify = ["identify", "cart.robot", "log.csv", "--json", "out.json"];
        let word = if samples > 0 {
            " late against"
        } else {
            " early against"
        };
        // Without accelerations the same is told.
        for form in ["acceleration", "filtered"] {
            let run = folder.run(&[&identify[..], &["--form", form]].concat());
            assert_eq!(run.code, Some(0), "{}", run.stderr);
            assert!(run.stderr.contains(word), "{form}: {}", run.stderr);
            assert!(run.stderr.contains("`time_delay;`"), "{}", run.stderr);
            let faults = json(&folder.read("out.json"))["data_faults"].clone();
            let [fault] = &faults.as_array().expect("a list")[..] else {
                panic!("{faults}");
            };
            assert_eq!(
                (&fault["kind"], &fault["channel"]),
                (&"late-torque".into(), &"tau1".into())
            );
            let number = |key: &str| fault["delay"][key].as_f64().expect("a number");
            let (value, std) = (number("value"), number("std"));
            assert!((value - delay).abs() < 4.0 * std && std < 1e-4, "{fault}");
        }
    }
}

/// Slopes lead to what is near; where dry friction turns round far away ones are found as well.
#[test]
fn torque_that_is_late_by_far_is_told_with_its_delay() {
    let folder = crate::verbs::payload::folder("");
    let log = folder.read("empty.csv");
    let time = |row: usize| -> f64 {
        let line = log.lines().nth(row).expect("a row");
        let field = line.split(',').next().expect("a column");
        field.parse().expect("a number")
    };
    let period = time(2) - time(1);
    for delay in [0.03, 0.05, 0.2] {
        let samples = (1..1000).find(|k| f64::from(*k) * period > delay - 0.5 * period);
        let samples: i32 = samples.expect("so many");
        let delay = f64::from(samples) * period;
        let samples = isize::try_from(samples).expect("small");
        folder.write("late.csv", &late(&log, samples));
        folder.succeed(&["identify", "arm.robot", "late.csv", "--json", "out.json"]);
        let faults = json(&folder.read("out.json"))["data_faults"].clone();
        let faults = faults.as_array().expect("a list");
        assert_eq!(faults.len(), 2, "{delay}: {faults:?}");
        for fault in faults {
            assert_eq!(fault["kind"], "late-torque");
            let number = |key: &str| fault["delay"][key].as_f64().expect("a number");
            let (found, std) = (number("value"), number("std"));
            assert!((found - delay).abs() < 4.0 * std && std < 5e-3, "{fault}");
        }
    }
}

/// Kind, channel, delay and deviation of the faults that an identification tells.
fn told(folder: &Folder, log: &str) -> Vec<(String, String, f64, f64)> {
    folder.write("late.csv", log);
    folder.succeed(&["identify", "arm.robot", "late.csv", "--json", "out.json"]);
    let faults = json(&folder.read("out.json"))["data_faults"].clone();
    let faults = faults.as_array().expect("a list").iter();
    let of = |fault: &serde_json::Value| {
        let text = |key: &str| fault[key].as_str().expect("a word").to_owned();
        let number = |key: &str| fault["delay"][key].as_f64().unwrap_or(f64::NAN);
        (
            text("kind"),
            text("channel"),
            number("value"),
            number("std"),
        )
    };
    faults.map(of).collect()
}

/// One channel alone, near and far: a position that is late makes torques seem early, each by another time.
#[test]
fn a_channel_that_is_late_alone_is_told_as_what_it_is() {
    let folder = crate::verbs::payload::folder("");
    let log = folder.read("empty.csv");
    let times = log.lines().skip(1).take(2);
    let times: Vec<f64> = times
        .map(|row| row.split(',').next().expect("a column"))
        .map(|time| time.parse().expect("a number"))
        .collect();
    let period = times[1] - times[0];
    for (channel, kind) in [
        ("tau1", "late-torque"),
        ("tau2", "late-torque"),
        ("q1", "late-position"),
        ("q2", "late-position"),
    ] {
        for delay in [0.05, 0.1, 0.15, 0.2] {
            let samples = (1..1000_i16).find(|k| f64::from(*k) * period > delay - 0.5 * period);
            let samples = samples.expect("so many");
            let delay = f64::from(samples) * period;
            let log = late_columns(&log, samples.into(), |name| {
                // An encoder's velocity comes with its position.
                name.trim_start_matches('d') == channel
            });
            let found = told(&folder, &log);
            let [(of_kind, of, value, std)] = &found[..] else {
                panic!("{channel} {delay}: {found:?}");
            };
            assert_eq!((of_kind.as_str(), of.as_str()), (kind, channel), "{delay}");
            let within = (value - delay).abs() < 4.0 * std && *std < 0.02;
            assert!(within, "{channel} {delay}: {found:?}");
        }
    }
}

/// Of the logs without what is carried.
#[test]
fn torque_that_is_late_is_told_beside_a_payload() {
    let folder = crate::verbs::payload::folder("");
    let gains = [
        "--payload-mass",
        "0.8",
        "--payload-center",
        "0.15,-0.0625,0",
    ];
    for samples in [0, 20] {
        folder.write("late.csv", &late(&folder.read("empty.csv"), samples));
        for more in [&[][..], &gains] {
            let identify = ["identify", "arm.robot", "late.csv", "--json", "out.json"];
            let payload = ["--payload", "loaded.csv"];
            let run = folder.run(&[&identify[..], &payload, more].concat());
            assert_eq!(run.code, Some(0), "{}", run.stderr);
            let faults = json(&folder.read("out.json"))["data_faults"].clone();
            let kinds = faults.as_array().expect("a list").iter();
            let late = kinds.filter(|fault| fault["kind"] == "late-torque").count();
            assert_eq!(late > 0, samples > 0, "{more:?}: {faults}");
            assert_eq!(
                run.stderr.contains(" late against"),
                late > 0,
                "{}",
                run.stderr
            );
        }
    }
}

/// Torque that is of the time of the position, with friction that the spec knows and with friction that it does not, and torque
/// that holds from sample to sample.
#[test]
fn torque_that_is_not_late_is_no_fault() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    let bare = CART.replace("viscous_friction on rail;", "motor_inertia on rail;");
    folder.write("bare.robot", &bare);
    let said = |spec: &str, log: &str| {
        folder.write("log.csv", log);
        let run = folder.run(&["identify", spec, "log.csv", "--partial"]);
        assert_eq!(run.code, Some(0), "{}", run.stderr);
        run.stderr
    };
    for coulomb in [0.0, 4.0] {
        for phase in [0.0, 1.0, 2.0] {
            let log = cart_log(20, coulomb, phase);
            for spec in ["cart.robot", "bare.robot"] {
                let said = said(spec, &log);
                assert!(
                    !said.contains(" against the position"),
                    "{spec} {coulomb}: {said}"
                );
            }
            let held = late(&log, -1);
            assert!(!said("cart.robot", &held).contains(" against the position"));
        }
    }
}

/// Of the error of a joint most may be of something else; one bus makes all torques late by the same.
const SWING: &str = "robot Swing {
    gravity = [0, -9.81, 0];
    convention = standard_dh;
    joint swing: revolute { a = 0.5 m; alpha = 0; d = 0; offset = -90 deg; }
    effects { viscous_friction on all; }
}";

/// At 25 Hz and 2 Hz of motion half of a sample is a quarter of a radian.
#[test]
fn torque_that_is_held_from_sample_to_sample_is_noted() {
    let folder = Folder::new();
    folder.write("arm.robot", SWING);
    let values = r#"{"swing.m": 1, "swing.mx": -0.2, "swing.my": 0, "swing.mz": 0, "swing.ixx": 0.1, "swing.iyy": 0.1, "swing.ixy": 0,
        "swing.ixz": 0, "swing.iyz": 0, "swing.izz": 0.1, "swing.viscous_friction.fv": 0.4}"#;
    folder.write("values.json", values);
    let held = |row: u32| {
        let wave = |hz: f64| (std::f64::consts::TAU * hz * 0.04 * f64::from(row)).sin();
        0.8 * wave(0.3) + 0.9 * wave(1.1) + 1.2 * wave(2.3)
    };
    let mut torque = "time,tau1\n".to_owned();
    for k in 0..=30_000_u32 {
        writeln!(torque, "{},{}", 0.001 * f64::from(k), held(k / 40)).expect("a string takes all");
    }
    folder.write("torque.csv", &torque);
    folder.write("rest.csv", "time,q1\n0,0\n10,0\n20,0\n30,0\n");
    folder.succeed(&[
        "simulate",
        "arm.robot",
        "--trajectory",
        "rest.csv",
        "--torque",
        "torque.csv",
        "--parameters",
        "values.json",
        "--duration",
        "30",
        "--log-rate",
        "25",
        "--out",
        "means.csv",
        "--torque-noise",
        "0.02",
    ]);
    // The log of `simulate` has means about its samples; one of commands has what acts from each sample on.
    let means = folder.read("means.csv");
    let mut commands = "time,q1,tau1\n".to_owned();
    for (k, line) in means.lines().skip(1).enumerate() {
        let fields: Vec<&str> = line.split(',').collect();
        let noise = 0.02 * (12.9898 * (k * k % 7919) as f64).sin();
        let tau = held(u32::try_from(k).expect("few")) + noise;
        writeln!(commands, "{},{},{tau}", fields[0], fields[1]).expect("a string takes all");
    }
    folder.write("commands.csv", &commands);
    let identify = |log: &str| {
        let run = folder.run(&["identify", "arm.robot", log, "--json", "out.json"]);
        assert_eq!(run.code, Some(0), "{}", run.stderr);
        let fit = json(&folder.read("out.json"));
        assert_eq!(fit["data_faults"].as_array().map(Vec::len), Some(0));
        let parameters = fit["parameters"].as_array().expect("a list").iter();
        let mut friction = parameters.filter(|one| one["name"] == "swing.viscous_friction.fv");
        let friction = friction.next().expect("friction")["value"].as_f64();
        (run.stderr, friction.expect("a number"))
    };
    let (said, friction) = identify("commands.csv");
    let note = said
        .lines()
        .find(|line| line.contains("held until the next"));
    let note = note.unwrap_or_else(|| panic!("{said}"));
    assert!(
        note.contains("`swing` by 1") && note.contains("`time_delay;`"),
        "{note}"
    );
    assert!(friction < 0.32, "{friction}");
    let (said, friction) = identify("means.csv");
    assert!(!said.contains("held until"), "{said}");
    assert!((friction - 0.4).abs() < 0.01, "{friction}");
    // The way out.
    folder.write(
        "arm.robot",
        &SWING.replace("on all;", "on all; time_delay;"),
    );
    let (said, friction) = identify("commands.csv");
    assert!(!said.contains("held until"), "{said}");
    assert!((friction - 0.4).abs() < 0.01, "{friction}");
}

#[test]
fn a_delay_that_another_joint_is_sure_of_is_told_of_all() {
    let folder = crate::verbs::output_error::two(12.0, 1.0, &[]);
    let log = folder.read("log.csv");
    folder.write("late.csv", &late(&log, 5));
    folder.succeed(&["identify", "two.robot", "late.csv", "--json", "out.json"]);
    let faults = json(&folder.read("out.json"))["data_faults"].clone();
    let faults = faults.as_array().expect("a list");
    let late = faults.iter().filter(|fault| fault["kind"] == "late-torque");
    let channels: Vec<&str> = late.filter_map(|fault| fault["channel"].as_str()).collect();
    assert_eq!(channels, ["tau1", "tau2"], "{faults:?}");
}

/// Beside damping half a sample is an inertia: no error tells them apart.
#[test]
fn commands_that_hold_at_a_low_rate_are_told() {
    const PERIOD: f64 = 1.0 / 30.0;
    let [mass, damping] = [0.05, 1.6];
    let folder = Folder::new();
    let spec = "robot Slow { gravity = [0, 0, -9.81]; convention = origin; \
                joint rail: prismatic { xyz = [0, 0, 0]; axis = [1, 0, 0]; link = cart; } effects { viscous_friction on rail; } }";
    folder.write("slow.robot", spec);
    let (mut log, [mut q, mut v]) = (String::from("time,q1,tau1\n"), [0.0; 2]);
    let kept = f64::exp(-damping / mass * PERIOD);
    for k in 0..600 {
        let turn = f64::from(k) / 7.0 + 0.8 * (f64::from(k) / 19.0).sin();
        let torque = if turn.sin() > 0.0 { 1.6 } else { -1.6 };
        let noise = 1e-4 * (12.9898 * f64::from(k) * f64::from(k)).sin();
        writeln!(log, "{},{},{torque}", PERIOD * f64::from(k), q + noise)
            .expect("a string takes all");
        let end = torque / damping;
        q += end * PERIOD + (v - end) * mass / damping * (1.0 - kept);
        v = end + (v - end) * kept;
    }
    folder.write("log.csv", &log);
    let value = |more: &[&str]| {
        let identify = ["identify", "slow.robot", "log.csv", "--json", "out.json"];
        let run = folder.run(&[&identify[..], more].concat());
        assert_eq!(run.code, Some(0), "{}", run.stderr);
        let found = json(&folder.read("out.json"))["parameters"][0]["value"].as_f64();
        let is_told = run
            .stderr
            .contains("are constant, then jump from one sample");
        (found.expect("a number"), is_told)
    };
    let (by_rows, is_told) = value(&[]);
    assert!((by_rows / mass - 1.0).abs() > 0.3 && is_told, "{by_rows}");
    let (simulated, is_told) = value(&["--method", "output-error"]);
    assert!(
        (simulated / mass - 1.0).abs() < 0.02 && !is_told,
        "{simulated}"
    );
}

/// Noise of 2 N m hides what a delay of 10 ms leaves of errors, and not what it makes of friction, whose deviation knows of it.
#[test]
fn a_delay_that_noise_hides_is_noted_and_in_deviations() {
    let folder = Folder::new();
    folder.write("arm.robot", PENDULUM);
    let tones = [(1.3, 0.7, 0.0), (4.1, 0.3, 1.1), (11.0, 0.06, 0.4)];
    let log = swinging(0.0, -1.45, tones, 2.0, 1);
    let said = |samples: isize| {
        folder.write("log.csv", &late(&log, samples));
        let run = folder.run(&["identify", "arm.robot", "log.csv", "--json", "out.json"]);
        assert!(!run.stderr.contains(" late against"), "{}", run.stderr);
        let out = json(&folder.read("out.json"));
        let parameters = out["parameters"].as_array().expect("a list").clone();
        let friction = |one: &&serde_json::Value| one["name"] == "one.viscous_friction.fv";
        let friction = parameters.iter().find(friction).expect("it is declared");
        let [value, std] = ["value", "std"].map(|key| friction[key].as_f64().expect("a number"));
        (run.stderr, (value - 0.3).abs(), std)
    };
    let told = "torques are late by ";
    let (on_time, _, of_noise) = said(0);
    assert!(!on_time.contains(told), "{on_time}");
    let (hidden, off, std) = said(5);
    assert!(
        hidden.contains(told) && hidden.contains("or more"),
        "{hidden}"
    );
    assert!(
        off > 3.0 * of_noise && off < 2.0 * std,
        "{off} {of_noise} {std}"
    );
}
