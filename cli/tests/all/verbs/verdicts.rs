//! One log, sound and with each fault that logs have: what is said of it, and that a sound pendulum is found behind what can be mended.

use std::f64::consts::{PI, TAU};
use std::fmt::Write;

use crate::verbs::common::{Folder, json, white};

const SPEC: &str = "robot Swing {
    gravity = [0, -9.81, 0];
    convention = standard_dh;
    joint turn: revolute { a = 0.5; alpha = 0; d = 0; }
    effects { viscous_friction on turn; }
}";

/// Viscous friction of the pendulum, N m s/rad.
const FRICTION: f64 = 2.0;

const SAMPLES: usize = 4000;

/// A row of the log: time, position, velocity, torque.
type Row = [f64; 4];

/// The pendulum at a time.
fn at(time: f64) -> Row {
    let wave = |a: f64, w: f64, phase: f64| {
        let (sine, cosine) = (w * time + phase).sin_cos();
        [a * sine, a * w * cosine, -a * w * w * sine]
    };
    let (slow, fast) = (wave(0.9, 1.7, 0.0), wave(0.4, 4.3, 0.5));
    let [q, dq, ddq] = [0, 1, 2].map(|k| slow[k] + fast[k]);
    [time, q, dq, 0.8 * ddq + 11.8 * q.cos() + FRICTION * dq]
}

/// The log at these times, with white noise of the torque.
fn rows(time: impl Fn(usize) -> f64) -> Vec<Row> {
    let mut state = 11;
    let row = |k: usize| {
        let [t, q, dq, tau] = at(time(k));
        [t, q, dq, tau + 0.3 * white(&mut state)]
    };
    (0..SAMPLES).map(row).collect()
}

fn uniform(k: usize) -> f64 {
    0.005 * k as f64
}

/// The log with each row changed.
fn changed(change: impl Fn(usize, Row) -> Row) -> Vec<Row> {
    let rows = rows(uniform).into_iter().enumerate();
    rows.map(|(k, row)| change(k, row)).collect()
}

fn csv(rows: &[Row]) -> String {
    let mut text = String::from("time,q1,dq1,tau1\n");
    for [t, q, dq, tau] in rows {
        writeln!(text, "{t:.6},{q},{dq},{tau}").expect("a string takes all");
    }
    text
}

/// A fault: its name, the log, what is said of it, and which kind of fault `--json` has where it has one.
type Fault = (&'static str, Vec<Row>, &'static str, Option<&'static str>);

/// Faults behind which the pendulum is found.
fn mended() -> Vec<Fault> {
    let jitter = |k: usize| uniform(k) + 0.0012 * (7.3 * k as f64).sin();
    let without = |lost: std::ops::Range<usize>| {
        let rows = rows(uniform).into_iter().enumerate();
        rows.filter_map(|(k, row)| (!lost.contains(&k)).then_some(row))
            .collect()
    };
    let step = TAU / 4096.0;
    let late = at_each(|t| [t, at(t)[1], at(t - 0.06)[2], at(t)[3]]);
    let spikes =
        |k: usize, [t, q, dq, tau]: Row| [t, q, dq, if k % 97 == 50 { tau + 80.0 } else { tau }];
    let held = |k: usize, row: Row| {
        if (800..810).contains(&k) {
            [row[0], at(4.0)[1], at(4.0)[2], at(4.0)[3]]
        } else {
            row
        }
    };
    vec![
        ("sound", rows(uniform), "", None),
        (
            "coarse encoder",
            changed(|_, [t, q, dq, tau]| [t, (q / step).round() * step, dq, tau]),
            "",
            None,
        ),
        (
            "jitter",
            rows(jitter),
            "time stamps are not uniform",
            Some("jitter"),
        ),
        (
            "a short gap",
            without(800..806),
            "samples are missing, once, at 4.000 s, 6 samples, ",
            None,
        ),
        ("late velocity", late, "dq1 is 0.06", Some("velocity-late")),
        (
            "spikes",
            changed(spikes),
            "tau1: 41 samples are far from both neighbors",
            Some("spikes"),
        ),
        (
            "held samples",
            changed(held),
            "tau1 is frozen while the arm moves",
            Some("held"),
        ),
        (
            "a drive at its limit",
            changed(|_, [t, q, dq, tau]| [t, q, dq, tau.clamp(-12.0, 12.0)]),
            "tau1 is at its limit of 12",
            Some("clipped"),
        ),
        (
            "velocity in rpm",
            changed(|_, [t, q, dq, tau]| [t, q, dq * 30.0 / PI, tau]),
            "as rpm are to rad/s",
            Some("velocity-scale"),
        ),
    ]
}

/// The log without noise of what is computed of each time.
fn at_each(row: impl Fn(f64) -> Row) -> Vec<Row> {
    (0..SAMPLES).map(|k| row(uniform(k))).collect()
}

#[test]
fn what_can_be_mended_is_told_and_the_arm_is_found() {
    let folder = Folder::new();
    folder.write("arm.robot", SPEC);
    for (number, (name, rows, told, kind)) in mended().into_iter().enumerate() {
        folder.write("log.csv", &csv(&rows));
        let out = format!("fit{number}.json");
        let run = folder.run(&["identify", "arm.robot", "log.csv", "--json", &out]);
        assert_eq!(run.code, Some(0), "{name}: {}", run.stderr);
        assert!(run.stderr.contains(told), "{name}: {}", run.stderr);
        // A sound log, and an encoder that is fine enough, are not talked about.
        let is_noted = run.stderr.contains("note: ");
        assert_eq!(is_noted, !told.is_empty(), "{name}: {}", run.stderr);
        let fit = json(&folder.read(&out));
        let faults = fit["data_faults"].as_array().expect("a list");
        let kinds: Vec<&str> = faults
            .iter()
            .filter_map(|fault| fault["kind"].as_str())
            .collect();
        assert!(
            kind.is_none_or(|kind| kinds.contains(&kind)),
            "{name}: {kinds:?}"
        );
        let parameters = fit["parameters"].as_array().expect("a list");
        let friction = parameters
            .iter()
            .find(|own| own["name"] == "turn.viscous_friction.fv");
        let friction = friction.expect("declared")["value"].as_f64().expect("told");
        assert!(
            (friction / FRICTION - 1.0).abs() < 0.02,
            "{name}: {friction}"
        );
    }
}

/// Faults that no program can mend: what is said names them, and the way out.
#[test]
fn what_cannot_be_mended_is_told_first() {
    let folder = Folder::new();
    folder.write("arm.robot", SPEC);
    let degrees = |_: usize, [t, q, dq, tau]: Row| [t, q.to_degrees(), dq.to_degrees(), tau];
    let turns = |_: usize, [t, q, dq, tau]: Row| [t, q / TAU, dq / TAU, tau];
    let late = at_each(|t| [t, at(t)[1], at(t)[2], at(t - 0.03)[3]]);
    let cases = [
        (
            "degrees",
            changed(degrees),
            [
                "with positions in degrees the residual is",
                "`log { q = \"q1\": deg, ..; }`",
            ],
        ),
        (
            "revolutions",
            changed(turns),
            [
                "with positions in revolutions the residual is",
                "`log { q = \"q1\": rev, ..; }`",
            ],
        ),
        (
            "late torque",
            late,
            ["tau1 of joint `turn` is 0.03", "`time_delay;`"],
        ),
    ];
    for (name, rows, [told, way_out]) in cases {
        folder.write("log.csv", &csv(&rows));
        let run = folder.run(&["identify", "arm.robot", "log.csv"]);
        assert_eq!(run.code, Some(0), "{name}: {}", run.stderr);
        let is_told = |line: &&str| line.starts_with("note: ") || line.starts_with("warning: ");
        let mut notes = run.stderr.lines().filter(is_told);
        let said = notes.find(|note| note.contains(told));
        let said = said.unwrap_or_else(|| panic!("{name}: {}", run.stderr));
        assert!(said.contains(way_out), "{name}: {said}");
        // What follows from a wrong unit is not told as another want.
        let advice = "the logs are short";
        assert!(!run.stderr.contains(advice), "{name}: {}", run.stderr);
    }
}

#[test]
fn what_says_nothing_is_refused() {
    let folder = Folder::new();
    folder.write("arm.robot", SPEC);
    let constant = changed(|_, [t, ..]| [t, 0.3, 0.0, 2.0]);
    let gap = rows(|k| uniform(k) + if k < 2000 { 0.0 } else { 2.0 });
    for (name, log, told) in [
        ("empty", String::new(), "log.csv: the log is empty"),
        (
            "a header alone",
            csv(&[]),
            "log.csv: the log has 0 samples, at least 16 are needed; record a longer motion",
        ),
        (
            "constant",
            csv(&constant),
            "the log excites none of the 4 unknowns",
        ),
        (
            "short",
            csv(&rows(uniform)[..30]),
            "a log of 0.145 s is too short",
        ),
        (
            "a long gap",
            csv(&gap),
            "log.csv:2002: gap in time from 9.995 s to 12 s",
        ),
        (
            "words",
            csv(&rows(uniform)[..20]) + "1,2,three,4\n",
            "log.csv:22: ",
        ),
    ] {
        folder.write("log.csv", &log);
        let said = folder.refuse(&["identify", "arm.robot", "log.csv", "--json", "fit.json"]);
        assert!(said.contains(told), "{name}: {said}");
    }
    // At one speed, a wave does not tell what the arm is of.
    let spec = SPEC.replace(
        "viscous_friction on turn;",
        "viscous_friction on turn; quadratic_viscous on turn; coulomb_friction on turn;",
    );
    folder.write("arm.robot", &spec);
    let steady = changed(|_, [t, ..]| [t, 0.5 * t, 0.5, 11.8 * (0.5 * t).cos() + FRICTION * 0.5]);
    folder.write("log.csv", &csv(&steady));
    let said = folder.refuse(&["identify", "arm.robot", "log.csv", "--json", "fit.json"]);
    for told in [
        "turn.viscous_friction.fv",
        "turn.quadratic_viscous",
        "turn.coulomb_friction.fc",
        "--partial",
    ] {
        assert!(said.contains(told), "{told}: {said}");
    }
}
