//! `audit`.

use std::collections::BTreeMap;

use serde_json::Value;

use crate::verbs::common::{Folder, PENDULUM, json};

/// What `audit` says: exit code, checks by name, what it prints.
pub(crate) fn audit(
    robot: &str,
    values: &BTreeMap<String, f64>,
) -> (Option<i32>, BTreeMap<String, Value>, String) {
    let folder = Folder::new();
    folder.write("arm.robot", robot);
    folder.write("values.json", &serde_json::to_string(values).expect("JSON"));
    let run = folder.run(&[
        "audit",
        "arm.robot",
        "--parameters",
        "values.json",
        "--json",
        "out.json",
    ]);
    assert!(
        folder.files().contains(&"out.json".to_owned()),
        "{}",
        run.stderr
    );
    let out = json(&folder.read("out.json"));
    let checks = out["checks"].as_array().expect("a list").iter();
    let checks: BTreeMap<String, Value> = checks
        .map(|check| {
            (
                check["name"].as_str().expect("a name").to_owned(),
                check.clone(),
            )
        })
        .collect();
    let all = checks.values().all(|check| check["passed"] == true);
    assert_eq!(out["passed"], all);
    assert_eq!(run.code, Some(i32::from(!all)), "{}", run.stderr);
    (run.code, checks, run.stdout)
}

pub(crate) fn findings(check: &Value) -> Vec<&str> {
    let findings = check["findings"].as_array().expect("a list").iter();
    findings
        .map(|finding| finding.as_str().expect("a sentence"))
        .collect()
}

#[test]
fn a_sound_arm_passes_and_an_odd_one_is_told_why() {
    let arm = PENDULUM.replace("\n}\n", "\n    effects { viscous_friction on all; dahl(d = 0.01) on upper; torque_offset on upper; joint_spring on lower; }\n}\n");
    let effects = [
        ("upper.viscous_friction.fv", 0.5),
        ("lower.viscous_friction.fv", 0.2),
        ("upper.dahl.fc", 1.0),
        ("upper.torque_offset.offset", 7.0),
        ("lower.joint_spring.k", 30.0),
        ("lower.joint_spring.t0", 3.0),
    ];
    let sound: BTreeMap<String, f64> = effects.map(|(name, value)| (name.to_owned(), value)).into();
    // Offsets and springs give back what they take; a bent bristle slides, and has a memory to look at.
    let (code, checks, text) = audit(&arm, &sound);
    assert_eq!(code, Some(0), "{text}");
    assert_eq!(checks.len(), 7, "{text}");
    let ranks = checks["rank"]["quantities"].as_array().expect("a list");
    let rank = |what: &str| {
        let found = ranks.iter().find(|one| one["what"] == what);
        found
            .and_then(|one| one["value"].as_f64())
            .expect("a number")
    };
    assert!(rank("base_parameters") < rank("parameters"), "{text}");
    assert!(text.contains("in sums with others"), "{text}");
    let with = |name: &str, value: f64| {
        let mut values = sound.clone();
        values.insert(name.to_owned(), value);
        audit(&arm, &values)
    };
    for (name, value, check, word) in [
        ("upper.m", -2.0, "bodies", "a mass of -2 kg"),
        (
            "upper.izz",
            -0.1,
            "bodies",
            "a moment of inertia is negative",
        ),
        (
            "upper.mx",
            -1.5,
            "bodies",
            "its center of mass is 0.750 m from",
        ),
        (
            "upper.ixx",
            0.9,
            "bodies",
            "exceeds the sum of the other two",
        ),
        ("upper.viscous_friction.fv", -0.5, "signs", "is -0.5"),
        (
            "upper.viscous_friction.fv",
            -0.002_080_000_000_000_000_3,
            "signs",
            "`upper.viscous_friction.fv` is -0.00208",
        ),
        (
            "upper.dahl.fc",
            -3.0,
            "friction",
            "effects of joint `upper` add energy",
        ),
        ("lower.izz", -0.3, "inertia", "not positive definite"),
    ] {
        let (_, checks, text) = with(name, value);
        let told = findings(&checks[check]);
        assert!(
            told.iter().any(|said| said.contains(word)),
            "{name}: {text}"
        );
    }
}

/// A law whose viscous part begins at a speed, and the same from rest on.
#[test]
fn friction_that_jumps_in_motion_is_told_with_its_speed() {
    let check = |law: &str| {
        let spec = PENDULUM.replace(
            "\n}\n",
            &format!("\n    effects {{ {law}(eps = 0.02) on upper; }}\n}}\n"),
        );
        let of = |name: &str, value: f64| (format!("upper.{law}.{name}"), value);
        let values = [of("fc1", 1.0), of("fc2", 1.5), of("fv1", 2.0)];
        let values = values.into_iter().chain([of("fv2", 0.0), of("fv3", 0.0)]);
        let (code, checks, text) = audit(&spec, &values.collect());
        let jumps = checks["jumps"]["quantities"]
            .as_array()
            .expect("a list")
            .clone();
        (code, jumps, text)
    };
    let (code, jumps, text) = check("rokae");
    assert_eq!(code, Some(1), "{text}");
    let numbers: Vec<f64> = jumps
        .iter()
        .filter_map(|one| one["value"].as_f64())
        .collect();
    // Forward and backward, each by how much and where.
    for (found, wanted) in numbers.iter().zip([0.04, 0.02, -0.04, -0.02]) {
        assert!((found - wanted).abs() < 1e-9, "{text}");
    }
    assert_eq!(numbers.len(), 4, "{text}");
    let (code, jumps, text) = check("rokae_continuous");
    assert_eq!((code, jumps.len()), (Some(0), 0), "{text}");
}

/// Effects of a kind that need more than one joint, an instant, or a link.
/// A turret that is heavy wherever its arms are bent, and has less than no inertia where they are straight; its lightest joint has the least
/// eigenvalue nearly everywhere else.
#[test]
fn an_inertia_that_is_lost_at_a_few_poses_is_found() {
    let robot = "robot Turret {
        coordinates q1, q2, q3, q4, q5;
        parameters I0: kg*m^2, m: kg, J: kg*m^2, w: kg*m^2, v: kg*m^2;
        constants l = 0.5 m;
        kinetic = (I0 + m*((l*sin(q2))^2 + (l*sin(q3))^2 + (l*sin(q4))^2))/2*dot(q1)^2
            + J/2*(dot(q2)^2 + dot(q3)^2 + dot(q4)^2) + (w + v*cos(q5))/2*dot(q5)^2;
        potential = 0*m;
    }";
    for (own, passes) in [(-0.001, false), (-0.02, false), (0.001, true)] {
        let values = [
            ("I0", own),
            ("m", 5.0),
            ("J", 1.0),
            ("w", 0.02),
            ("v", 0.005),
        ];
        let values = values.map(|(name, value)| (name.to_owned(), value));
        let (_, checks, text) = audit(robot, &BTreeMap::from(values));
        assert_eq!(checks["inertia"]["passed"], passes, "{own}: {text}");
        let least = checks["inertia"]["quantities"][0]["value"].as_f64();
        let least = least.expect("a number");
        assert!((least - own).abs() < 1e-4, "{own}: {least}");
    }
}

#[test]
fn what_drifts_couples_or_is_carried_is_looked_at() {
    let audit_with = |effects: &str, values: &[(&str, f64)]| {
        let arm = PENDULUM.replace("\n}\n", &format!("\n    effects {{ {effects} }}\n}}\n"));
        let values = values
            .iter()
            .map(|(name, value)| ((*name).to_owned(), *value));
        audit(&arm, &values.collect())
    };
    let fails = |check: &str, word: &str, effects: &str, values: &[(&str, f64)]| {
        let (_, checks, text) = audit_with(effects, values);
        let told = findings(&checks[check]);
        assert!(
            told.iter().any(|said| said.contains(word)),
            "{effects}: {text}"
        );
    };
    let viscous = [
        ("upper.viscous_friction.fv", 0.5),
        ("lower.viscous_friction.fv", 0.5),
    ];
    let drift = [&viscous[..], &[("upper.parameter_drift.fv", -2.0)]].concat();
    fails(
        "friction",
        "effects of joint `upper` add energy",
        "viscous_friction on all; parameter_drift(settle = 50) on upper;",
        &drift,
    );
    let coupled = [
        &viscous[..],
        &[
            ("upper.gear_coupling.ia", 0.0),
            ("upper.gear_coupling.fv", 5.0),
            ("upper.gear_coupling.fc", 0.0),
        ],
    ];
    fails(
        "friction",
        "effects add energy when joints move together",
        "viscous_friction on all; gear_coupling on (upper, lower);",
        &coupled.concat(),
    );
    let payload = [
        "m", "mx", "my", "mz", "ixx", "ixy", "ixz", "iyy", "iyz", "izz",
    ]
    .map(|element| format!("lower.payload.{element}"));
    let numbers = [0.2, 0.3, 0.0, 0.0, -0.5, 0.0, 0.0, 0.5, 0.0, 0.5];
    let payload: Vec<(&str, f64)> = payload.iter().map(String::as_str).zip(numbers).collect();
    fails(
        "bodies",
        "`lower.payload`: a moment of inertia is negative",
        "payload on lower;",
        &payload,
    );
}

/// A block on `LuGre` bristles under a motor of 5 N: it gives energy where `s2 < s1 rise`, here 6 N s/m, and moves where it breaks away
/// below 5 N.
#[test]
fn bristles_give_energy_where_their_damping_is_large_and_hold_weak_motors() {
    let block = "robot Block {
    coordinates x: m;
    parameters m = 1 kg;
    kinetic = m/2*dot(x)^2;
    potential = 0;
    limits x { velocity = 6; torque = 5 N; }
    effects { lugre_presliding(d = 1e-3, vs = 0.1, rise = 0.5) on x; viscous_friction on x; }
}
";
    let of = |fc: f64, s1: f64, fv: f64| {
        let values = [
            ("x.lugre_presliding.fc", fc),
            ("x.lugre_presliding.s1", s1),
            ("x.viscous_friction.fv", fv),
        ];
        audit(
            block,
            &values.map(|(name, value)| (name.to_owned(), value)).into(),
        )
    };
    let passes = |checks: &BTreeMap<String, Value>, name: &str| checks[name]["passed"] == true;
    for (s1, fv, is_sound) in [
        (12.0, 6.5, true),
        (12.0, 0.2, false),
        (120.0, 5.0, false),
        (0.0, 0.0, true),
    ] {
        let (_, checks, text) = of(2.0, s1, fv);
        assert_eq!(passes(&checks, "memory"), is_sound, "{s1} {fv}: {text}");
        assert!(
            passes(&checks, "friction") && passes(&checks, "drives"),
            "{text}"
        );
    }
    // It breaks away at 1.5 times what it slides with.
    for (fc, is_moved) in [(3.3, true), (3.4, false)] {
        let (_, checks, text) = of(fc, 0.0, 0.4);
        assert_eq!(passes(&checks, "drives"), is_moved, "{fc}: {text}");
    }
    let (code, checks, text) = of(4.0, 12.0, 0.1);
    assert_eq!(code, Some(1));
    let told = findings(&checks["drives"]);
    assert!(
        told[0].contains("has 6.0000 N of friction, but its torque limit is 5.0000 N"),
        "{text}"
    );
    assert!(
        findings(&checks["memory"])[0].contains("effects with memory add energy"),
        "{text}"
    );
}

/// A plate with three digits, and a point of mass on a turning slide.
#[test]
fn rounded_and_degenerate_bodies_are_told_from_impossible_ones() {
    let with = |inertia: &str| {
        let inertial = format!("inertia = [{inertia}]");
        PENDULUM.replace("inertia = [0.001, 0, 0, 0.05, 0, 0.05]", &inertial)
    };
    let none = BTreeMap::new();
    // Beyond a plate by a last digit.
    let (code, _, text) = audit(&with("0.0123, 0, 0, 0.0457, 0, 0.05803"), &none);
    assert_eq!(code, Some(0), "{text}");
    let (_, checks, _) = audit(&with("0.0123, 0, 0, 0.0457, 0, 0.0681"), &none);
    assert_eq!(checks["bodies"]["passed"], false);
    let slide = "robot Slide {
        gravity = [0, 0, 0];
        convention = origin;
        joint turn: revolute { xyz = [0, 0, 0]; axis = [0, 0, 1]; link = hub; }
        joint slide: prismatic { xyz = [0, 0, 0]; axis = [1, 0, 0]; link = point; position = 0 m .. 1 m; }
        link hub { mass = 0; com = [0, 0, 0]; inertia = [0, 0, 0, 0, 0, 0]; }
        link point { mass = 2; com = [0, 0, 0]; inertia = [0, 0, 0, 0, 0, 0]; }
    }";
    let (_, checks, text) = audit(slide, &none);
    assert_eq!(checks["bodies"]["passed"], true, "{text}");
    assert!(
        findings(&checks["inertia"])[0].contains("the mass matrix is singular"),
        "{text}"
    );
}

/// Base parameters: whether some bodies have them.
#[test]
fn base_parameters_are_those_of_some_bodies_or_of_none() {
    let bare: Vec<&str> = PENDULUM
        .lines()
        .filter(|line| !line.contains("link "))
        .collect();
    let base = [
        ("upper.mxr", 1.1),
        ("upper.my", 0.02),
        ("upper.izzr", 0.4),
        ("lower.mxr", 0.2),
        ("lower.my", 0.01),
        ("lower.izzr", -0.1),
    ];
    let mut values: BTreeMap<String, f64> =
        base.map(|(name, value)| (name.to_owned(), value)).into();
    let (_, checks, text) = audit(&bare.join("\n"), &values);
    assert_eq!(checks["bodies"]["passed"], true, "{text}");
    // Signs of friction are no question of bodies, and a stiff spring makes no link exact.
    let more = bare.join("\n").replace(
        "\n}",
        "\n    effects { viscous_friction on all; joint_spring on upper; }\n}",
    );
    let driving = [
        ("upper.viscous_friction.fv", 0.2),
        ("lower.viscous_friction.fv", -0.1),
        ("upper.joint_spring.k", 5e5),
        ("upper.joint_spring.t0", 0.0),
    ];
    let mut with = values.clone();
    with.extend(driving.map(|(name, value)| (name.to_owned(), value)));
    let (_, checks, text) = audit(&more, &with);
    assert_eq!(checks["bodies"]["passed"], true, "{text}");
    assert_eq!(findings(&checks["signs"]).len(), 1, "{text}");
    with.insert("lower.izzr".to_owned(), -0.45);
    let (_, checks, text) = audit(&more, &with);
    assert_eq!(checks["bodies"]["passed"], false, "{text}");
    // A thousand times the arm is as possible as the arm.
    let heavy: BTreeMap<String, f64> = values
        .iter()
        .map(|(name, value)| (name.clone(), 1e3 * value))
        .collect();
    let (_, checks, text) = audit(&bare.join("\n"), &heavy);
    assert_eq!(checks["bodies"]["passed"], true, "{text}");
    // Hardly any moment of inertia about the lower axis, and a heavy one far from it.
    values.insert("lower.izzr".to_owned(), -0.45);
    let (_, checks, text) = audit(&bare.join("\n"), &values);
    assert!(!findings(&checks["bodies"]).is_empty(), "{text}");
}

/// A term that is even in the velocity cancels there and back at one speed, and does not at two.
#[test]
fn friction_of_two_directions_is_looked_at_with_a_speed_for_each() {
    let effects = "viscous_friction on all; asymmetric_viscous on upper;";
    let arm = PENDULUM.replace("\n}\n", &format!("\n    effects {{ {effects} }}\n}}\n"));
    for (delta, drives) in [(0.3, false), (0.7, true)] {
        let values = [
            ("upper.viscous_friction.fv", 0.5),
            ("upper.asymmetric_viscous.delta", delta),
            ("lower.viscous_friction.fv", 0.5),
        ];
        let values = values.map(|(name, value)| (name.to_owned(), value));
        let (_, checks, text) = audit(&arm, &BTreeMap::from(values));
        assert_eq!(checks["friction"]["passed"], !drives, "{text}");
        let found = findings(&checks["friction"]);
        assert!(found.iter().all(|said| said.contains("`upper`")), "{text}");
    }
}
