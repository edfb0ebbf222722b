//! `audit`.

use std::collections::BTreeMap;

use serde_json::Value;

use crate::common::{Folder, PENDULUM, json};

fn spec(name: &str) -> String {
    let root = concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/specs/pass");
    std::fs::read_to_string(format!("{root}/{name}.robot")).expect("in the repository")
}

/// What `audit` says: exit code, checks by name, what it prints.
fn audit(
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

fn findings(check: &Value) -> Vec<&str> {
    let findings = check["findings"].as_array().expect("a list").iter();
    findings
        .map(|finding| finding.as_str().expect("a sentence"))
        .collect()
}

/// Jia et al. 2021, Table I: set by a solution of least norm with all masses 10 kg.
#[test]
fn the_table_of_seed_002_is_no_arm() {
    let rows = [
        ("m", [10.0; 6]),
        ("mx", [0.0, -858.2752, -76.5142, -0.2413, 0.0616, -1.5041]),
        ("my", [0.0, -5.2483, -861.6599, -3.3241, 3.8733, 1.5720]),
        ("mz", [0.0; 6]),
        ("ixx", [0.0, 3.9782, -10.8293, 0.0998, 0.0595, -0.0227]),
        ("ixy", [0.0, 0.3662, 1.1390, -0.0073, -0.0048, 0.0006]),
        ("ixz", [0.0, 0.5461, -0.2281, -0.0444, -0.0125, -0.0094]),
        ("iyy", [0.0, -7.3663, -0.0585, 0.0, 0.0, 0.0]),
        ("iyz", [0.0, 0.1911, -0.1043, 0.0458, -0.0011, 0.0098]),
        ("izz", [-2.8121, -9.3237, -9.6584, 0.0845, 0.0884, -0.012]),
        (
            "motor_inertia.ia",
            [0.0, 0.0, -2.8085, 0.1407, -0.0429, -0.0411],
        ),
        (
            "rokae.fv1",
            [33.6469, 35.4598, 20.6053, 6.7420, 4.2719, 0.7638],
        ),
        (
            "rokae.fv2",
            [1.6392, 1.2254, 2.5514, -0.0174, 0.2154, 0.0326],
        ),
        (
            "rokae.fv3",
            [-4.5485, -5.5002, -10.4831, -0.3451, -0.5393, -0.0814],
        ),
        (
            "rokae.fc1",
            [8.0499, 13.8660, 9.2687, 3.9203, 3.0459, 0.9669],
        ),
        (
            "rokae.fc2",
            [10.9926, 13.3944, 8.8085, 3.8707, 3.2091, 0.9670],
        ),
    ];
    let values: BTreeMap<String, f64> = rows
        .iter()
        .flat_map(|(name, row)| {
            (1..)
                .zip(row)
                .map(move |(joint, value)| (format!("j{joint}.{name}"), *value))
        })
        .collect();
    let (_, checks, text) = audit(&spec("rokae_like"), &values);
    // No link is a body; rotors 3, 5 and 6 have inertias below zero; nor is the inertia of the whole arm.
    assert_eq!(findings(&checks["bodies"]).len(), 6, "{text}");
    let signs = findings(&checks["signs"]);
    let rotors = ["j3", "j5", "j6"].map(|joint| format!("`{joint}.motor_inertia.ia` is"));
    assert_eq!(signs.len(), 3, "{text}");
    assert!(
        rotors
            .iter()
            .zip(&signs)
            .all(|(rotor, said)| said.starts_with(rotor)),
        "{text}"
    );
    assert_eq!(checks["inertia"]["passed"], false);
    // The cubic terms turn friction round: the joints where that is below their largest speeds.
    let friction = findings(&checks["friction"]);
    for (joint, speed) in [
        ("j1", 2.85),
        ("j2", 2.71),
        ("j3", 1.58),
        ("j5", 3.12),
        ("j6", 3.58),
    ] {
        let said = friction
            .iter()
            .find(|said| said.contains(&format!("`{joint}`")));
        let (_, said) = said
            .expect("the joint")
            .split_once(" from ")
            .expect("a speed");
        let (said, _) = said.split_once(' ').expect("a unit");
        let said: f64 = said.parse().expect("a number");
        assert!((said - speed).abs() < 0.03, "{joint}: {said}");
    }
    assert_eq!(friction.len(), 5, "{text}");
    // With friction that is known to be right the same arm still has no bodies.
    let mut better = values.clone();
    for joint in 1..=6 {
        better.insert(format!("j{joint}.rokae.fv3"), 0.0);
    }
    assert_eq!(
        audit(&spec("rokae_like"), &better).1["friction"]["passed"],
        true
    );
}

/// Tafazoli et al. 2004, Table 1, column UR: the inertia is said to be positive definite everywhere.
#[test]
fn the_table_of_seed_004_is_not_positive_definite() {
    let names = [
        "Ibase_yyr",
        "Ibe_yyr",
        "Ia_yyr",
        "m_ar",
        "Ibe_xxr",
        "Ia_xxr",
        "m_ber",
        "m_cr",
    ];
    let lumps = [1.42, 1.35, -0.40, 0.69, 2.08, 0.95, -19.23, -109.96];
    let mut values: BTreeMap<String, f64> = names
        .iter()
        .zip(lumps)
        .map(|(name, value)| ((*name).to_owned(), value / 1000.0))
        .collect();
    for (joint, (fv, fc)) in (1..).zip([(-2.08, 25.89), (-1.28, 9.19), (-0.18, 9.08)]) {
        values.insert(format!("th{joint}.viscous_friction.fv"), fv / 1000.0);
        values.insert(format!("th{joint}.coulomb_friction.fc"), fc / 1000.0);
    }
    let (_, checks, text) = audit(&spec("phantom"), &values);
    assert!(
        !checks.contains_key("bodies"),
        "a robot of energies has none: {text}"
    );
    assert_eq!(findings(&checks["signs"]).len(), 3, "{text}");
    let inertia = findings(&checks["inertia"]);
    assert!(inertia[0].contains("least eigenvalue -3.3"), "{text}");
    assert_eq!(
        checks["friction"]["passed"], true,
        "dry friction outweighs it at these speeds"
    );
    // With less of it they drive.
    let mut driven = values.clone();
    driven.insert("th1.coulomb_friction.fc".to_owned(), 1e-3);
    let (_, checks, text) = audit(&spec("phantom"), &driven);
    assert!(findings(&checks["friction"])[0].contains("`th1`"), "{text}");
    // Without the negative coefficients, and with a base that is heavy enough, nothing is left to say.
    for joint in 1..=3 {
        values.insert(format!("th{joint}.viscous_friction.fv"), 1e-3);
    }
    values.insert("Ibase_yyr".to_owned(), 5e-3);
    let (code, _, text) = audit(&spec("phantom"), &values);
    assert_eq!(code, Some(0), "{text}");
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
    // Offsets and springs give back what they take; a bent bristle slides.
    let (code, checks, text) = audit(&arm, &sound);
    assert_eq!(code, Some(0), "{text}");
    assert_eq!(checks.len(), 5, "{text}");
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
            "a moment of inertia is below zero",
        ),
        (
            "upper.mx",
            -1.5,
            "bodies",
            "its center of mass would be 0.750 m from",
        ),
        (
            "upper.ixx",
            0.9,
            "bodies",
            "exceeds the sum of the other two",
        ),
        ("upper.viscous_friction.fv", -0.5, "signs", "is -0.5"),
        ("upper.dahl.fc", -3.0, "friction", "joint `upper` is driven"),
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

/// Effects of a kind that need more than one joint, an instant, or a link.
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
        "joint `upper` is driven",
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
        "joints drive each other",
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
        "`lower.payload`: a moment of inertia is below zero",
        "payload on lower;",
        &payload,
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
        findings(&checks["inertia"])[0].contains("the inertia is singular"),
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
