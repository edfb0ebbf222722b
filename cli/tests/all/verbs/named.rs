//! `trace`: the one of several laws that is named, and what it says of those that are not.

use std::fmt::Write;

use serde_json::Value;

use crate::verbs::common::{
    CART, Folder, cart_breaking_away, cart_with, close, folding, json, moved, tones,
};

/// What `trace` says of a log by a spec, as text and as JSON.
fn told(spec: &str, log: &str) -> (String, Value) {
    let folder = Folder::new();
    folder.write("arm.robot", spec);
    folder.write("log.csv", log);
    let told = folder.succeed(&["trace", "arm.robot", "log.csv", "--json", "out.json"]);
    (told, json(&folder.read("out.json")))
}

fn traced(spec: &str, log: &str) -> Value {
    told(spec, log).1
}

/// A log of the folding arm with an effect more, to whose torques `more` of time and positions is added.
fn folded(effect: &str, values: &str, more: impl Fn(f64, [f64; 2]) -> [f64; 2]) -> String {
    let folder = Folder::new();
    let values = format!(
        r#"{{"up.viscous_friction.fv": 1.0, "lo.viscous_friction.fv": 0.5,
        "up.coulomb_friction.fc": 0.5, "lo.coulomb_friction.fc": 0.3{values}}}"#
    );
    moved(&folder, &folding(effect), &values, |t| {
        [
            -1.57 + 0.9 * (1.3 * t).sin() + 0.2 * (4.1 * t).sin(),
            0.9 * (2.1 * t).sin() + 0.2 * (5.3 * t).cos(),
        ]
    });
    let log = folder.read("log.csv");
    let mut lines = log.lines();
    let header = lines.next().expect("a header");
    let place = |name: &str| {
        let mut columns = header.split(',');
        columns.position(|column| column == name).expect(name)
    };
    let (q, tau) = (["q1", "q2"].map(place), ["tau1", "tau2"].map(place));
    let mut text = format!("{header}\n");
    for line in lines {
        let fields = line
            .split(',')
            .map(|field| field.parse().expect("a number"));
        let mut fields: Vec<f64> = fields.collect();
        let added = more(fields[place("time")], q.map(|column| fields[column]));
        for (column, torque) in tau.into_iter().zip(added) {
            fields[column] += torque;
        }
        let fields: Vec<String> = fields.iter().map(f64::to_string).collect();
        writeln!(text, "{}", fields.join(",")).expect("a string takes all");
    }
    text
}

/// Kinds of its effects or alternatives.
fn kinds<'a>(out: &'a Value, key: &str) -> Vec<&'a str> {
    let list = out[key].as_array().expect("a list").iter();
    list.map(|one| one["kind"].as_str().expect("a name"))
        .collect()
}

/// Over small motions most of a spring's torque is a constant, of which offsets make as much.
#[test]
fn a_law_that_says_all_that_a_simpler_one_says_is_named() {
    let out = traced(
        CART,
        &cart_with(200, 40, &tones(0.0), |q, _| 0.5 + 0.05 * q),
    );
    assert_eq!(kinds(&out, "effects"), ["joint-spring"], "{out}");
    let is_offset = |kind: &&str| ["asymmetric-coulomb", "torque-offset"].contains(kind);
    assert!(kinds(&out, "alternatives").iter().any(is_offset), "{out}");

    let out = traced(CART, &cart_with(200, 40, &tones(0.0), |_, _| 0.5));
    assert!(kinds(&out, "effects").iter().all(is_offset), "{out}");
    assert_eq!(kinds(&out, "effects").len(), 1, "{out}");
}

/// Over one range of speeds a square and a cube of the velocity are alike; a further log at other speeds parts them.
#[test]
fn a_further_log_at_another_speed_parts_laws_that_one_log_does_not() {
    let drag = |_, dq: f64| 0.5 * dq * dq.abs();
    let fast = tones(0.7).map(|[amplitude, frequency, phase]| [amplitude, 2.5 * frequency, phase]);
    let folder = Folder::new();
    folder.write("arm.robot", CART);
    folder.write("log.csv", &cart_with(200, 40, &tones(0.0), drag));
    folder.write("fast.csv", &cart_with(200, 40, &fast, drag));
    let of = |logs: &[&str]| {
        folder.succeed(&[&["trace", "arm.robot", "--json", "out.json"], logs].concat());
        json(&folder.read("out.json"))
    };
    let one = of(&["log.csv"]);
    assert_eq!(kinds(&one, "effects"), ["quadratic-viscous"], "{one}");
    assert_eq!(kinds(&one, "alternatives"), ["cubic-viscous"], "{one}");
    let both = of(&["log.csv", "fast.csv"]);
    assert_eq!(kinds(&both, "effects"), ["quadratic-viscous"], "{both}");
    assert!(kinds(&both, "alternatives").is_empty(), "{both}");
}

/// The rise at breakaway is in pulses of milliseconds, of which the filtered fit sees little.
#[test]
fn a_law_of_short_pulses_is_named_by_raw_errors() {
    let (spec, log) = cart_breaking_away();
    let out = traced(&spec, &log);
    assert_eq!(kinds(&out, "effects"), ["stribeck"], "{out}");
}

/// Two ripples that matter little each are no structure that is unknown.
#[test]
fn effects_that_are_small_are_not_unexplained() {
    let ripples = |q: f64| 0.0135 * ((30.0 * q).cos() + (55.0 * q).sin());
    let out = traced(CART, &cart_with(500, 40, &tones(0.0), |q, _| ripples(q)));
    assert_eq!(out["outcome"], "nothing-missing", "{out}");
}

/// Both laws leave the same of the other joint but for noise.
#[test]
fn a_joint_that_no_law_touches_does_not_keep_one_from_saying_more() {
    let log = folded("", "", |_, [_, lo]| [0.0, 0.08 + 0.015 * lo]);
    let out = traced(&folding(""), &log);
    assert_eq!(kinds(&out, "effects"), ["joint-spring"], "{out}");
}

/// A body has ten unknowns: as many blocks of slow noise would say nothing of it.
#[test]
fn a_body_is_named_beside_slow_noise() {
    let values = r#", "lo.payload.m": 0.2, "lo.payload.mx": 0.02, "lo.payload.my": 0, "lo.payload.mz": 0.01,
        "lo.payload.ixx": 0.001, "lo.payload.ixy": 0, "lo.payload.ixz": 0, "lo.payload.iyy": 0.001,
        "lo.payload.iyz": 0, "lo.payload.izz": 0.001"#;
    let log = folded("payload on lo;", values, |t, _| {
        [0.02 * (0.4 * t).sin(), 0.02 * (0.3 * t).cos()]
    });
    let out = traced(&folding(""), &log);
    assert_eq!(kinds(&out, "effects"), ["payload"], "{out}");
}

/// The share of a quantity of a joint, from 1, in the residual of the only joint with structure.
fn share(out: &Value, of: &str, joint: usize) -> f64 {
    let one = &out["structure_where"];
    assert_eq!(one.as_array().map(Vec::len), Some(1), "{out}");
    let mut shares = one[0]["shares"].as_array().expect("a list").iter();
    let found = shares.find(|share| share["of"] == of && share["joint"] == joint);
    found
        .and_then(|found| found["share"].as_f64())
        .unwrap_or_else(|| panic!("{of} of {joint} in {out}"))
}

/// No effect of the library follows another joint's position.
#[test]
fn a_law_of_another_joints_position_is_told_to_live_there() {
    let log = folded("", "", |_, [up, _]| [0.0, 0.15 * (7.0 * up).sin()]);
    let (told, out) = told(&folding(""), &log);
    assert_eq!(out["outcome"], "unexplained", "{told}");
    assert_eq!(out["structure_where"][0]["joint"], 2, "{told}");
    assert!(share(&out, "position", 1) > 0.9, "{out}");
    for (of, joint) in [("position", 2), ("velocity", 1), ("load", 2)] {
        assert!(share(&out, of, joint) < 0.2, "{of} of {joint}: {out}");
    }
    assert!(told.contains("% a function of position of up; "), "{told}");
    // What comes nearest is told with what is against it.
    let tried = out["tried"].as_array().expect("a list");
    let is_refused = |one: &Value| one["refused"].as_array().is_some_and(|r| !r.is_empty());
    assert!(!tried.is_empty() && tried.iter().all(is_refused), "{out}");
}

/// A product of functions of position and velocity is a function of neither.
#[test]
fn a_law_of_position_and_velocity_is_told_to_live_in_both() {
    let law = |q: f64, dq: f64| 0.5 * (13.0 * q + 0.4).sin() * (6.0 * dq).cos();
    let (told, out) = told(CART, &cart_with(200, 40, &tones(0.0), law));
    assert_eq!(out["outcome"], "unexplained", "{told}");
    assert!(share(&out, "position-and-velocity", 1) > 0.9, "{out}");
    assert!(share(&out, "position", 1) < 0.5, "{out}");
    assert!(
        told.contains("% a function of position and velocity of rail"),
        "{told}"
    );
}

#[test]
fn a_law_of_time_is_told_by_its_frequency() {
    let log = folded("", "", |t, _| {
        [0.3 * (2.36 * t + 0.3 * (0.7 * t).sin()).sin(), 0.0]
    });
    let (told, out) = told(&folding(""), &log);
    assert_eq!(out["outcome"], "unexplained", "{told}");
    assert!(share(&out, "position-and-velocity", 1) < 0.2, "{out}");
    let peak = &out["structure_where"][0];
    close(peak["peak_hz"].as_f64().expect("a number"), 0.3756, 0.01);
    assert!(
        peak["peak_share"].as_f64().is_some_and(|s| s > 0.7),
        "{out}"
    );
    assert!(
        told.contains("not a function of position, velocity")
            && told.contains(
                "most of it follows from no quantity that it was compared with; no known"
            ),
        "{told}"
    );
}

/// A torque that steps once is slower than any motion, and no wander of the zero.
#[test]
fn a_torque_that_steps_is_no_noise() {
    let step = folded("", "", |t, _| [if t < 12.0 { 0.0 } else { 1.5 }, 0.0]);
    let (told, out) = told(&folding(""), &step);
    assert_eq!(out["outcome"], "unexplained", "{told}");
    let step = &out["structure_where"][0]["step"];
    close(step["time"].as_f64().expect("a number"), 12.0, 0.02);
    close(step["size"].as_f64().expect("a number"), 1.5, 0.3);
    assert_eq!(step["log"], 1, "{out}");
    assert!(told.contains("N m at 12.0 s and stays there"), "{told}");
    assert!(told.contains("level changes, and no known"), "{told}");
}

/// Nor is one that comes back.
#[test]
fn a_torque_that_steps_and_comes_back_is_no_noise() {
    let is_off = |t: f64| (9.0..15.0).contains(&t);
    let step = folded("", "", |t, _| [if is_off(t) { 1.0 } else { 0.0 }, 0.0]);
    let (told, out) = told(&folding(""), &step);
    assert_eq!(out["outcome"], "unexplained", "{told}");
    let step = &out["structure_where"][0]["step"];
    close(step["time"].as_f64().expect("a number"), 9.0, 0.02);
    close(step["until"].as_f64().expect("a number"), 15.0, 0.02);
    close(step["size"].as_f64().expect("a number"), 1.0, 0.2);
    assert!(told.contains("N m at 9.0 s and back at 15.0 s"), "{told}");
}

/// Drag of one joint is named, whatever holds another one for a while.
#[test]
fn a_torque_that_steps_demotes_no_law_of_another_joint() {
    let log = folded("", "", |t, _| {
        let dq = 0.9 * 2.1 * (2.1 * t).cos() - 0.2 * 5.3 * (5.3 * t).sin();
        [if t < 12.0 { 0.0 } else { 1.5 }, 0.4 * dq * dq.abs()]
    });
    let (told, out) = told(&folding(""), &log);
    assert_eq!(out["outcome"], "explained", "{told}");
    let effects = out["effects"].as_array().expect("a list");
    assert_eq!(effects.len(), 1, "{told}");
    assert_eq!(effects[0]["joint"], 2, "{told}");
    assert!(told.contains("N m at 12.0 s and stays there"), "{told}");
}

/// It is nothing at the first sample alone, which is no end of it.
#[test]
fn friction_that_settles_is_named() {
    let log = folded("", "", |t, _| {
        let dq = 0.9 * 1.3 * (1.3 * t).cos() + 0.2 * 4.1 * (4.1 * t).cos();
        [0.6 * (1.0 - (-t / 8.0).exp()) * dq, 0.0]
    });
    let (told, out) = told(&folding(""), &log);
    assert_eq!(kinds(&out, "effects"), ["parameter-drift"], "{told}");
    assert_eq!(out["effects"][0]["effect"], "parameter_drift", "{told}");
    let settle = &out["effects"][0]["parameters"][1];
    close(settle["value"].as_f64().expect("a number"), 8.0, 0.5);
}

/// Neither its time nor its end is told by a log of a part of it, but what it does is.
#[test]
fn friction_that_drifts_evenly_is_named() {
    let log = folded("", "", |t, _| {
        let dq = 0.9 * 1.3 * (1.3 * t).cos() + 0.2 * 4.1 * (4.1 * t).cos();
        [0.02 * t * (dq / 0.005).tanh(), 0.0]
    });
    let (told, out) = told(&folding(""), &log);
    assert_eq!(kinds(&out, "effects"), ["parameter-drift"], "{told}");
    assert_eq!(out["effects"][0]["effect"], "dry_friction_drift", "{told}");
    let fc = &out["effects"][0]["parameters"][0];
    close(fc["value"].as_f64().expect("a number"), 1.2, 0.3);
}
