//! The methods of `identify`, on a log of a loop with noisy encoders.

use std::fmt::Write;

use serde_json::Value;

use crate::verbs::common::{Folder, json, numbers};

/// Inertials in the order `up.mxr, up.my, up.izzr, lo.mxr, lo.my, lo.izzr` of the spec below.
pub(crate) const TRUTH: [f64; 6] = [1.0, 0.0, -0.575, 0.2, 0.0, -0.1];

fn spec(link: &str) -> String {
    format!(
        "robot A {{
            gravity = [0, -9.81, 0];
            convention = standard_dh;
            joint up: revolute {{ a = 0.5; alpha = 0; d = 0; }}
            joint lo: revolute {{ a = 0.4; alpha = 0; d = 0; }}
            {link}
            effects {{ viscous_friction on all; }}
        }}"
    )
}

const NOMINAL: &str = "
    link up { mass = 2; com = [-0.25, 0, 0]; inertia = [0.001, 0, 0, 0.05, 0, 0.05]; }
    link lo { mass = 1; com = [-0.2, 0, 0]; inertia = [0.001, 0, 0, 0.02, 0, 0.02]; }";

/// The log of a motion, with its wish beside it.
pub(crate) fn folder() -> Folder {
    let folder = Folder::new();
    folder.write("arm.robot", &spec(NOMINAL));
    folder.write("bare.robot", &spec(""));
    folder.write(
        "values.json",
        r#"{"up.viscous_friction.fv": 1.0, "lo.viscous_friction.fv": 0.5}"#,
    );
    measure(
        &folder,
        &|t| 0.7 * (2.1 * t + 1.0).sin() + 0.2 * (5.3 * t).cos(),
        &["--position-noise", "2e-4"],
    );
    folder
}

/// A motion of both joints and its log.
fn measure(folder: &Folder, lo: &dyn Fn(f64) -> f64, sensors: &[&str]) {
    let mut wanted = String::from("time,q1,q2\n");
    for k in 0..=2000 {
        let t = f64::from(k) / 200.0;
        let up = -1.57 + 0.6 * (1.3 * t).sin() + 0.2 * (4.1 * t).sin();
        writeln!(wanted, "{t},{up},{}", lo(t)).expect("a string takes all");
    }
    folder.write("wanted.csv", &wanted);
    let files = [
        "simulate",
        "arm.robot",
        "--trajectory",
        "wanted.csv",
        "--out",
        "log.csv",
    ];
    let more = ["--parameters", "values.json", "--torque-noise", "0.02"];
    folder.succeed(&[&files[..], &more, sensors].concat());
}

/// What `identify` writes with these options.
pub(crate) fn identify(folder: &Folder, spec: &str, options: &[&str]) -> (Value, String) {
    let basics = ["identify", spec, "log.csv", "--json", "fit.json"];
    let said = folder.succeed(&[&basics, options].concat());
    (json(&folder.read("fit.json")), said)
}

pub(crate) fn values(fit: &Value, of: &str) -> Vec<f64> {
    let parameters = fit["parameters"].as_array().expect("a list");
    let number = |parameter: &Value| parameter[of].as_f64().expect("a number");
    parameters.iter().map(number).collect()
}

#[test]
fn the_other_methods_agree_where_noise_is_small() {
    let folder = folder();
    for (options, name) in [
        (&["--method", "tls"][..], "tls"),
        (&["--method", "ridge"], "ridge"),
        (&["--method", "ridge", "--prior", "0.05"], "ridge"),
        (&["--weights", "torque-norm"], "wls"),
        (&["--weights", "max-torque", "--method", "robust"], "robust"),
        (&["--weights", "max-torque", "--method", "tls"], "tls"),
    ] {
        let (fit, _) = identify(&folder, "arm.robot", options);
        assert_eq!(fit["method"], name);
        for (found, truth) in values(&fit, "value").iter().zip(TRUTH) {
            assert!((found - truth).abs() < 0.01, "{options:?}: {found} {truth}");
        }
        let mae = numbers(&fit["mae"]);
        let rmse = numbers(&fit["rmse"]);
        assert!(
            mae[0] > 0.5 * rmse[0] && mae[0] < rmse[0],
            "{mae:?} {rmse:?}"
        );
        let nrmse = numbers(&fit["nrmse_fit_percent"]);
        assert!(
            nrmse.iter().all(|fit| *fit > 50.0 && *fit < 100.0),
            "{nrmse:?}"
        );
    }
}

#[test]
fn options_of_other_methods_are_refused() {
    let folder = folder();
    for (options, reason) in [
        (
            &["--weights", "max-torque", "--method", "ls"][..],
            "`ls` has its own",
        ),
        (&["--prior", "0.1"], "`--prior` belongs to `--method ridge`"),
        (
            &["--instruments", "wanted.csv"],
            "`--instruments` belongs to `--method iv`",
        ),
        (&["--method", "iv"], "0 motions for 1 log"),
        (
            &["--method", "ridge", "--prior", "-1"],
            "give a share above 0",
        ),
        (
            &["--method", "ridge", "--prior", "0"],
            "give a share above 0",
        ),
        (
            &["--method", "iv", "--instruments", "short.csv"],
            "is 2.000 s long, the log 10.000 s",
        ),
        (
            &["--method", "iv", "--instruments", "one.csv"],
            "has no column `q2`",
        ),
        (
            &["--method", "iv", "--instruments", "log.csv"],
            "log.csv: the noise-free motion is the log's own",
        ),
        (
            &["--method", "iv", "--instruments", "holed.csv"],
            "has a gap from 2.",
        ),
    ] {
        let wanted = folder.read("wanted.csv");
        let lines = wanted.lines().enumerate();
        let kept = lines.filter(|(_, line)| !line.starts_with("2.5"));
        let kept: Vec<&str> = kept.map(|(_, line)| line).collect();
        folder.write("holed.csv", &(kept.join("\n") + "\n"));
        folder.write("one.csv", "time,q1\n0,0\n1,0\n2,0\n3,0\n");
        folder.write("short.csv", "time,q1,q2\n0,0,0\n1,0,0\n1.5,0,0\n2,0,0\n");
        let said = folder.refuse(&[&["identify", "arm.robot", "log.csv"], options].concat());
        assert!(said.contains(reason), "{options:?}: {said}");
    }
    let said = folder.refuse(&["identify", "bare.robot", "log.csv", "--method", "ridge"]);
    assert!(said.contains("no nominal values to use"), "{said}");
}

/// Nothing is read for options that no log makes sense of.
#[test]
fn options_without_sense_are_refused_before_a_log_is_read() {
    let folder = folder();
    let identify = ["identify", "arm.robot", "none.csv"];
    for (bands, reason) in [
        ("5,3,1", "each must be at least the one before it"),
        (
            "0,3,10",
            "write three numbers above zero, such as `10,30,90`",
        ),
        (
            "5,inf,inf",
            "write three numbers above zero, such as `10,30,90`",
        ),
        ("5,15", "write three numbers, such as `10,30,90`"),
    ] {
        let run = folder.run(&[&identify[..], &["--bands", bands]].concat());
        assert_eq!((run.code, run.stdout.as_str()), (Some(2), ""));
        assert!(run.stderr.contains(reason), "{bands}: {}", run.stderr);
    }
    let simulated = ["--method", "output-error"];
    for (options, reason) in [
        (
            [&["--method", "ridge"][..], &["--prior", "0"]],
            "give a share above 0",
        ),
        (
            [&simulated[..], &["--window", "0"]],
            "`--window` must be positive",
        ),
        (
            [&simulated, &["--within", "-5"]],
            "`--within` must be a positive number of percent, not -5",
        ),
        (
            [&simulated, &["--window", "1", "--controller", "law.json"]],
            "`--window` needs an arm driven by the logged torque",
        ),
    ] {
        let said = folder.refuse(&[&identify[..], &options.concat()].concat());
        assert!(said.contains(reason), "{options:?}: {said}");
    }
}

/// A joint that a brake holds takes torque that nobody logs.
#[test]
fn a_joint_that_stands_says_nothing() {
    let folder = Folder::new();
    let effects = "viscous_friction on all; coulomb_friction on lo;";
    let spec = spec(NOMINAL).replace("viscous_friction on all;", effects);
    folder.write("arm.robot", &spec);
    let values = r#"{"up.viscous_friction.fv": 1.0, "lo.viscous_friction.fv": 0.5, "lo.coulomb_friction.fc": 50}"#;
    folder.write("values.json", values);
    measure(&folder, &|_| 0.4, &[]);
    for method in ["wls", "ls", "robust", "ridge"] {
        let (fit, said) = identify(&folder, "arm.robot", &["--method", method, "--partial"]);
        // Of no row that counts there is no share.
        let row = said.lines().rfind(|line| line.starts_with("lo "));
        let row: Vec<&str> = row.expect("a row").split_whitespace().collect();
        assert_eq!(row[3], "-", "{said}");
        assert!(fit["relative_percent"][1].is_null(), "{fit}");
        let parameters = fit["parameters"].as_array().expect("a list");
        let value = |name: &str| {
            let found = parameters
                .iter()
                .find(|parameter| parameter["name"] == name);
            found.expect("the name")["value"].as_f64()
        };
        let viscous = value("up.viscous_friction.fv").expect("it moves");
        assert!((viscous - 1.0).abs() < 0.05, "{method}: {viscous}");
        assert_eq!(value("lo.coulomb_friction.fc"), None, "{method}");
        // Friction holds the weight that its motor does not.
        let left = fit["relative_percent"][0].as_f64().expect("up moves");
        assert!(left < 3.0, "{method}: {left}");
        if let Some(moment) = value("lo.mxr") {
            assert!((moment - TRUTH[3]).abs() < 0.03, "{method}: {moment}");
        }
    }
}

/// Deviations of shapes, and of what is found beside them, are the errors of repeated logs: their noise, and what turns do to them.
#[test]
fn shapes_have_deviations() {
    const DRAWS: u32 = 16;
    let folder = Folder::new();
    let arm = |stribeck: &str| {
        format!(
            "robot A {{
                gravity = [0, -9.81, 0];
                convention = standard_dh;
                joint up: revolute {{ a = 0.5; alpha = 0; d = 0; }}
                link up {{ mass = 2; com = [-0.25, 0, 0]; inertia = [0, 0, 0, 0, 0, 0.05]; }}
                effects {{ viscous_friction on up; coulomb_friction on up; stribeck{stribeck} on up; }}
            }}"
        )
    };
    folder.write("arm.robot", &arm("(vs = 0.4)"));
    folder.write("open.robot", &arm(""));
    let values =
        r#"{"up.viscous_friction.fv": 3, "up.coulomb_friction.fc": 2, "up.stribeck.fs": 1.5}"#;
    folder.write("values.json", values);
    let mut wanted = String::from("time,q1\n");
    for k in 0..=1600 {
        let t = f64::from(k) / 200.0;
        writeln!(
            wanted,
            "{t},{}",
            0.9 * (1.3 * t).sin() + 0.2 * (4.1 * t).cos()
        )
        .expect("a string");
    }
    folder.write("wanted.csv", &wanted);
    let mut found: [Vec<[f64; 2]>; 2] = [Vec::new(), Vec::new()];
    for seed in 0..DRAWS {
        let seed = seed.to_string();
        let motion = [
            "--trajectory",
            "wanted.csv",
            "--parameters",
            "values.json",
            "--out",
            "log.csv",
        ];
        let noise = ["--torque-noise", "0.1", "--seed", &seed, "--rate", "500"];
        folder.succeed(&[&["simulate", "arm.robot"], &motion[..], &noise].concat());
        let (report, said) = identify(&folder, "open.robot", &[]);
        let parameters = report["parameters"].as_array().expect("a list");
        for (name, found) in ["up.stribeck.vs", "up.stribeck.fs"].iter().zip(&mut found) {
            let entry = parameters.iter().find(|entry| entry["name"] == *name);
            let entry = entry.expect("the parameter");
            let number = |key: &str| entry[key].as_f64().unwrap_or_else(|| panic!("{said}"));
            found.push([number("value"), number("std")]);
        }
    }
    for (found, truth) in found.iter().zip([0.4, 1.5]) {
        let root = |values: &dyn Fn(&[f64; 2]) -> f64| {
            (found.iter().map(values).map(|x| x * x).sum::<f64>() / f64::from(DRAWS)).sqrt()
        };
        let (told, errors) = (root(&|x| x[1]), root(&|x| x[0] - truth));
        assert!(
            (0.5..2.0).contains(&(told / errors)),
            "{told} {errors}: {found:?}"
        );
    }
    // A simulation has no filters, which blur a friction that changes within them.
    let (report, said) = identify(&folder, "open.robot", &["--method", "output-error"]);
    let parameters = report["parameters"].as_array().expect("a list");
    for (name, truth) in [("up.stribeck.vs", 0.4), ("up.stribeck.fs", 1.5)] {
        let entry = parameters.iter().find(|entry| entry["name"] == name);
        let [value, std] = ["value", "std"].map(|key| {
            let number = entry.and_then(|entry| entry[key].as_f64());
            number.unwrap_or_else(|| panic!("{said}"))
        });
        assert!((value - truth).abs() < 3.0 * std, "{said}");
    }
}

#[test]
fn methods_have_the_names_that_others_call_them() {
    let folder = folder();
    let found = |method: &str| {
        let identify = ["identify", "arm.robot", "log.csv", "--json", "found.json"];
        folder.succeed(&[&identify[..], &["--method", method]].concat());
        folder.read("found.json")
    };
    assert_eq!(found("ols"), found("ls"));
    let robust = found("robust");
    assert!(found("huber") == robust && found("irls") == robust && found("ls") != robust);
}
