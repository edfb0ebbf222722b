//! `excite`.

use std::fmt::Write;

use serde_json::Value;

use crate::common::{CART, Folder, PENDULUM, json, numbers};

/// The pendulum with limits and friction.
fn arm() -> String {
    let limits = "position = -120 deg .. 120 deg; velocity = 4; acceleration = 30; torque = 25; }";
    PENDULUM
        .replace("d = 0; }", &format!("d = 0; {limits}"))
        .replace(
            "\n}\n",
            "\n    effects { viscous_friction on all; coulomb_friction on all; }\n}\n",
        )
}

const FRICTION: &str = r#"{"upper.viscous_friction.fv": 0.6, "upper.coulomb_friction.fc": 0.8,
    "lower.viscous_friction.fv": 0.3, "lower.coulomb_friction.fc": 0.4}"#;

const ARM: [&str; 4] = ["excite", "arm.robot", "--parameters", "friction.json"];
/// Little work: what is tested here is not how good the best motion is.
const SMALL: [&str; 6] = ["--starts", "1", "--period", "5", "--harmonics", "3"];

fn folder() -> Folder {
    let folder = Folder::new();
    folder.write("arm.robot", &arm());
    folder.write("friction.json", FRICTION);
    folder
}

/// Columns of a CSV file.
fn columns(text: &str) -> (Vec<String>, Vec<Vec<f64>>) {
    let mut lines = text.lines();
    let head = lines.next().expect("a header").split(',');
    let head: Vec<String> = head.map(str::to_owned).collect();
    let mut columns = vec![Vec::new(); head.len()];
    for line in lines {
        for (column, number) in columns.iter_mut().zip(line.split(',')) {
            column.push(number.parse::<f64>().expect("a number"));
        }
    }
    (head, columns)
}

fn most(column: &[f64]) -> f64 {
    column.iter().fold(0.0, |most: f64, x| most.max(x.abs()))
}

#[test]
fn a_motion_is_written_drawn_and_the_same_again() {
    let folder = folder();
    let outputs = |k: u32| {
        let name = |end: &str| format!("{k}.{end}");
        ["csv", "coefficients.json", "svg", "json"].map(name)
    };
    for k in [1, 2] {
        let [motion, coefficients, figure, report] = outputs(k);
        let files = [
            ["--out", &motion],
            ["--coefficients", &coefficients],
            ["--figure", &figure],
            ["--json", &report],
        ];
        let said = folder.succeed(&[&ARM[..], &SMALL, &files.concat()].concat());
        assert!(said.contains("limits: kept"), "{said}");
    }
    let [motion, coefficients, figure, report] = outputs(1).map(|name| folder.read(&name));
    let again = outputs(2).map(|name| folder.read(&name));
    assert_eq!(
        [&motion, &coefficients, &figure],
        [0, 1, 2].map(|k| &again[k])
    );

    let (head, table) = columns(&motion);
    assert_eq!(head, ["time", "q1", "q2", "dq1", "dq2", "ddq1", "ddq2"]);
    let rows = table[0].len();
    assert_eq!((rows, table[0][rows - 1].to_bits()), (5001, 5f64.to_bits()));
    for (k, limit) in [(1, 120f64.to_radians()), (3, 4.0), (5, 30.0)] {
        assert!(most(&table[k]) <= limit && most(&table[k + 1]) <= limit);
    }
    // It goes to the limits, since the more motion the better.
    assert!(most(&table[3]) > 3.0 || most(&table[5]) > 25.0);
    for row in [0, rows - 1] {
        assert!(table[3..].iter().all(|column| column[row].abs() < 1e-9));
    }

    // The coefficients are the motion.
    let coefficients = json(&coefficients);
    assert_eq!(coefficients["joints"][1]["name"], "lower");
    let of = |key: &str| numbers(&coefficients["joints"][1][key]);
    let (a, b) = (of("a"), of("b"));
    let q0 = coefficients["joints"][1]["q0"].as_f64().expect("a mean");
    let w = std::f64::consts::TAU / 5.0;
    for row in [0, 777, 2500] {
        let t = table[0][row];
        let waves = (0..3).map(|k| {
            let wl = w * f64::from(u8::try_from(k + 1).expect("few"));
            a[k] / wl * (wl * t).sin() - b[k] / wl * (wl * t).cos()
        });
        let q = q0 + waves.sum::<f64>();
        assert!((q - table[2][row]).abs() < 1e-9, "{q} {}", table[2][row]);
    }
    assert!(figure.starts_with("<svg") && figure.contains("upper") && figure.contains("lower"));
    assert!(!figure.contains("NaN") && !figure.contains("inf"));
    let report = json(&report);
    assert_eq!(report["max_violation"], 0.0);
    assert!(report["condition"].as_f64().expect("a number") > 1.0);
    assert!(report["log_det"].is_f64() && report["seconds"].is_f64());
}

/// The loop closes: what is designed is driven, and what is driven is identified.
#[test]
fn a_designed_motion_identifies_the_arm() {
    let folder = folder();
    folder.succeed(&[&ARM[..], &SMALL, &["--out", "motion.csv"]].concat());
    let simulate = |motion: &str, log: &str| {
        let arguments = [
            ["simulate", "arm.robot"],
            ["--trajectory", motion],
            ["--parameters", "friction.json"],
            ["--controller", "computed-torque"],
            ["--torque-noise", "0.02"],
            ["--out", log],
        ];
        folder.succeed(&arguments.concat());
    };
    simulate("motion.csv", "log.csv");
    // The same time at a third of the speed, as a careful user would have moved it by hand.
    let mut slow = String::from("time,q1,q2\n");
    for k in 0..=500 {
        let t = f64::from(k) / 100.0;
        writeln!(slow, "{t},{},{}", (1.26 * t).sin(), 0.5 * (2.5 * t).sin()).expect("a string");
    }
    folder.write("slow.csv", &slow);
    simulate("slow.csv", "slow_log.csv");
    let deviations = |log: &str| -> Vec<f64> {
        folder.succeed(&["identify", "arm.robot", log, "--json", "fit.json"]);
        let fit = json(&folder.read("fit.json"));
        let parameters = fit["parameters"].as_array().expect("a list");
        let deviation = |p: &Value| p["std"].as_f64().expect("a deviation");
        parameters.iter().map(deviation).collect()
    };
    let (designed, careful) = (deviations("log.csv"), deviations("slow_log.csv"));
    assert_eq!(designed.len(), careful.len());
    let ratios = designed.iter().zip(&careful).map(|(x, y)| (x / y).ln());
    let mean = (ratios.sum::<f64>() / designed.len() as f64).exp();
    assert!(mean < 0.5, "{mean}: {designed:?} {careful:?}");
}

/// Two kinds of friction that look alike in a motion of one speed.
#[test]
fn a_motion_tells_two_effects_apart() {
    let folder = folder();
    let rivals = [
        "--separate",
        "quadratic_viscous on lower: c = 0.1",
        "--from",
        "cubic_viscous on lower: c = 0.05",
    ];
    let design = |more: &[&str], report: &str| -> Value {
        let files = ["--out", "out.csv", "--json", report];
        folder.succeed(&[&ARM[..], &SMALL, more, &files].concat());
        json(&folder.read(report))
    };
    let apart = design(&rivals, "apart.json");
    // The same with the first motion that is drawn.
    let first = design(&[&rivals[..], &["--budget", "1e-9"]].concat(), "first.json");
    assert!(design(&[], "any.json")["distances"].is_null());
    let (best, drawn) = (numbers(&apart["distances"]), numbers(&first["distances"]));
    assert!(
        best[0] * best[1] > 1.5 * drawn[0] * drawn[1],
        "{apart} {first}"
    );
    assert_eq!(apart["max_violation"], 0.0);

    let said = folder.refuse(
        &[
            &ARM[..],
            &SMALL,
            &[
                "--out",
                "out2.csv",
                "--separate",
                "stribeck on lower:",
                "--from",
                "dahl on lower: f = 1",
            ],
        ]
        .concat(),
    );
    assert!(said.contains("is no effect with its size"), "{said}");
    let said = folder.refuse(
        &[
            &ARM[..],
            &SMALL,
            &[
                "--out",
                "out2.csv",
                "--separate",
                "sticktion on lower: fs = 1",
            ],
            &rivals[2..],
        ]
        .concat(),
    );
    assert!(said.contains("sticktion"), "{said}");
    let said = folder.refuse(
        &[
            &ARM[..],
            &SMALL,
            &[
                "--out",
                "out2.csv",
                "--separate",
                "quadratic_viscous on wrist: c = 1",
            ],
            &rivals[2..],
        ]
        .concat(),
    );
    assert!(said.contains("wrist"), "{said}");
}

#[test]
fn rivals_that_are_none_are_told() {
    let folder = folder();
    let cubic = "cubic_viscous on lower";
    for (first, second, word) in [
        (
            "quadratic_viscous on all: c = 1",
            cubic,
            "name one, as in `quadratic_viscous on upper`",
        ),
        (
            "backlash(half_gap = 0.001) on lower",
            cubic,
            "no parameter that the torque is linear in",
        ),
        (
            "quadratic_viscous on lower: c = 0",
            cubic,
            "one has no size",
        ),
        (
            "quadratic_viscous on lower: k = 1",
            cubic,
            "has `c`: say what each",
        ),
        (cubic, cubic, "nothing tells an effect from itself"),
        (
            "dahl on lower: fc = 1",
            cubic,
            "follows from more than the motion",
        ),
    ] {
        let arguments = ["--out", "out.csv", "--separate", first, "--from", second];
        let said = folder.refuse(&[&ARM[..], &SMALL, &arguments].concat());
        assert!(said.contains(word), "{first}: {said}");
    }
}

/// A period that is no whole number of samples but for rounding, and what drives it.
#[test]
fn every_period_can_be_driven() {
    let folder = folder();
    for period in ["4.03", "2.0005"] {
        let arguments = [
            "--starts",
            "1",
            "--period",
            period,
            "--harmonics",
            "2",
            "--budget",
            "0.01",
        ];
        folder.succeed(&[&ARM[..], &arguments, &["--out", "motion.csv"]].concat());
        let (_, table) = columns(&folder.read("motion.csv"));
        assert!(
            table[0].windows(2).all(|pair| pair[1] > pair[0]),
            "{period}"
        );
        let simulate = ["simulate", "arm.robot", "--parameters", "friction.json"];
        let files = ["--trajectory", "motion.csv", "--out", "log.csv"];
        folder.succeed(&[&simulate[..], &files].concat());
    }
}

/// Torque limits are verified with friction that jumps, whose peak the search does not see.
#[test]
fn torque_limits_hold_with_friction_that_peaks() {
    let folder = folder();
    let peak = arm().replace(
        "coulomb_friction on all;",
        "coulomb_friction on all; stribeck(vs = 0.05) on all;",
    );
    folder.write("peak.robot", &peak);
    let values = FRICTION.replace('}', r#", "upper.stribeck.fs": 9, "lower.stribeck.fs": 4}"#);
    folder.write("peak.json", &values);
    let arguments = [
        "excite",
        "peak.robot",
        "--parameters",
        "peak.json",
        "--rate",
        "2400",
    ];
    folder.succeed(
        &[
            &arguments[..],
            &SMALL,
            &["--out", "motion.csv", "--json", "out.json"],
        ]
        .concat(),
    );
    assert!(
        json(&folder.read("out.json"))["max_violation"]
            .as_f64()
            .expect("a number")
            <= 0.0
    );
    let (_, table) = columns(&folder.read("motion.csv"));
    let friction = |dq: f64| {
        let peak = 9.0 * (-(dq / 0.05).powi(2)).exp();
        0.6 * dq + (0.8 + peak) * dq.signum()
    };
    // The pendulum's torque at the upper joint, by hand.
    for row in 1..table[0].len() - 1 {
        let at = |k: usize| table[k][row];
        let [q1, q2, v1, v2, a1, a2] = [1, 2, 3, 4, 5, 6].map(at);
        let lever = 0.5 * 0.2 * q2.cos();
        let far = 0.2 * 0.2 + 0.02;
        let near = 2.0 * 0.25 * 0.25 + 0.05 + 0.5 * 0.5 + far;
        let turning = -0.5 * 0.2 * q2.sin() * v2 * (2.0 * v1 + v2);
        let weight = 9.81 * ((2.0 * 0.25 + 0.5) * q1.cos() + 0.2 * (q1 + q2).cos());
        let torque =
            (near + 2.0 * lever) * a1 + (far + lever) * a2 + turning + weight + friction(v1);
        // Between the instants of the verified grid the peak may be a little higher.
        assert!(torque.abs() < 25.0 * 1.03, "{row}: {torque}");
    }
}

#[test]
fn links_stay_in_their_room() {
    let folder = folder();
    // The tip stays above the floor that the lower link could reach.
    folder.write(
        "room.json",
        r#"{"balls": [{"link": "lower", "radius": 0.05}, {"link": "upper", "radius": 0.05}],
            "planes": [{"normal": [0, 1, 0], "offset": -0.7}]}"#,
    );
    let lowest = |room: &[&str]| {
        folder.succeed(&[&ARM[..], &SMALL, &["--out", "m.csv"], room].concat());
        let (_, table) = columns(&folder.read("m.csv"));
        let heights = table[1].iter().zip(&table[2]);
        heights
            .map(|(q1, q2)| 0.5 * q1.sin() + 0.4 * (q1 + q2).sin())
            .fold(f64::INFINITY, f64::min)
    };
    let (free, kept) = (lowest(&[]), lowest(&["--room", "room.json"]));
    assert!(free < -0.68, "the floor is in the way: {free}");
    assert!(kept >= -0.65, "{kept}");
    for (room, word) in [
        (
            r#"{"balls": [{"link": "hand", "radius": 0.1}]}"#,
            "no link `hand`",
        ),
        (
            r#"{"balls": [{"link": "lower", "radius": -1}]}"#,
            "the radius -1",
        ),
        (
            r#"{"balls": [], "planes": [{"normal": [0, 0, 0], "offset": 0}]}"#,
            "the normal",
        ),
        (
            r#"{"balls": [], "box": {"low": [0, 0, 0], "high": [1, 0, 1]}}"#,
            "no inside",
        ),
        (r#"{"bals": []}"#, "bals"),
        ("{", "line 1"),
    ] {
        folder.write("bad.json", room);
        let said =
            folder.refuse(&[&ARM[..], &SMALL, &["--out", "n.csv", "--room", "bad.json"]].concat());
        assert!(said.contains(word), "{room}: {said}");
    }
    // A room that is nowhere.
    folder.write(
        "none.json",
        r#"{"balls": [{"link": "lower", "radius": 0.05}], "planes": [{"normal": [0, 1, 0], "offset": 2}]}"#,
    );
    let said =
        folder.refuse(&[&ARM[..], &SMALL, &["--out", "n.csv", "--room", "none.json"]].concat());
    assert!(
        said.contains("no motion keeps the limits") && said.contains("lower"),
        "{said}"
    );
}

#[test]
fn what_leaves_no_design_is_told() {
    let folder = folder();
    let range = "link = cart; position = -1 m .. 1 m;";
    folder.write("cart.robot", &CART.replace("link = cart;", range));
    let refused = |arguments: &[&str]| {
        folder.refuse(&[&ARM[..], &SMALL, &["--out", "out.csv"], arguments].concat())
    };
    for (arguments, word) in [
        (["--noise", "1,2,3"], "3 numbers, the arm 2 joints"),
        (["--noise", "0"], "a standard deviation is positive"),
        (["--budget", "0"], "a number of seconds"),
        (["--rate", "0"], "a rate in Hz"),
        (["--rate", "NaN"], "a rate in Hz"),
        (["--pose", "0.1"], "1 positions, the arm 2 joints"),
        (["--pose", "0,9"], "joint `lower` at 9, which is not within"),
        (["--pose", "nan,0"], "joint `upper` at NaN"),
        (["--columns", "upper.m"], "names 1 parameter"),
        (["--json", "arm.robot"], "same file as the input"),
    ] {
        let said = refused(&arguments);
        assert!(said.contains(word), "{arguments:?}: {said}");
    }
    let said = folder.refuse(&["excite", "cart.robot", "--out", "out.csv"]);
    assert!(said.contains("`rail` has no velocity limit"), "{said}");
    for period in ["0", "inf", "NaN"] {
        let said = folder.refuse(&["excite", "arm.robot", "--out", "o.csv", "--period", period]);
        assert!(said.contains("period"), "{period}: {said}");
    }
    let said = folder.refuse(&["excite", "arm.robot", "--out", "o.csv", "--harmonics", "1"]);
    assert!(said.contains("at least two"), "{said}");
    let said = folder.refuse(&[
        "excite",
        "arm.robot",
        "--out",
        "o.csv",
        "--harmonics",
        "1000000",
    ]);
    assert!(said.contains("from 2 to 100"), "{said}");
    folder.write(
        "slide.robot",
        &CART.replace("link = cart;", "link = cart; velocity = 1;"),
    );
    let said = folder.refuse(&["excite", "slide.robot", "--out", "o.csv"]);
    assert!(said.contains("slides without position limits"), "{said}");
    let still = ["--period", "0.001", "--starts", "1", "--budget", "1"];
    let said = folder.refuse(&[&["excite", "arm.robot", "--out", "o.csv"], &still[..]].concat());
    assert!(said.contains("the parameters from each other"), "{said}");
    // Dry friction alone is more than the motor has, wherever the arm is.
    let upper = arm().replacen("torque = 25", "torque = 30", 1);
    folder.write("rusty.robot", &upper.replace("torque = 25", "torque = 5"));
    folder.write(
        "rusty.json",
        &FRICTION.replace(
            r#""lower.coulomb_friction.fc": 0.4"#,
            r#""lower.coulomb_friction.fc": 6"#,
        ),
    );
    let rusty = [
        "excite",
        "rusty.robot",
        "--parameters",
        "rusty.json",
        "--out",
        "o.csv",
    ];
    let said = folder.refuse(&rusty);
    assert!(said.contains("torque of `lower`"), "{said}");
}

#[test]
fn a_search_that_is_stopped_gives_the_best_so_far() {
    let folder = folder();
    let many = ["--starts", "100000", "--budget", "0.001"];
    let arguments = [&ARM[..], &many, &["--out", "m.csv", "--json", "m.json"]].concat();
    let said = folder.run(&arguments);
    assert_eq!(said.code, Some(0), "{}", said.stderr);
    assert!(
        said.stderr.contains("stopped after 1 start"),
        "{}",
        said.stderr
    );
    let report = json(&folder.read("m.json"));
    assert_eq!(
        (&report["stopped"], &report["max_violation"]),
        (&true.into(), &0.0.into())
    );
    let (_, table) = columns(&folder.read("m.csv"));
    assert!(most(&table[3]) <= 4.0 && most(&table[4]) > 0.0);
}

/// Somebody who presses Ctrl-C has seen enough.
#[cfg(unix)]
#[test]
fn an_interrupt_gives_the_best_so_far() {
    use std::io::{BufRead, BufReader};
    use std::process::{Command, Stdio};

    let folder = folder();
    let mut search = Command::new(env!("CARGO_BIN_EXE_robot-model"))
        .current_dir(folder.path("."))
        .args([&ARM[..], &["--starts", "1000000", "--out", "m.csv"]].concat())
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    let mut lines = BufReader::new(search.stderr.take().expect("a pipe")).lines();
    let is_second =
        |line: &std::io::Result<String>| line.as_ref().expect("text").starts_with("start 2 of");
    assert!(lines.any(|line| is_second(&line)), "it looks on");
    let interrupt = Command::new("kill")
        .args(["-INT", &search.id().to_string()])
        .status();
    assert!(interrupt.expect("kill is there").success());
    let rest: Vec<String> = lines.map_while(Result::ok).collect();
    assert_eq!(search.wait().expect("an end").code(), Some(0), "{rest:?}");
    assert!(
        rest.iter().any(|line| line.contains("stopped after")),
        "{rest:?}"
    );
    let (_, table) = columns(&folder.read("m.csv"));
    assert!(most(&table[3]) <= 4.0 && most(&table[3]) > 0.0);
}
