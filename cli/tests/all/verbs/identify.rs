//! `identify`.

use std::fmt::Write;

use crate::verbs::common::{CART, Folder, PENDULUM, cart_log, close, json, numbers};

#[test]
fn identify_finds_a_mass_and_its_friction() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    folder.write("log.csv", &cart_log(20, 0.0, 0.0));
    folder.write("other.csv", &cart_log(10, 0.0, 0.7));
    let arguments = [
        "identify",
        "cart.robot",
        "log.csv",
        "--validate",
        "other.csv",
        "--json",
        "out.json",
    ];
    let table = folder.succeed(&arguments);
    assert!(
        table.contains("cart.m") && table.contains("NRMSE fit: raw samples, N m"),
        "{table}"
    );
    let header: Vec<Vec<&str>> = table
        .lines()
        .skip_while(|line| !line.starts_with("joint "))
        .map(|line| line.split_whitespace().collect())
        .collect();
    assert_eq!(header[0], ["joint", "identification", "validation"]);
    let each = ["RMSE", "MAE", "RMS%", "NRMSE", "fit"];
    assert_eq!(header[1], [each, each].concat());
    assert_eq!(header[2].len(), 1 + 2 * 6, "{table}");
    let out = json(&folder.read("out.json"));
    assert_eq!(out["method"], "wls");
    assert_eq!(out["domain"], "raw");
    assert_eq!(out["rank"], 2);
    let parameter = |k: usize| {
        (
            out["parameters"][k]["name"].as_str(),
            out["parameters"][k]["value"].as_f64(),
        )
    };
    assert_eq!(parameter(0).0, Some("cart.m"));
    assert_eq!(parameter(1).0, Some("rail.viscous_friction.fv"));
    close(parameter(0).1.expect("a number"), 3.0, 0.02);
    close(parameter(1).1.expect("a number"), 5.0, 0.02);
    // Uniform noise 0.1 wide.
    close(numbers(&out["rmse"])[0], 0.1 / 12.0_f64.sqrt(), 3e-3);
    close(
        numbers(&out["rmse_validate"])[0],
        0.1 / 12.0_f64.sqrt(),
        3e-3,
    );
    assert_eq!(
        folder.files(),
        ["cart.robot", "log.csv", "other.csv", "out.json"]
    );

    let ordinary = [
        arguments.as_slice(),
        &["--method", "ls", "--bands", "5,15,40"],
    ]
    .concat();
    folder.succeed(&ordinary);
    assert_eq!(
        json(&folder.read("out.json"))["bands_hz"],
        json("[5.0,15.0,40.0]")
    );
}

#[test]
fn identify_refuses_what_it_cannot_use() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    let log = cart_log(5, 0.0, 0.0);
    folder.write("log.csv", &log);
    folder.write("broken.csv", &log.replacen("0.100,", "0.100,x", 1));
    folder.write(
        "short.csv",
        &log.lines().take(30).collect::<Vec<_>>().join("\n"),
    );
    let said =
        |arguments: &[&str]| folder.refuse(&[&["identify", "cart.robot"], arguments].concat());
    assert!(said(&["broken.csv", "--json", "out.json"]).contains("error: broken.csv:22: `x"));
    assert!(
        said(&["log.csv", "--validate", "broken.csv", "--json", "out.json"])
            .contains("error: broken.csv:22: `x")
    );
    assert!(
        said(&["short.csv", "--json", "out.json"])
            .contains("short.csv: a log of 0.140 s is too short")
    );
    assert!(
        said(&["log.csv", "--bands", "10,30,150"])
            .contains("the cutoff must lie between 0 and 100 Hz")
    );
    assert_eq!(
        said(&["log.csv", "--json", "nowhere/out.json"]),
        "error: cannot write `nowhere/out.json`: there is no folder `nowhere`; create it first\n"
    );
    folder.write("pendulum.robot", PENDULUM);
    let columns = folder.refuse(&["identify", "pendulum.robot", "log.csv"]);
    assert!(
        columns.contains("missing columns `q2`, `tau2`"),
        "{columns}"
    );
    let ways = "in the `log` of the spec, or in a `robot-model.toml` beside the file";
    assert!(columns.contains(ways), "{columns}");
}

#[test]
fn what_the_logs_do_not_separate_has_no_value() {
    let folder = Folder::new();
    let spec = CART.replace(
        "viscous_friction on rail;",
        "viscous_friction on rail; stop on rail;",
    ) + "effect stop(j) { linear c; torque(j) = c * (1 + sign(q(j) - 1)); }\n";
    folder.write("cart.robot", &spec);
    folder.write("log.csv", &cart_log(20, 0.0, 0.0));
    let partial = ["--partial", "--json", "out.json"];
    let table = folder.succeed(&[&["identify", "cart.robot", "log.csv"][..], &partial].concat());
    assert!(
        table.contains("not separable: the logs do not excite these"),
        "{table}"
    );
    assert!(json(&folder.read("out.json"))["combinations"] == json("[]"));
    let out = json(&folder.read("out.json"));
    assert_eq!(out["unexcited"], json(r#"["rail.stop.c"]"#));
    let parameters = out["parameters"].as_array().expect("a list");
    assert_eq!(parameters.len(), 3);
    for parameter in parameters {
        let measured = parameter["name"] != "rail.stop.c";
        assert_eq!(parameter["value"].is_f64(), measured, "{parameter}");
        assert_eq!(parameter["std"].is_f64(), measured, "{parameter}");
    }

    folder.write(
        "states.json",
        r#"{"states":[{"q":[2],"dq":[0],"ddq":[0]}]}"#,
    );
    let eval = ["eval", "cart.robot", "--states", "states.json"];
    let emit = ["emit", "cart.robot", "--lang", "rust", "--out", "."];
    // An older file says so by its list only.
    let older = folder.read("out.json").replace("null", "0.0");
    folder.write("older.json", &older);
    for file in ["out.json", "older.json"] {
        for verb in [eval.as_slice(), emit.as_slice()] {
            let said = folder.refuse(&[verb, &["--parameters", file]].concat());
            assert!(
                said.starts_with(&format!(
                    "error: {file}: the logs did not separate `rail.stop.c` from"
                )),
                "{said}"
            );
        }
    }
}

#[test]
fn the_filtered_form_identifies_without_accelerations() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    folder.write("log.csv", &cart_log(20, 0.0, 0.0));
    folder.write("other.csv", &cart_log(10, 0.0, 0.7));
    let filtered = [
        "identify",
        "cart.robot",
        "log.csv",
        "--validate",
        "other.csv",
        "--form",
        "filtered",
        "--corner",
        "40",
        "--json",
        "out.json",
    ];
    let table = folder.succeed(&filtered);
    assert!(
        table.contains("NRMSE fit: torque through L(s) = w/(s + w) with w = 40.0 rad/s"),
        "{table}"
    );
    let out = json(&folder.read("out.json"));
    assert_eq!(out["form"], "filtered");
    assert_eq!(out["domain"], "filtered");
    assert_eq!(out["rank"], 2);
    close(out["corner"].as_f64().expect("a number"), 40.0, 1e-12);
    for (k, truth) in [(0, 3.0), (1, 5.0)] {
        let value = out["parameters"][k]["value"].as_f64();
        close(value.expect("a number"), truth, 0.02);
    }
    // Noise of 0.1 N width, of which the filter leaves a part.
    let rmse = numbers(&out["rmse_validate"])[0];
    assert!(rmse > 0.0 && rmse < 0.1 / 12.0_f64.sqrt(), "{rmse}");

    folder.succeed(&["identify", "cart.robot", "log.csv", "--json", "out.json"]);
    let out = json(&folder.read("out.json"));
    assert_eq!(out["form"], "acceleration");
    assert!(out["corner"].is_null());
}

#[test]
fn the_filtered_form_refuses_what_it_cannot_filter() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    folder.write("log.csv", &cart_log(20, 0.0, 0.0));
    let said = |arguments: &[&str]| {
        folder.refuse(&[&["identify", "cart.robot", "log.csv"], arguments].concat())
    };
    assert_eq!(
        said(&["--corner", "40"]),
        "error: `--corner` belongs to the filtered form; add `--form filtered`\n"
    );
    let said_of_corner = said(&["--form", "filtered", "--corner", "1e9"]);
    assert!(
        said_of_corner.ends_with(
            "error: --corner: a corner of 1000000000 rad/s on samples at 200 Hz: it must lie between 0 and 628.3185 rad/s\n"
        ),
        "{said_of_corner}"
    );
    let loaded = CART.replace(
        "viscous_friction on rail;",
        "viscous_friction on rail;\n        load_dependent_friction on rail;",
    );
    folder.write("cart.robot", &loaded);
    assert_eq!(
        said(&["--form", "filtered"]),
        "error: cart.robot:7: `rail.load_dependent_friction.mu` has no filtered form: its torque depends on the load, \
         `rigid_torque`, which contains the acceleration; identify with `--form acceleration`, or take the effect out\n"
    );
}

/// A torque sensor that drops out now and then.
#[test]
fn spikes_do_not_move_a_robust_estimate() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    let log: Vec<String> = cart_log(20, 0.0, 0.0)
        .lines()
        .enumerate()
        .map(|(k, line)| match line.rsplit_once(',') {
            Some((rest, _)) if k > 0 && k % 401 < 20 => format!("{rest},60"),
            _ => line.to_owned(),
        })
        .collect();
    folder.write("log.csv", &log.join("\n"));
    let mass = |method: &str| {
        let arguments = ["identify", "cart.robot", "log.csv", "--method", method];
        let said = folder.succeed(&[&arguments[..], &["--json", "out.json"]].concat());
        let out = json(&folder.read("out.json"));
        let errors: f64 = ["cart.m", "rail.viscous_friction.fv"]
            .iter()
            .zip([3.0, 5.0])
            .map(|(name, truth): (&&str, f64)| {
                let mut parameters = out["parameters"].as_array().expect("a list").iter();
                let found = parameters.find(|entry| entry["name"] == **name);
                let value = found.expect("the name")["value"]
                    .as_f64()
                    .expect("a number");
                (value / truth - 1.0).abs()
            })
            .sum();
        (errors, out, said)
    };
    let (plain, out, _) = mass("wls");
    assert!(out["outliers"].is_null());
    let (robust, out, said) = mass("robust");
    assert!(robust < 0.3 * plain, "{robust} {plain}");
    assert!(numbers(&out["outliers"])[0] > 30.0, "{out}");
    assert!(said.contains("outliers: rail "), "{said}");
}

/// A log whose recorder stuck and whose drive had spikes.
fn worn(log: &str) -> String {
    let mut last = String::new();
    let line = |(k, line): (usize, &str)| {
        let line = match line.rsplit_once(',') {
            Some((rest, _)) if k > 0 && k % 997 == 500 => format!("{rest},300"),
            _ => line.to_owned(),
        };
        // All but the time stands still for an eighth of a second.
        let Some((time, values)) = line.split_once(',') else {
            return line;
        };
        if (2001..2126).contains(&k) {
            return format!("{time},{last}");
        }
        values.clone_into(&mut last);
        line.clone()
    };
    let lines: Vec<String> = log.lines().enumerate().map(line).collect();
    lines.join("\n")
}

#[test]
fn faults_of_the_data_are_mended_counted_and_told() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    let log = cart_log(20, 0.0, 0.0);
    folder.write("log.csv", &log);
    folder.write("worn.csv", &worn(&log));
    let fit = |log: &str, options: &[&str]| {
        let basics = ["identify", "cart.robot", log, "--json", "out.json"];
        let run = folder.run(&[&basics, options].concat());
        assert_eq!(run.code, Some(0), "{}", run.stderr);
        let out = json(&folder.read("out.json"));
        let mass = out["parameters"][0]["value"].as_f64().expect("a number");
        (mass, out, run.stderr)
    };
    let (clean, out, said) = fit("log.csv", &[]);
    assert_eq!(out["data_faults"], json("[]"));
    assert!(!said.contains("straight line"), "{said}");
    let (mended, out, said) = fit("worn.csv", &[]);
    let faults = out["data_faults"].as_array().expect("a list");
    let kinds: Vec<&str> = faults
        .iter()
        .map(|fault| fault["kind"].as_str().expect("a word"))
        .collect();
    assert_eq!(kinds, ["held", "spikes", "held"], "{out:#}");
    assert_eq!(faults[1]["channel"], "tau1");
    assert_eq!(
        (&faults[1]["samples"], &faults[1]["first"]),
        (&4.into(), &2.495.into())
    );
    let held = &faults[0];
    assert_eq!(
        (&held["times"], &held["samples"]),
        (&1.into(), &125.into()),
        "{out:#}"
    );
    assert_eq!(
        (&held["first"], &held["longest"]),
        (&10.0.into(), &0.625.into())
    );
    assert_eq!(held["delay"], serde_json::Value::Null);
    assert!(
        said.contains("note: worn.csv: q1 is frozen while the arm moves, once, at"),
        "{said}"
    );
    let (as_logged, out, _) = fit("worn.csv", &["--as-logged"]);
    assert_eq!(out["data_faults"], json("[]"));
    assert!((mended / clean - 1.0).abs() < 2e-3, "{mended} {clean}");
    assert!(
        (as_logged / clean - 1.0).abs() > 0.02,
        "{as_logged} {clean}"
    );
}

#[test]
fn degrees_are_told() {
    let folder = Folder::new();
    let spec = "robot P {
        gravity = [0, -9.81, 0];
        convention = standard_dh;
        joint turn: revolute { a = 0.5; alpha = 0; d = 0; }
    }";
    folder.write("turn.robot", spec);
    let mut log = String::from("time,q1,tau1\n");
    for k in 0..4000 {
        let t = f64::from(k) / 200.0;
        let q = 80.0 * (1.7 * t).sin();
        let ddq = -80.0_f64.to_radians() * 1.7 * 1.7 * (1.7 * t).sin();
        let tau = 0.3 * ddq + 2.0 * q.to_radians().sin();
        writeln!(log, "{t},{q},{tau}").expect("a string takes all");
    }
    folder.write("log.csv", &log);
    let run = folder.run(&["identify", "turn.robot", "log.csv"]);
    assert!(run.stderr.contains("is it in degrees?"), "{}", run.stderr);
}
