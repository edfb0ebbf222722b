//! Logs as a drive writes them, with a `robot-model.toml` beside them in place of a `log` in the spec.

use std::fmt::Write;

use crate::verbs::common::{CART, Folder, cart_log, folding, moved};

/// An arm of two turning joints whose drives log currents.
fn spec(log: &str) -> String {
    folding("")
        .replacen("d = 0; }", "d = 0; actuator_gain = 0.5 Nm/A; }", 1)
        .replacen(
            "alpha = 0; d = 0; }",
            "alpha = 0; d = 0; actuator_gain = -0.2 Nm/A; }",
            1,
        )
        .replace("effects {", &format!("{log}\n            effects {{"))
}

const BLOCK: &str = "log { time = \"t [ms]\": ms; q = \"shoulder\": deg, \"elbow\": -360 deg/65536; \
    dq = \"shoulder rpm\": rpm, \"elbow rpm\": rpm; tau = \"i up\": A, \"i lo\": mA; }";

const FILE: &str = r#"[log]
time = { column = "t [ms]", unit = "ms" }
q = [{ column = "shoulder", unit = "deg" }, { column = "elbow", unit = "-360 deg/65536" }]
dq = { columns = ["shoulder rpm", "elbow rpm"], unit = "rpm" }
tau = { columns = ["i up", "i lo"], unit = ["A", "mA"] }
"#;

/// A log in SI units as its drives write it: its first 12 s, at 250 Hz.
fn as_of_the_drives(log: &str) -> String {
    let mut text = String::from("mode,i lo,i up,elbow rpm,shoulder rpm,elbow,shoulder,t [ms]\n");
    for row in log.lines().skip(1).step_by(4).take(3000) {
        let fields: Vec<f64> = row
            .split(',')
            .map(|x| x.parse().expect("a number"))
            .collect();
        let [time, up, lo, d_up, d_lo, tau_up, tau_lo] = fields.try_into().expect("seven columns");
        let rpm = |speed: f64| speed * 30.0 / std::f64::consts::PI;
        let (counts, degrees) = (-lo.to_degrees() * 65536.0 / 360.0, up.to_degrees());
        // What stands in an arm's log is in the unit that its gain is per.
        let (milliamperes, amperes) = (1e3 * tau_lo, tau_up);
        let (rpm_lo, rpm_up, ms) = (rpm(d_lo), rpm(d_up), 1e3 * time);
        writeln!(
            text,
            "run,{milliamperes},{amperes},{rpm_lo},{rpm_up},{counts},{degrees},{ms:.3}"
        )
        .expect("a string takes all");
    }
    text
}

/// A folder with `block.robot`, whose spec says it all, `plain.robot`, whose spec does not, and a drive's log in either folder: in
/// `beside` there is a file of settings, in `alone` there is none.
fn folder() -> Folder {
    let folder = Folder::new();
    let values = r#"{"up.viscous_friction.fv": 1.5, "up.coulomb_friction.fc": 0.8,
        "lo.viscous_friction.fv": 0.6, "lo.coulomb_friction.fc": 0.4}"#;
    let wave = |t: f64| [0.9 * (1.1 * t).sin(), 0.7 * (1.7 * t).cos() - 0.4];
    moved(&folder, &spec(""), values, wave);
    let log = as_of_the_drives(&folder.read("log.csv"));
    for name in ["beside", "alone"] {
        std::fs::create_dir(folder.path(name)).expect("a folder");
        folder.write(&format!("{name}/log.csv"), &log);
    }
    folder.write("beside/robot-model.toml", FILE);
    folder.write("block.robot", &spec(BLOCK));
    folder.write("plain.robot", &spec(""));
    folder
}

/// What follows the name of the log that was read.
fn results(folder: &Folder, arguments: &[&str], out: &str) -> (String, String) {
    // Of one verb after the other.
    if folder.path(out).exists() {
        std::fs::remove_file(folder.path(out)).expect("a file");
    }
    let run = folder.run(&[arguments, &["--json", out]].concat());
    assert_eq!(run.code, Some(0), "{arguments:?}: {}", run.stderr);
    let unnamed = |text: &str| text.replace("beside/", "").replace("alone/", "");
    // All but the note that there is a file.
    let json = unnamed(&folder.read(out));
    let kept = json
        .split_inclusive('\n')
        .filter(|line| !line.contains("robot-model.toml"));
    let json = kept.collect::<String>().replace("[\n  ]", "[]");
    let said = run
        .stderr
        .lines()
        .filter(|line| line.contains("robot-model.toml"));
    let told = said.count();
    assert_eq!(
        told,
        usize::from(arguments.contains(&"plain.robot")),
        "{}",
        run.stderr
    );
    let named = |text: String| text.replace("plain.robot", "block.robot");
    (named(unnamed(&run.stdout)), named(json))
}

#[test]
fn every_verb_finds_with_a_file_what_it_finds_with_a_block_to_the_bit() {
    let folder = folder();
    for (verb, options) in [
        ("identify", &["--validate", "LOG"][..]),
        ("identify", &["--form", "filtered"]),
        ("trace", &["--validate", "LOG"]),
        ("dissect", &["--parameters", "fit.json"]),
    ] {
        let [block, file] = [
            ("block.robot", "alone/log.csv"),
            ("plain.robot", "beside/log.csv"),
        ]
        .map(|(spec, log)| {
            let options = options
                .iter()
                .map(|one| if *one == "LOG" { log } else { *one });
            let arguments: Vec<&str> = [verb, spec, log].into_iter().chain(options).collect();
            results(&folder, &arguments, "out.json")
        });
        assert!(block == file, "{verb} {options:?}: {block:?} and {file:?}");
        if verb == "identify" && options[0] == "--validate" {
            folder.write("fit.json", &file.1);
            assert!(file.1.contains("up.viscous_friction.fv"), "{}", file.1);
        }
    }
    // Piece by piece, and a log that judges what was merged.
    for (spec, log) in [
        ("block.robot", "alone/log.csv"),
        ("plain.robot", "beside/log.csv"),
    ] {
        let factor = format!("{spec}.factor");
        folder.succeed(&["identify", spec, log, "--factor", &factor]);
        let merged = ["merge", spec, &factor, "--validate", log];
        let (said, json) = results(&folder, &merged, "out.json");
        folder.write(&format!("{spec}.said"), &(said + &json));
    }
    for kind in ["factor", "said"] {
        let [block, file] =
            ["block.robot", "plain.robot"].map(|spec| folder.read(&format!("{spec}.{kind}")));
        assert!(block == file, "{kind}");
    }
    // Runs at constant speeds are another experiment; that it reads the file is seen at what it refuses.
    folder.write("beside/robot-model.toml", "[log]\nq = 3\n");
    let friction = ["friction", "plain.robot", "beside/log.csv", "--joint", "lo"];
    assert!(
        folder
            .refuse(&friction)
            .contains("--> beside/robot-model.toml:2:5")
    );
}

/// Output error on a cart of one joint, which does not take long.
#[test]
fn a_simulated_arm_is_found_alike_to_the_bit() {
    let folder = Folder::new();
    let block = "log { time = \"t\": ms; q = \"pos\": mm; tau = \"f\"; }\n    effects {";
    folder.write("block.robot", &CART.replace("effects {", block));
    folder.write("plain.robot", CART);
    let mut log = String::from("t,pos,f\n");
    for row in cart_log(5, 0.0, 0.0).lines().skip(1) {
        let fields: Vec<f64> = row
            .split(',')
            .map(|x| x.parse().expect("a number"))
            .collect();
        writeln!(log, "{},{},{}", 1e3 * fields[0], 1e3 * fields[1], fields[2])
            .expect("a string takes all");
    }
    for name in ["beside", "alone"] {
        std::fs::create_dir(folder.path(name)).expect("a folder");
        folder.write(&format!("{name}/log.csv"), &log);
    }
    let file = "[log]\ntime = { column = 't', unit = 'ms' }\nq = { column = 'pos', unit = 'mm' }\ntau = 'f'\n";
    folder.write("beside/robot-model.toml", file);
    let [block, file] = [
        ("block.robot", "alone/log.csv"),
        ("plain.robot", "beside/log.csv"),
    ]
    .map(|(spec, log)| {
        let arguments = ["identify", spec, log, "--method", "output-error"];
        results(&folder, &arguments, "out.json")
    });
    assert!(block.1.contains("rail.viscous_friction.fv"), "{}", block.1);
    assert!(block == file, "{block:?} and {file:?}");
}

#[test]
fn what_was_found_is_the_truth() {
    let folder = folder();
    folder.succeed(&[
        "identify",
        "plain.robot",
        "beside/log.csv",
        "--json",
        "fit.json",
    ]);
    let fit = crate::verbs::common::json(&folder.read("fit.json"));
    for (name, truth) in [
        ("up.viscous_friction.fv", 1.5),
        ("lo.coulomb_friction.fc", 0.4),
    ] {
        let parameters = fit["parameters"].as_array().expect("a list");
        let found = parameters.iter().find(|one| one["name"] == name);
        let value = found
            .and_then(|one| one["value"].as_f64())
            .expect("a number");
        assert!((value - truth).abs() < 0.05 * truth, "{name}: {value}");
    }
}

#[test]
fn a_file_that_is_asked_for_is_read_in_place_of_the_one_beside() {
    let folder = folder();
    folder.write("drive.toml", FILE);
    folder.write("beside/robot-model.toml", "[log]\nq = 3\n");
    for log in ["alone/log.csv", "beside/log.csv"] {
        let identify = [
            "identify",
            "plain.robot",
            log,
            "--log-settings",
            "drive.toml",
        ];
        let run = folder.run(&identify);
        assert_eq!(run.code, Some(0), "{}", run.stderr);
        assert!(
            run.stderr
                .contains("note: drive.toml sets the columns of `dq`, `q`, `tau`, `time`\n"),
            "{}",
            run.stderr
        );
    }
    let none = [
        "identify",
        "plain.robot",
        "alone/log.csv",
        "--log-settings",
        "none.toml",
    ];
    assert!(folder.refuse(&none).contains("cannot read `none.toml`"));
}

/// The file is of the drive, the spec of the arm: channel by channel the file wins, and it is told.
#[test]
fn the_file_wins_over_the_spec_channel_by_channel() {
    let folder = folder();
    // As it was before somebody exchanged a drive.
    let before = BLOCK.replace("\"elbow\": -360 deg/65536", "\"elbow\": rad");
    folder.write("plain.robot", &spec(&before));
    let wrong = folder.run(&[
        "identify",
        "plain.robot",
        "alone/log.csv",
        "--json",
        "wrong.json",
    ]);
    folder.write(
        "beside/robot-model.toml",
        "[log]\nq = { columns = [\"shoulder\", \"elbow\"], unit = [\"deg\", \"-360 deg/65536\"] }\n",
    );
    let run = folder.run(&["identify", "plain.robot", "beside/log.csv"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert!(
        run.stderr.contains(
            "note: beside/robot-model.toml sets the columns of `q`, instead of the spec's `log` (plain.robot:"
        ),
        "{}",
        run.stderr
    );
    let block = folder.succeed(&["identify", "block.robot", "alone/log.csv"]);
    assert_eq!(
        run.stdout.replace("beside/", ""),
        block.replace("alone/", "")
    );
    assert_ne!(wrong.stdout, run.stdout, "counts are no radians");
}

#[test]
fn each_folder_has_its_own_file() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    let renamed = |name: &str, phase| {
        cart_log(10, 0.0, phase).replacen("time,q1,tau1", &format!("t,{name},f"), 1)
    };
    for (name, phase) in [("monday", 0.0), ("tuesday", 1.0)] {
        std::fs::create_dir(folder.path(name)).expect("a folder");
        folder.write(&format!("{name}/log.csv"), &renamed(name, phase));
        let settings = format!("[log]\ntime = 't'\nq = '{name}'\ntau = 'f'\n");
        folder.write(&format!("{name}/robot-model.toml"), &settings);
    }
    let arguments = [
        "identify",
        "cart.robot",
        "monday/log.csv",
        "--validate",
        "tuesday/log.csv",
    ];
    let run = folder.run(&arguments);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    for name in ["monday", "tuesday"] {
        let note = format!("note: {name}/robot-model.toml sets");
        assert!(run.stderr.contains(&note), "{}", run.stderr);
    }
    // No result takes the place of what was read.
    let over = [&arguments[..], &["--json", "monday/robot-model.toml"]].concat();
    assert!(folder.refuse(&over).contains("same file as the input"));
}

#[test]
fn a_damaged_file_is_refused_with_its_place() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    folder.write("log.csv", &cart_log(5, 0.0, 0.0));
    folder.write(
        "values.json",
        r#"{"cart.m": 3, "rail.viscous_friction.fv": 5}"#,
    );
    for (settings, wanted) in [
        ("[log]\nq = ['a'\n", "--> robot-model.toml:"),
        (
            "[log]\nq = { column = 'a', unit = 'degs' }\n",
            "help: write one of `m`, `cm`, `mm`, `um`, or a number times one of these",
        ),
        ("[log]\ntua = 'a'\n", "help: write `tau`"),
        (
            "[log]\nq = { column = 'a', unit = 'deg' }\n",
            "expected a length, found an angle",
        ),
        ("", "the file has no log settings"),
    ] {
        folder.write("robot-model.toml", settings);
        for verb in ["identify", "trace", "dissect"] {
            let mut arguments = vec![verb, "cart.robot", "log.csv", "--json", "out.json"];
            if verb == "dissect" {
                arguments.extend(["--parameters", "values.json"]);
            }
            let said = folder.refuse(&arguments);
            assert!(said.contains(wanted), "{verb}: {said}");
            assert!(said.contains("--> robot-model.toml:"), "{verb}: {said}");
        }
    }
    std::fs::write(folder.path("robot-model.toml"), [b'[', 0xff, 0xfe]).expect("a file");
    let said = folder.refuse(&["identify", "cart.robot", "log.csv"]);
    assert!(
        said.contains("cannot read `robot-model.toml`: line 1 is not UTF-8 text"),
        "{said}"
    );
}

#[test]
fn settings_that_are_a_folder_are_not_passed_over() {
    let folder = Folder::new();
    folder.write("arm.robot", CART);
    folder.write("log.csv", &cart_log(20, 0.5, 0.0));
    std::fs::create_dir(folder.path("robot-model.toml")).expect("a folder");
    let run = folder.run(&["identify", "arm.robot", "log.csv"]);
    assert_eq!(run.code, Some(1), "{}", run.stdout);
    assert!(run.stderr.contains("robot-model.toml"), "{}", run.stderr);
}
