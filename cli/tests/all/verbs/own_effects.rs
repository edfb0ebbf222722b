//! `trace` of a spec with an effect of its own, which it does not declare on the joint that has it.

use std::fmt::Write;

use crate::verbs::common::{Folder, json, white};

/// A slide whose grease is thicker in places; the library has no such law.
const SPEC: &str = "\
/// Grease that is thicker in places.
effect grease(j) {
    /// Difference of the viscous coefficient, N s/m.
    linear c;
    torque(j) = c * sin(6 * q(j)) * dq(j);
}
robot Slide {
    gravity = [0, 0, -9.81];
    convention = origin;
    joint rail: prismatic { xyz = [0, 0, 0]; axis = [1, 0, 0]; link = cart; }
    effects { viscous_friction on rail; }
}
";

/// So large it is, N s/m.
const GREASE: f64 = 2.0;

/// A log of the slide, along a motion that does not repeat.
fn log(seed: u32) -> String {
    log_with(seed, &mut |_, q, dq| GREASE * (6.0 * q).sin() * dq)
}

/// A log with a torque of time, position and velocity beside friction of 5 N s/m.
fn log_with(seed: u32, more: &mut dyn FnMut(f64, f64, f64) -> f64) -> String {
    let mut state = u64::from(seed);
    let mut text = String::from("time,q1,tau1\n");
    for k in 0..6000 {
        let t = f64::from(k) / 200.0;
        let wave = |a: f64, w: f64| {
            let (sin, cos) = (w * t + f64::from(seed)).sin_cos();
            [a * sin, a * w * cos, -a * w * w * sin]
        };
        let waves = [wave(0.4, 1.3), wave(0.15, 3.7)];
        let [q, dq, ddq] = [0, 1, 2].map(|k| waves[0][k] + waves[1][k]);
        let tau = 3.0 * ddq + 5.0 * dq + more(t, q, dq) + 0.2 * white(&mut state);
        writeln!(text, "{t},{q},{tau}").expect("a string takes all");
    }
    text
}

/// It is tried as those of the library are, named, declared in the spec, and identified there.
#[test]
fn an_effect_of_the_spec_is_named_like_those_of_the_library() {
    let folder = Folder::new();
    folder.write("slide.robot", SPEC);
    folder.write("monday.csv", &log(1));
    folder.write("tuesday.csv", &log(2));
    folder.succeed(&[
        "trace",
        "slide.robot",
        "monday.csv",
        "--validate",
        "tuesday.csv",
        "--amend",
        "amended.robot",
        "--json",
        "out.json",
    ]);
    let out = json(&folder.read("out.json"));
    assert_eq!(out["outcome"], "explained");
    let effects = out["effects"].as_array().expect("effects");
    assert_eq!(effects.len(), 1, "{effects:?}");
    assert_eq!(
        (&effects[0]["kind"], &effects[0]["joint"]),
        (&"grease".into(), &1.into())
    );
    let error = |key: &str| out[key][0].as_f64().expect("a number");
    assert!(error("rmse_after") < 0.4 * error("rmse_before"), "{out}");

    assert!(folder.read("amended.robot").contains("grease on rail;"));
    folder.succeed(&[
        "identify",
        "amended.robot",
        "monday.csv",
        "--json",
        "fit.json",
    ]);
    let fit = json(&folder.read("fit.json"));
    let parameters = fit["parameters"].as_array().expect("parameters");
    let found = parameters.iter().find(|one| one["name"] == "rail.grease.c");
    let value = found
        .and_then(|one| one["value"].as_f64())
        .expect("its value");
    assert!((value - GREASE).abs() < 0.03, "{value}");
}

/// A law of time with one shape.
fn shifting() -> String {
    let shift = "\
/// A zero that is set anew, once.
effect shift(j) {
    /// By how much, N.
    linear c;
    /// When, s.
    shape start in 0 .. 30 step 1;
    let there = if time < start { 0 } else { 1 };
    torque(j) = c * there;
}
";
    let robot = SPEC.find("robot Slide").expect("a robot");
    format!("{shift}{}", &SPEC[robot..])
}

/// Has to explain its edge: a zero that wanders has none.
#[test]
fn a_law_of_time_with_one_shape_is_no_wander() {
    let folder = Folder::new();
    folder.write("slide.robot", &shifting());
    let traced = |log: &str| {
        folder.write("log.csv", log);
        folder.succeed(&["trace", "slide.robot", "log.csv", "--json", "out.json"]);
        json(&folder.read("out.json"))
    };
    let out = traced(&log_with(1, &mut |t, _, _| {
        if t < 13.202 { 0.0 } else { 1.5 }
    }));
    let effect = &out["effects"][0];
    assert_eq!(effect["kind"], "shift", "{out}");
    let start = &effect["parameters"][1];
    assert_eq!(start["name"], "start");
    let [low, high] = [0, 1].map(|end| start["interval"][end].as_f64().expect("a number"));
    assert!(low < 13.202 && 13.202 < high && high - low < 0.2, "{out}");

    for seed in 2..6 {
        let (mut state, mut zero) = (u64::from(seed) + 100, 0.0);
        let out = traced(&log_with(seed, &mut |_, _, _| {
            zero += 0.02 * white(&mut state);
            zero
        }));
        assert_eq!(out["effects"].as_array().map(Vec::len), Some(0), "{out}");
    }
}
