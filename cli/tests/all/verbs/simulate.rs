//! `simulate`.

use std::fmt::Write;

use crate::verbs::common::{CART, Folder, PENDULUM, close, json, numbers};

const VALUES: &str =
    r#"{"cart.m": 3, "rail.viscous_friction.fv": 5, "rail.coulomb_friction.fc": 2}"#;

fn dry() -> String {
    CART.replace(
        "viscous_friction on rail;",
        "viscous_friction on rail; coulomb_friction on rail;",
    )
}

/// The motion of the logs, as a wish.
fn wanted(seconds: u32, phase: f64) -> String {
    let mut text = String::from("time,q1\n");
    for k in 0..=seconds * 50 {
        let t = f64::from(k) / 50.0;
        let q = 0.2 * (1.3 * t + phase).sin() + 0.05 * (4.1 * t).sin();
        writeln!(text, "{t},{q}").expect("a string takes all");
    }
    text
}

pub fn folder() -> Folder {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    folder.write("dry.robot", &dry());
    folder.write("values.json", VALUES);
    folder.write("wanted.csv", &wanted(20, 0.4));
    folder.write("other.csv", &wanted(20, 1.1));
    folder
}

pub const BASICS: [&str; 6] = [
    "simulate",
    "dry.robot",
    "--parameters",
    "values.json",
    "--rate",
    "500",
];

#[test]
fn what_is_simulated_is_identified() {
    let folder = folder();
    let sensors = ["--encoder-bits", "20", "--torque-noise", "0.01"];
    let files = ["--trajectory", "wanted.csv", "--out", "log.csv"];
    let run = [&BASICS[..], &sensors, &files, &["--json", "run.json"]].concat();
    let said = folder.succeed(&run);
    assert!(said.contains("10001 samples of 20 s"), "{said}");
    let log = folder.read("log.csv");
    assert!(log.starts_with("time,q1,dq1,tau1\n"), "{log:.60}");
    let report = json(&folder.read("run.json"));
    assert!(report["events"].as_u64().expect("a count") > 5);
    assert!(numbers(&report["tracking_error"])[0] < 0.05, "{report}");

    folder.succeed(&["identify", "dry.robot", "log.csv", "--json", "fit.json"]);
    let fit = json(&folder.read("fit.json"));
    for (k, truth) in [3.0, 5.0, 2.0].into_iter().enumerate() {
        let parameter = &fit["parameters"][k];
        let value = parameter["value"].as_f64().expect("a number");
        let std = parameter["std"].as_f64().expect("a number");
        // Three deviations, and what the finite band of a log leaves.
        close(value, truth, 3.0 * std + 2e-3 * truth);
    }
    // The same seed, the same bytes.
    let again = [
        &BASICS[..],
        &sensors,
        &["--trajectory", "wanted.csv", "--out", "again.csv"],
    ];
    folder.succeed(&again.concat());
    assert_eq!(folder.read("again.csv"), log);
}

#[test]
fn what_the_spec_lacks_is_traced() {
    let folder = folder();
    for (motion, log) in [("wanted.csv", "one.csv"), ("other.csv", "two.csv")] {
        let more = [
            "--encoder-bits",
            "20",
            "--torque-noise",
            "0.01",
            "--trajectory",
            motion,
        ];
        folder.succeed(&[&BASICS[..], &more, &["--out", log]].concat());
    }
    folder.succeed(&[
        "trace",
        "cart.robot",
        "one.csv",
        "--validate",
        "two.csv",
        "--json",
        "trace.json",
    ]);
    let verdict = json(&folder.read("trace.json"));
    assert_eq!(verdict["outcome"], "explained", "{verdict}");
    assert_eq!(
        verdict["effects"][0]["kind"], "coulomb-friction",
        "{verdict}"
    );
}

#[test]
fn computed_torque_follows_what_pd_does_not() {
    let folder = folder();
    let error = |more: &[&str]| {
        let files = [
            "--trajectory",
            "wanted.csv",
            "--out",
            "log.csv",
            "--json",
            "run.json",
        ];
        folder.succeed(&[&BASICS[..], &files, more].concat());
        numbers(&json(&folder.read("run.json"))["tracking_error"])[0]
    };
    let pd = error(&[]);
    let right = error(&["--controller", "computed-torque"]);
    folder.write(
        "wrong.json",
        &VALUES.replace("\"cart.m\": 3", "\"cart.m\": 2"),
    );
    let wrong = error(&[
        "--controller",
        "computed-torque",
        "--control-parameters",
        "wrong.json",
    ]);
    assert!(right < wrong && wrong < pd, "{right} {wrong} {pd}");
}

/// Without a controller the arm falls; what it is pushed by in a file it does.
#[test]
fn an_arm_is_let_go_or_pushed() {
    let folder = folder();
    folder.write("free.robot", &CART.replace("viscous_friction on rail;", ""));
    folder.write("free.json", r#"{"cart.m": 3}"#);
    folder.write("push.csv", "time,tau1\n0,6\n9,6\n");
    folder.write("still.csv", "time,q1\n0,0.5\n1,0.5\n2,0.5\n3,0.5\n");
    let arguments = ["simulate", "free.robot", "--parameters", "free.json"];
    let files = [
        "--trajectory",
        "still.csv",
        "--out",
        "log.csv",
        "--duration",
        "2",
    ];
    folder.succeed(&[&arguments[..], &files, &["--torque", "push.csv"]].concat());
    let log = folder.read("log.csv");
    let last: Vec<f64> = log
        .lines()
        .last()
        .expect("rows")
        .split(',')
        .map(|field| field.parse().expect("a number"))
        .collect();
    // 2 m/s^2 for two seconds.
    close(last[1], 0.5 + 4.0, 1e-9);
    close(last[2], 4.0, 1e-9);
    close(last[3], 6.0, 1e-12);
    let free = [
        &arguments[..],
        &files,
        &["--controller", "none", "--json", "run.json"],
    ]
    .concat();
    let said = folder.succeed(&free);
    assert!(said.contains("drift of energy"), "{said}");
}

/// A motor and its link swing against each other, and the log tells how stiff the spring between them is.
#[test]
fn a_spring_in_the_transmission_is_simulated_and_identified() {
    let folder = folder();
    let soft = |shape: &str| {
        let effects = format!(
            "viscous_friction on all; motor_inertia on lower; joint_elasticity{shape} on lower;"
        );
        PENDULUM.replace("\n}\n", &format!("\n    effects {{ {effects} }}\n}}\n"))
    };
    folder.write("true.robot", &soft("(stiffness = 300)"));
    folder.write("soft.robot", &soft(""));
    folder.write(
        "soft.json",
        r#"{"upper.viscous_friction.fv": 0.5, "lower.viscous_friction.fv": 0.5, "lower.motor_inertia.ia": 0.1}"#,
    );
    let mut motion = String::from("time,q1,q2\n");
    for k in 0..=4000 {
        let t = f64::from(k) / 200.0;
        let upper = 0.6 * (1.3 * t + 0.3).sin() + 0.3 * (3.1 * t).sin();
        let slow = 0.7 * (1.9 * t + 0.3).sin() + 0.1 * (13.0 * t).sin();
        let lower = slow + 0.06 * (23.0 * t + 0.3).sin();
        writeln!(motion, "{t},{upper},{lower}").expect("a string takes all");
    }
    folder.write("fast.csv", &motion);
    let run = ["simulate", "true.robot", "--parameters", "soft.json"];
    let files = ["--trajectory", "fast.csv", "--out", "log.csv"];
    let sensors = ["--encoder-bits", "20", "--torque-noise", "0.01"];
    folder.succeed(&[&run[..], &files, &sensors].concat());
    folder.succeed(&["identify", "soft.robot", "log.csv", "--json", "fit.json"]);
    let fit = json(&folder.read("fit.json"));
    let found = fit["parameters"].as_array().expect("a list").iter();
    let values: Vec<(&str, f64)> = found
        .map(|found| (&found["name"], found["value"].as_f64()))
        .map(|(name, value)| (name.as_str().expect("a name"), value.expect("a value")))
        .collect();
    for (name, value) in [
        ("lower.mxr", 0.2),
        ("lower.viscous_friction.fv", 0.5),
        ("lower.motor_inertia.ia", 0.1),
        ("lower.joint_elasticity.stiffness", 300.0),
    ] {
        let found = values.iter().find(|(found, _)| *found == name);
        close(found.expect("a parameter").1, value, 0.02 * value);
    }

    // What is of motor and link together does not do.
    let effects = "motor_inertia on rail; joint_elasticity(stiffness = 2000) on rail;";
    let cart = CART.replace("viscous_friction on rail;", effects);
    folder.write("cart.robot", &cart);
    folder.write("both.json", r#"{"cart.mr": 4}"#);
    let run = ["simulate", "cart.robot", "--parameters", "both.json"];
    let files = ["--trajectory", "wanted.csv", "--out", "apart.csv"];
    let said = folder.refuse(&[&run[..], &files].concat());
    assert!(
        said.contains("base parameter `cart.mr` sums both"),
        "{said}"
    );
    folder.write("each.json", r#"{"cart.m": 3, "rail.motor_inertia.ia": 1}"#);
    let run = ["simulate", "cart.robot", "--parameters", "each.json"];
    folder.succeed(&[&run[..], &files].concat());
}

#[test]
fn what_is_wanted_beyond_limits_is_told() {
    let folder = folder();
    let limits = "link = cart; position = -0.1 m .. 0.1 m; velocity = 0.2; torque = 0.5;";
    folder.write("narrow.robot", &dry().replace("link = cart;", limits));
    let run = |spec: &str| {
        let files = ["--trajectory", "wanted.csv", "--out", "log.csv"];
        let said = folder.run(&[&["simulate", spec], &BASICS[2..], &files].concat());
        assert_eq!(said.code, Some(0), "{}", said.stderr);
        said.stderr
    };
    let said = run("narrow.robot");
    for what in [
        "has a desired position of",
        "has a desired velocity of",
        "driven with torque",
    ] {
        assert!(said.contains(what), "{said}");
    }
    assert!(!run("dry.robot").contains("beyond"));
}

/// What an effect reads comes from the trajectory and goes into the log; so does the gain of the torque channel.
#[test]
fn channels_pass_to_the_log_and_gains_divide() {
    let folder = folder();
    let spec = CART
        .replace("viscous_friction", "temperature_viscous(beta = 0.1)")
        .replace("axis = [1, 0, 0];", "axis = [1, 0, 0]; actuator_gain = 2;");
    folder.write("warm.robot", &spec);
    folder.write(
        "warm.json",
        r#"{"cart.m": 3, "rail.temperature_viscous.fv": 5}"#,
    );
    let mut motion = String::from("time,q1,temperature\n");
    for k in 0..=100 {
        let t = 0.1 * f64::from(k);
        writeln!(motion, "{t},{t},20").expect("a string takes all");
    }
    folder.write("slide.csv", &motion);
    let run = [
        "simulate",
        "warm.robot",
        "--parameters",
        "warm.json",
        "--trajectory",
        "slide.csv",
    ];
    folder.succeed(&[&run[..], &["--out", "log.csv"]].concat());
    let log = folder.read("log.csv");
    assert!(
        log.starts_with("time,q1,dq1,tau1,temperature\n"),
        "{log:.60}"
    );
    let row = log.lines().nth(9001).expect("a row");
    let row: Vec<f64> = row
        .split(',')
        .map(|field| field.parse().expect("a number"))
        .collect();
    // 5 N s/m at 1 m/s, in a channel of half the force.
    close(row[3], 2.5, 1e-6);
    close(row[4], 20.0, 1e-12);
}
