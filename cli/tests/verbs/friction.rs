//! `friction`: a joint's friction curve, its law, and its bristles.

use std::fmt::Write;

use serde_json::Value;

use crate::common::{Folder, close, json, white};

/// Friction of seed 003: Coulomb, breakaway, viscous, Stribeck's speed.
const SEED: [f64; 4] = [0.5843, 2.002, 0.1328, 0.8379];

/// Bristles that an encoder tells, N m/rad and N m s/rad.
const STIFFNESS: f64 = 200.0;
const DAMPING: f64 = 1.3;

/// A rod under gravity that hangs at -90 degrees.
fn rod(effects: &str) -> String {
    format!(
        "robot Rod {{
            gravity = [0, -9.81, 0];
            convention = standard_dh;
            joint elbow: revolute {{ a = 0.21; alpha = 0; d = 0; }}
            link elbow {{ mass = 0.5; com = [-0.105, 0, 0]; inertia = [0, 0, 0, 0, 0, 0.0018375]; }}
            effects {{ {effects} }}
        }}"
    )
}

/// An arm that hangs down, whose lower joint has dry and viscous friction.
fn two(effects: &str) -> String {
    format!(
        "robot Two {{
            gravity = [0, -9.81, 0];
            convention = standard_dh;
            joint up: revolute {{ a = 0.5; alpha = 0; d = 0; }}
            joint lo: revolute {{ a = 0.4; alpha = 0; d = 0; }}
            link up {{ mass = 2; com = [-0.25, 0, 0]; inertia = [0.001, 0, 0, 0.05, 0, 0.05]; }}
            link lo {{ mass = 1; com = [-0.2, 0, 0]; inertia = [0.001, 0, 0, 0.02, 0, 0.02]; }}
            effects {{ viscous_friction on all; coulomb_friction on all; {effects} }}
        }}"
    )
}

const TWO: &str = r#"{"up.viscous_friction.fv": 1.0, "up.coulomb_friction.fc": 1.5, "lo.viscous_friction.fv": 0.5, "lo.coulomb_friction.fc": 0.7"#;

/// Positions, velocities and accelerations over time.
struct Motion {
    step: f64,
    at: [f64; 3],
    rows: Vec<[f64; 3]>,
}

impl Motion {
    fn new(q: f64) -> Self {
        let at = [q, 0.0, 0.0];
        Self {
            step: 0.005,
            at,
            rows: vec![at],
        }
    }

    /// Goes on at an acceleration.
    fn accelerate(&mut self, acceleration: f64, seconds: f64) {
        let mut left = seconds;
        while left > 0.5 * self.step {
            let [q, dq, _] = self.at;
            let h = self.step;
            let next = dq + h * acceleration;
            self.at = [q + 0.5 * h * (dq + next), next, acceleration];
            self.rows.push(self.at);
            left -= h;
        }
    }

    /// Reaches a speed, keeps it, and rests.
    fn run(&mut self, speed: f64, seconds: f64) {
        // In whole steps.
        let steps = (speed.abs() / 15.0 / self.step).ceil().max(4.0);
        let rise = steps * self.step;
        for (acceleration, seconds) in [
            (speed / rise, rise),
            (0.0, seconds),
            (-speed / rise, rise),
            (0.0, 0.2),
        ] {
            self.accelerate(acceleration, seconds);
        }
    }

    /// A trajectory of an arm whose other joints stand at `before`.
    fn csv(&self, before: &[f64]) -> String {
        let mut text = String::from("time");
        let joints = before.len() + 1;
        for stem in ["q", "dq", "ddq"] {
            (1..=joints).for_each(|joint| write!(text, ",{stem}{joint}").expect("text"));
        }
        for (k, row) in self.rows.iter().enumerate() {
            write!(text, "\n{:.4}", self.step * k as f64).expect("text");
            for (order, value) in row.iter().enumerate() {
                for stand in before {
                    let stand = if order == 0 { *stand } else { 0.0 };
                    write!(text, ",{stand}").expect("text");
                }
                write!(text, ",{value}").expect("text");
            }
        }
        text
    }
}

/// `count` speeds from 30 to at most 310 degrees and quickly back, from `least` to `most`.
fn speeds(count: i32, least: f64, most: f64) -> Motion {
    let (low, high) = (30_f64.to_radians(), 310_f64.to_radians());
    let mut motion = Motion::new(low);
    for k in 0..count {
        let speed = least * (most / least).powf(f64::from(k) / f64::from(count - 1));
        motion.run(speed, (0.85 * (high - low) / speed).min(3.0));
        let back = motion.at[0] - low;
        // Two quarters of the way to speed up and slow down.
        let seconds = 0.2 * (back / 0.4).sqrt().max(1.0).ceil();
        let acceleration = -back / seconds.powi(2);
        motion.accelerate(acceleration, seconds);
        motion.accelerate(-acceleration, seconds);
        motion.accelerate(0.0, 0.2);
        motion.at = [low, 0.0, 0.0];
    }
    motion
}

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

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value}"))
}

fn parameter(report: &Value, name: &str) -> f64 {
    let parameters = report["parameters"].as_array().expect("a list");
    let found = parameters.iter().find(|entry| entry["name"] == name);
    number(&found.unwrap_or_else(|| panic!("{name}"))["value"])
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
    damping(&folder, spec);
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
        assert!(said.contains("no fall with speed beyond chance"), "{said}");
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

/// The lower joint moves both ways while the upper one stands: gravity is fitted, or comes from parameters.
#[test]
fn the_curve_of_one_joint_of_two() {
    let folder = Folder::new();
    folder.write("two.robot", &two(""));
    folder.write("biased.robot", &two("torque_offset on lo;"));
    folder.write("values.json", &format!("{TWO}}}"));
    folder.write(
        "biased.json",
        &format!(r#"{TWO}, "lo.torque_offset.offset": 0.3}}"#),
    );
    let mut motion = Motion::new(-1.0);
    for speed in [0.2, 0.4, 0.7, 1.1, 1.6] {
        let seconds = (2.0_f64 / speed).min(2.5);
        motion.run(speed, seconds);
        motion.run(-speed, seconds);
    }
    folder.write("wanted.csv", &motion.csv(&[-0.9]));
    // A few degrees, there and back and one way; and ever elsewhere, over less than a degree each.
    let (mut short, mut one_way) = (Motion::new(0.5), Motion::new(0.5));
    let mut apart = Motion::new(0.0);
    for speed in [0.05, 0.08, 0.12, 0.2] {
        for motion in [&mut short, &mut one_way] {
            motion.run(speed, 0.5);
        }
        short.run(-speed, 0.5);
        apart.run(0.03 * speed, 0.5);
        for acceleration in [4.0, -4.0] {
            apart.accelerate(acceleration, 0.25);
        }
        apart.accelerate(0.0, 0.2);
    }
    let motions = [("short", &short), ("one_way", &one_way), ("apart", &apart)];
    for (name, motion) in motions {
        folder.write(&format!("{name}.csv"), &motion.csv(&[-0.9]));
    }
    for (wanted, log) in [
        ("wanted.csv", "log.csv"),
        ("short.csv", "short_log.csv"),
        ("one_way.csv", "one_way_log.csv"),
        ("apart.csv", "apart_log.csv"),
    ] {
        let simulate = ["simulate", "biased.robot", "--parameters", "biased.json"];
        let out = ["--trajectory", wanted, "--out", log, "--log-rate", "500"];
        let sensors = ["--encoder-bits", "20", "--torque-noise", "0.005"];
        let stiff = ["--controller", "computed-torque", "--frequency", "100"];
        folder.succeed(&[&simulate[..], &out, &sensors, &stiff].concat());
    }
    let check = |said: &str| {
        let report = json(&folder.read("f.json"));
        let points = report["points"].as_array().expect("a list");
        assert_eq!(points.len(), 10, "{said}");
        for point in points {
            let v = number(&point["speed"]);
            let truth = 0.7 * v.signum() + 0.5 * v + 0.3;
            close(number(&point["torque"]), truth, 0.02);
        }
        let law = &report["law"];
        for (name, truth) in [("coulomb", 0.7), ("viscous", 0.5), ("offset", 0.3)] {
            close(number(&law[name]["value"]), truth, 0.02);
        }
        assert!(
            report["spec"]
                .as_str()
                .expect("text")
                .contains("torque_offset on lo;")
        );
    };
    let friction = [
        "friction",
        "two.robot",
        "log.csv",
        "--joint",
        "lo",
        "--json",
        "f.json",
    ];
    check(&folder.succeed(&friction));
    let known = ["--parameters", "values.json"];
    check(&folder.succeed(&[&friction[..], &known].concat()));

    // Gravity of a few degrees is as good as an offset: friction is the difference of both ways.
    let said = folder.succeed(&[
        "friction",
        "two.robot",
        "short_log.csv",
        "--joint",
        "lo",
        "--json",
        "f.json",
    ]);
    let report = json(&folder.read("f.json"));
    close(number(&report["law"]["coulomb"]["value"]), 0.7, 0.005);
    assert!(!said.contains("torque_offset"), "{said}");
    assert!(
        report["notes"]
            .to_string()
            .contains("a constant torque of the rigid body"),
        "{report}"
    );
    for (log, what) in [
        (
            "one_way_log.csv",
            "cannot be told from its friction: of 2 columns",
        ),
        (
            "apart_log.csv",
            "cannot be told from its friction: of 2 columns",
        ),
    ] {
        let near = ["friction", "two.robot", log, "--joint", "lo"];
        let said = folder.refuse(&near);
        assert!(
            said.contains(what) && said.contains("--parameters"),
            "{said}"
        );
        folder.succeed(&[&near[..], &known].concat());
    }
}

/// A lift's weight is the same at all places: both ways tell it from friction, one does not.
#[test]
fn the_weight_of_a_lift_is_an_offset() {
    let folder = Folder::new();
    folder.write(
        "lift.robot",
        "robot Lift { gravity = [0, 0, -9.81]; convention = origin; joint lift: prismatic { xyz = [0, 0, 0]; axis = [0, 0, 1]; link = cage; } }",
    );
    let log = |ways: &[f64]| {
        let mut text = String::from("time,q1,tau1");
        let (mut q, mut k, mut noise) = (0.0, 0, 1);
        for speed in [0.1, 0.2, 0.3, 0.4] {
            for way in ways {
                let v = way * speed;
                for _ in 0..400 {
                    let tau = 30.0 + 5.0 * way + 8.0 * v + 0.1 * white(&mut noise);
                    write!(text, "\n{:.3},{q:.9},{tau:.6}", 0.005 * f64::from(k)).expect("text");
                    q += 0.005 * v;
                    k += 1;
                }
            }
        }
        text
    };
    folder.write("up.csv", &log(&[1.0]));
    folder.write("both.csv", &log(&[1.0, -1.0]));
    let said = folder.refuse(&["friction", "lift.robot", "up.csv", "--joint", "lift"]);
    assert!(
        said.contains("in one direction") && said.contains("--parameters"),
        "{said}"
    );
    let both = [
        "friction",
        "lift.robot",
        "both.csv",
        "--joint",
        "lift",
        "--json",
        "f.json",
    ];
    let said = folder.succeed(&both);
    let law = &json(&folder.read("f.json"))["law"];
    for (name, truth) in [("coulomb", 5.0), ("viscous", 8.0), ("offset", 30.0)] {
        close(number(&law[name]["value"]), truth, 0.05);
    }
    assert!(
        !said.contains("torque_offset") && said.contains("N s/m"),
        "{said}"
    );
}

/// What is written starts a search that has the friction it declares.
#[test]
fn the_result_starts_output_error() {
    let folder = Folder::new();
    let spec = rod("viscous_friction on elbow; coulomb_friction on elbow;");
    folder.write("rod.robot", &spec);
    folder.write(
        "values.json",
        r#"{"elbow.viscous_friction.fv": 0.2, "elbow.coulomb_friction.fc": 0.5}"#,
    );
    folder.write("speeds.csv", &speeds(5, 0.5, 3.0).csv(&[]));
    let simulate = [
        "simulate",
        "rod.robot",
        "--parameters",
        "values.json",
        "--log-rate",
        "250",
    ];
    let out = [
        "--trajectory",
        "speeds.csv",
        "--out",
        "log.csv",
        "--torque-noise",
        "0.01",
    ];
    folder.succeed(&[&simulate[..], &out].concat());
    let friction = ["friction", "rod.robot", "log.csv", "--joint", "elbow"];
    folder.succeed(&[&friction[..], &["--json", "f.json"]].concat());
    let identify = [
        "identify",
        "rod.robot",
        "log.csv",
        "--method",
        "output-error",
    ];
    let start = ["--start", "f.json", "--json", "fit.json"];
    folder.succeed(&[&identify[..], &start].concat());
    let fit = json(&folder.read("fit.json"));
    close(parameter(&fit, "elbow.coulomb_friction.fc"), 0.5, 0.01);
}

#[test]
fn logs_and_joints_that_do_not_fit_are_refused() {
    let folder = Folder::new();
    folder.write("rod.robot", &rod("viscous_friction on elbow;"));
    let mut motion = String::from("time,q1,tau1");
    let mut slow = String::from("time,q1,tau1");
    for k in 0..2000 {
        let t = 0.005 * f64::from(k);
        write!(motion, "\n{t},{},{}", (6.0 * t).sin(), 0.1 * t.cos()).expect("text");
        write!(slow, "\n{t},{},{}", 0.5 * t, 0.7).expect("text");
    }
    folder.write("swing.csv", &motion);
    folder.write("slow.csv", &slow);
    let said = |log: &str, joint: &str| {
        folder.refuse(&[
            "friction",
            "rod.robot",
            log,
            "--joint",
            joint,
            "--json",
            "f.json",
        ])
    };
    assert!(said("slow.csv", "wrist").contains("its joints are `elbow`"));
    assert!(said("swing.csv", "elbow").contains("nowhere moves at one constant speed"));
    let few = said("slow.csv", "elbow");
    assert!(few.contains("takes 4 speeds, and there are 1"), "{few}");
    folder.write("part.json", r#"{"elbow.m": 0.5}"#);
    let part = [
        "friction",
        "rod.robot",
        "slow.csv",
        "--joint",
        "elbow",
        "--parameters",
        "part.json",
    ];
    // The spec says the rest of the rod, and friction is what is asked for.
    assert!(folder.refuse(&part).contains("there are 1"));
}
