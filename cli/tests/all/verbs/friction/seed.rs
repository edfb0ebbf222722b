//! Seed 003: its static law, its bristles, and that there is no fall where there is none.

use std::fmt::Write;

use super::motion::speeds;
use super::{number, parameter, rod};
use crate::verbs::common::{Folder, close, json};

/// Friction of seed 003: Coulomb, breakaway, viscous, Stribeck's speed.
const SEED: [f64; 4] = [0.5843, 2.002, 0.1328, 0.8379];

/// Bristles that an encoder tells, N m/rad and N m s/rad.
const STIFFNESS: f64 = 200.0;
const DAMPING: f64 = 1.3;

fn bristled(d: f64) -> String {
    let [coulomb, breakaway, _, speed] = SEED;
    let rise = breakaway / coulomb - 1.0;
    format!(
        "viscous_friction on elbow; lugre_presliding(d = {d}, vs = {speed}, rise = {rise}) on elbow;"
    )
}

/// The rod of seed 003, its twenty speeds, and its torque that rises slowly until the rod breaks away.
fn seed() -> Folder {
    let folder = Folder::new();
    folder.write("rod.robot", &rod(&bristled(SEED[0] / STIFFNESS)));
    folder.write("plain.robot", &rod(""));
    folder.write(
        "values.json",
        &format!(
            r#"{{"elbow.viscous_friction.fv": {}, "elbow.lugre_presliding.fc": {}, "elbow.lugre_presliding.s1": {DAMPING}}}"#,
            SEED[2], SEED[0]
        ),
    );
    folder.write("speeds.csv", &speeds(20, 0.1, 4.5).csv(&[]));
    let simulate = ["simulate", "rod.robot", "--parameters", "values.json"];
    let stiff = [
        "--controller",
        "computed-torque",
        "--frequency",
        "300",
        "--rate",
        "2000",
    ];
    let sensors = [
        "--encoder-bits",
        "22",
        "--torque-noise",
        "0.01",
        "--log-rate",
        "500",
    ];
    let out = ["--trajectory", "speeds.csv", "--out", "log.csv"];
    folder.succeed(&[&simulate[..], &out, &stiff, &sensors].concat());
    folder.write(
        "hang.csv",
        "time,q1\n0,-1.5707963267948966\n1,-1.5707963267948966\n2,-1.5707963267948966\n3,-1.5707963267948966\n",
    );
    folder.write("ramp.csv", "time,tau1\n0,0\n0.5,0\n8.5,2.4\n");
    let sensors = [
        "--encoder-bits",
        "22",
        "--torque-noise",
        "0.005",
        "--duration",
        "7.5",
    ];
    let out = [
        "--trajectory",
        "hang.csv",
        "--torque",
        "ramp.csv",
        "--out",
        "ramp_log.csv",
    ];
    folder.succeed(&[&simulate[..], &out, &sensors].concat());
    folder
}

#[test]
fn the_law_and_the_bristles_of_seed_003_come_back() {
    let folder = seed();
    let friction = ["friction", "plain.robot", "log.csv", "--joint", "elbow"];
    let out = [
        "--pre-sliding",
        "ramp_log.csv",
        "--json",
        "f.json",
        "--figure",
        "f.svg",
    ];
    let said = folder.succeed(&[&friction[..], &out].concat());
    let report = json(&folder.read("f.json"));
    assert_eq!(
        report["points"].as_array().expect("a list").len(),
        20,
        "{said}"
    );
    let law = &report["law"];
    let names = ["coulomb", "breakaway", "viscous", "stribeck_speed"];
    for (name, truth) in names.into_iter().zip(SEED) {
        let (value, std) = (number(&law[name]["value"]), number(&law[name]["std"]));
        assert!((value / truth - 1.0).abs() < 0.02, "{name}: {value} {said}");
        assert!(
            (value - truth).abs() < 5.0 * std && std < 0.02 * truth,
            "{name}: {value} {std}"
        );
    }
    assert!(law["offset"].is_null() && number(&law["probability"]) < 1e-3);
    let stiffness = &report["bristles"]["stiffness"];
    let off = number(&stiffness["value"]) / STIFFNESS - 1.0;
    assert!(off.abs() < 0.1, "{stiffness} {said}");
    // So slow a rise says nothing of damping.
    assert!(report["bristles"]["damping"].is_null(), "{said}");
    let spec = report["spec"].as_str().expect("text");
    assert!(
        spec.contains("lugre_presliding(d = 0.00") && said.contains(spec),
        "{said}"
    );
    close(
        parameter(&report, "elbow.lugre_presliding.fc"),
        SEED[0],
        0.02 * SEED[0],
    );
    assert!(folder.read("f.svg").contains("friction of elbow"));
    coarse(&folder);
    damping(&folder, spec);
}

/// An encoder of two steps to the deflection at sliding does not tell the stiffness, which is said with what it would tell.
fn coarse(folder: &Folder) {
    let simulate = ["simulate", "rod.robot", "--parameters", "values.json"];
    let out = [
        "--trajectory",
        "hang.csv",
        "--torque",
        "ramp.csv",
        "--out",
        "coarse.csv",
    ];
    let sensors = ["--encoder-bits", "12", "--duration", "7.5"];
    folder.succeed(&[&simulate[..], &out, &sensors].concat());
    let friction = ["friction", "plain.robot", "log.csv", "--joint", "elbow"];
    let out = ["--pre-sliding", "coarse.csv", "--json", "coarse.json"];
    folder.succeed(&[&friction[..], &out].concat());
    let report = json(&folder.read("coarse.json"));
    let step = std::f64::consts::TAU / 4096.0;
    close(number(&report["bristles"]["encoder_step"]), step, 1e-9);
    let told = SEED[0] / (5.0 * step);
    let notes = report["notes"].to_string();
    assert!(
        told > 74.0 && told < 78.0 && notes.contains("it resolves stiffnesses below 7"),
        "{notes}"
    );
}

/// From the declarations and the file that were written output error finds what a slow rise does not tell.
fn damping(folder: &Folder, spec: &str) {
    folder.write("bristles.robot", &rod(spec));
    let mut shake = String::from("time,tau1");
    for k in 0..=1200 {
        let t = 0.001 * f64::from(k);
        let wave = 0.25 * (std::f64::consts::TAU * (3.0 * t + 17.0 * t * t)).sin();
        write!(shake, "\n{t:.3},{}", 1.1 * t.min(1.0) + wave).expect("text");
    }
    folder.write("shake.csv", &shake);
    let simulate = ["simulate", "rod.robot", "--parameters", "values.json"];
    let out = [
        "--trajectory",
        "hang.csv",
        "--torque",
        "shake.csv",
        "--out",
        "shake_log.csv",
    ];
    let sensors = ["--encoder-bits", "22", "--duration", "1.2"];
    folder.succeed(&[&simulate[..], &out, &sensors].concat());
    let identify = [
        "identify",
        "bristles.robot",
        "shake_log.csv",
        "--method",
        "output-error",
    ];
    let start = ["--start", "f.json", "--json", "fit.json"];
    folder.succeed(&[&identify[..], &start].concat());
    let found = parameter(&json(&folder.read("fit.json")), "elbow.lugre_presliding.s1");
    close(found, DAMPING, 0.1 * DAMPING);
}

/// Where friction does not fall no fall is told, whatever the noise.
#[test]
fn coulomb_and_viscous_friction_have_no_fall() {
    let folder = Folder::new();
    let effects = "viscous_friction on elbow; coulomb_friction on elbow;";
    folder.write("rod.robot", &rod(effects));
    let truth = [("coulomb", 0.5843), ("viscous", 0.1328)];
    folder.write(
        "values.json",
        r#"{"elbow.viscous_friction.fv": 0.1328, "elbow.coulomb_friction.fc": 0.5843}"#,
    );
    folder.write("speeds.csv", &speeds(9, 0.3, 4.5).csv(&[]));
    for seed in ["1", "2", "3", "4", "5"] {
        let simulate = ["simulate", "rod.robot", "--parameters", "values.json"];
        let out = [
            "--trajectory",
            "speeds.csv",
            "--out",
            "log.csv",
            "--seed",
            seed,
        ];
        let sensors = [
            "--encoder-bits",
            "18",
            "--torque-noise",
            "0.03",
            "--log-rate",
            "250",
        ];
        let stiff = ["--controller", "computed-torque", "--frequency", "100"];
        folder.succeed(&[&simulate[..], &out, &sensors, &stiff].concat());
        let friction = ["friction", "rod.robot", "log.csv", "--joint", "elbow"];
        let said = folder.succeed(&[&friction[..], &["--json", "f.json"]].concat());
        let law = &json(&folder.read("f.json"))["law"];
        assert!(
            law["breakaway"].is_null() && law["stribeck_speed"].is_null(),
            "{seed}: {said}"
        );
        assert!(said.contains("no significant fall with speed"), "{said}");
        assert!(!said.contains("stribeck("), "{said}");
        for (name, truth) in truth {
            let (value, std) = (number(&law[name]["value"]), number(&law[name]["std"]));
            assert!(
                (value - truth).abs() < 4.0 * std && std < 0.03 * truth,
                "{name}: {law}"
            );
        }
    }
}
