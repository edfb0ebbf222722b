//! `trace`: the one of several laws that is named, and what is not.

use std::fmt::Write;

use serde_json::Value;

use crate::common::{CART, Folder, cart_with, folding, json, moved, tones};

/// What `trace` says of a log by a spec.
fn traced(spec: &str, log: &str) -> Value {
    let folder = Folder::new();
    folder.write("arm.robot", spec);
    folder.write("log.csv", log);
    folder.succeed(&["trace", "arm.robot", "log.csv", "--json", "out.json"]);
    json(&folder.read("out.json"))
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

/// The rise at breakaway is in pulses of milliseconds, of which the filtered fit sees little.
#[test]
fn a_law_of_short_pulses_is_named_by_raw_errors() {
    let spec = CART.replace(
        "viscous_friction on rail;",
        "viscous_friction on rail; coulomb_friction on rail;",
    );
    let tones = [[0.2, 2.3, 0.0], [0.11, 5.17, 1.0], [0.05, 9.7, 2.0]];
    let rise = |dq: f64| 0.6 * (-(dq / 0.02).powi(2)).exp();
    let log = cart_with(200, 40, &tones, |_, dq| (1.0 + rise(dq)) * dq.signum());
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

/// A body has ten unknowns: as many blocks of slow noise would say nothing of it.
#[test]
fn a_body_is_named_beside_slow_noise() {
    let folder = Folder::new();
    let values = r#"{"up.viscous_friction.fv": 1.0, "lo.viscous_friction.fv": 0.5,
        "up.coulomb_friction.fc": 0.5, "lo.coulomb_friction.fc": 0.3, "lo.payload.m": 0.2, "lo.payload.mx": 0.02,
        "lo.payload.my": 0, "lo.payload.mz": 0.01, "lo.payload.ixx": 0.001, "lo.payload.ixy": 0, "lo.payload.ixz": 0,
        "lo.payload.iyy": 0.001, "lo.payload.iyz": 0, "lo.payload.izz": 0.001}"#;
    moved(&folder, &folding("payload on lo;"), values, |t| {
        [
            -1.57 + 0.9 * (1.3 * t).sin() + 0.2 * (4.1 * t).sin(),
            0.9 * (2.1 * t).sin() + 0.2 * (5.3 * t).cos(),
        ]
    });
    let log = folder.read("log.csv");
    let mut lines = log.lines();
    let header = lines.next().expect("a header");
    let place = |name: &str| header.split(',').position(|column| column == name);
    let places = ["tau1", "tau2"].map(|name| place(name).expect("a torque"));
    let mut slow = format!("{header}\n");
    for line in lines {
        let mut fields: Vec<f64> = line
            .split(',')
            .map(|field| field.parse().expect("a number"))
            .collect();
        let t = fields[0];
        fields[places[0]] += 0.02 * (0.4 * t).sin();
        fields[places[1]] += 0.02 * (0.3 * t).cos();
        let fields: Vec<String> = fields.iter().map(f64::to_string).collect();
        writeln!(slow, "{}", fields.join(",")).expect("a string takes all");
    }
    let out = traced(&folding(""), &slow);
    assert_eq!(kinds(&out, "effects"), ["payload"], "{out}");
}
