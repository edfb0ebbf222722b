//! Every verb on inputs that are sound, and on inputs that are not.

mod common;

use common::{CART, Folder, PENDULUM, URDF, cart_log};
use serde_json::Value;

fn json(text: &str) -> Value {
    serde_json::from_str(text).expect("the program writes JSON")
}

fn numbers(value: &Value) -> Vec<f64> {
    value
        .as_array()
        .expect("a list")
        .iter()
        .map(|number| number.as_f64().expect("a number"))
        .collect()
}

fn close(found: f64, expected: f64, tolerance: f64) {
    assert!(
        (found - expected).abs() <= tolerance,
        "{found} against {expected}"
    );
}

#[test]
fn check_says_what_the_spec_describes() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    assert_eq!(
        folder.succeed(&["check", "cart.robot"]),
        "Cart: 1 joint, 2 base parameters of 11 standard parameters\n   1  rail  prismatic  viscous_friction\n"
    );
}

#[test]
fn every_verb_refuses_a_broken_spec() {
    let folder = Folder::new();
    folder.write("broken.robot", &CART.replace("prismatic", "sliding"));
    folder.write("log.csv", &cart_log(5, 0.0, 0.0));
    folder.write("states.json", r#"{"states":[]}"#);
    for arguments in [
        vec!["check", "broken.robot"],
        vec!["show", "broken.robot"],
        vec!["emit", "broken.robot", "--lang", "rust", "--out", "code"],
        vec!["eval", "broken.robot", "--states", "states.json"],
        vec!["identify", "broken.robot", "log.csv", "--json", "out.json"],
        vec![
            "trace",
            "broken.robot",
            "log.csv",
            "--json",
            "out.json",
            "--amend",
            "out.robot",
        ],
    ] {
        let said = folder.refuse(&arguments);
        assert!(said.contains("broken.robot:4:"), "{arguments:?}: {said}");
        assert!(said.contains("sliding"), "{arguments:?}: {said}");
    }
}

#[test]
fn every_verb_refuses_a_missing_file() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    for arguments in [
        vec!["check", "none.robot"],
        vec!["show", "none.robot"],
        vec!["emit", "none.robot", "--lang", "rust", "--out", "code"],
        vec!["eval", "none.robot", "--states", "states.json"],
        vec!["import", "none.urdf", "-o", "out.robot"],
        vec!["identify", "none.robot", "log.csv"],
        vec!["trace", "none.robot", "log.csv"],
    ] {
        let said = folder.refuse(&arguments);
        assert!(
            said.starts_with("error: cannot read `none."),
            "{arguments:?}: {said}"
        );
        assert_eq!(said.lines().count(), 1, "{said}");
    }
    assert!(
        folder
            .refuse(&["eval", "cart.robot", "--states", "none.json"])
            .contains("cannot read `none.json`")
    );
    for verb in ["identify", "trace"] {
        assert!(
            folder
                .refuse(&[verb, "cart.robot", "none.csv"])
                .contains("cannot open log `none.csv`")
        );
    }
}

#[test]
fn usage_is_code_two() {
    let folder = Folder::new();
    for arguments in [
        vec!["identify"],
        vec!["dance"],
        vec!["emit", "x", "--out", ".", "--lang", "c"],
        vec!["show", "x", "--what", "love"],
    ] {
        assert_eq!(folder.run(&arguments).code, Some(2), "{arguments:?}");
    }
    let predict = folder.run(&["trace", "x", "y", "--predict", "z"]);
    assert_eq!(
        predict.code,
        Some(2),
        "a prediction needs a log: {}",
        predict.stderr
    );
    assert_eq!(folder.run(&["--help"]).code, Some(0));
}

#[test]
fn show_writes_equations() {
    let folder = Folder::new();
    folder.write("pendulum.robot", PENDULUM);
    let shown = folder.succeed(&["show", "pendulum.robot", "--what", "mass-matrix"]);
    assert!(shown.starts_with("M[1,1] = "), "{shown}");
    assert!(
        shown.contains("(= M[2,1])")
            && shown.contains("cos(q2)")
            && shown.contains("M[2,2] = lower.izzr"),
        "{shown}"
    );
    let shown = folder.succeed(&["show", "pendulum.robot", "--what", "base-parameters"]);
    assert!(shown.contains("without influence: "), "{shown}");
    let latex = folder.succeed(&[
        "show",
        "pendulum.robot",
        "--what",
        "coriolis",
        "--as",
        "latex",
    ]);
    assert!(
        latex.starts_with("\\begin{aligned}\nC_{1,1} &= ") && latex.contains("\\dot q_{2}"),
        "{latex}"
    );
    assert!(latex.contains("C_{2,2} &= 0"), "{latex}");
    for what in ["gravity", "inverse-dynamics", "regressor", "base-regressor"] {
        for notation in ["text", "latex"] {
            assert!(
                !folder
                    .succeed(&["show", "pendulum.robot", "--what", what, "--as", notation])
                    .is_empty()
            );
        }
    }
}

#[test]
fn emit_writes_a_file_named_as_the_spec() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    let arguments = ["emit", "cart.robot", "--lang", "rust", "--out", "code/arms"];
    assert_eq!(folder.succeed(&arguments), "code/arms/cart.rs\n");
    let plain = folder.read("code/arms/cart.rs");
    assert!(
        plain.starts_with("// @generated by robot-model ") && plain.contains("pub fn mass_matrix"),
        "{plain}"
    );
    assert!(!plain.contains("BETA:"), "{plain}");

    folder.write(
        "parameters.json",
        r#"{"cart.m": 3, "rail.viscous_friction.fv": 5}"#,
    );
    folder.succeed(&[arguments.as_slice(), &["--parameters", "parameters.json"]].concat());
    let constants = "pub const BETA: [f64; 2] = [\n    3.0, // cart.m\n    5.0, // rail.viscous_friction.fv\n];\n";
    let code = folder.read("code/arms/cart.rs");
    assert!(
        code.starts_with(&plain) && code.ends_with(constants),
        "{code}"
    );
}

#[test]
fn emit_refuses_what_it_cannot_write() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    let emit = ["emit", "cart.robot", "--lang", "rust", "--out"];
    let said = folder.refuse(&[emit.as_slice(), &["cart.robot"]].concat());
    assert!(
        said.starts_with("error: cannot write `cart.robot/cart.rs`: "),
        "{said}"
    );
    folder.write("parameters.json", "{}");
    let said = folder.refuse(
        &[
            emit.as_slice(),
            &["code", "--parameters", "parameters.json"],
        ]
        .concat(),
    );
    assert!(said.contains("no value for `cart.m`"), "{said}");
    folder.write(
        "cart.robot",
        &CART.replace("viscous_friction on rail", "stribeck on rail"),
    );
    folder.write(
        "parameters.json",
        r#"{"cart.m": 3, "rail.stribeck.fs": 5, "rail.stribeck.vs": 0.1}"#,
    );
    let said = folder.refuse(
        &[
            emit.as_slice(),
            &["code", "--parameters", "parameters.json"],
        ]
        .concat(),
    );
    assert!(
        said.contains("write the value of `rail.stribeck.vs` into the spec"),
        "{said}"
    );
}

#[test]
fn import_writes_a_spec_that_passes_the_check() {
    let folder = Folder::new();
    folder.write("arm.urdf", URDF);
    let arguments = [
        "import",
        "arm.urdf",
        "-o",
        "arm.robot",
        "--effects",
        "all:viscous_friction;2:motor_inertia",
    ];
    folder.succeed(
        &[
            arguments.as_slice(),
            &["--gravity", "0,-9.81,0", "--inertials", "fixed"],
        ]
        .concat(),
    );
    assert_eq!(
        folder.succeed(&["check", "arm.robot"]),
        "Arm: 2 joints, 3 base parameters of 23 standard parameters\n   1  lift  prismatic  viscous_friction\n   \
         2  swing revolute   viscous_friction, motor_inertia\n"
            .replace("swing r", "swing  r")
            .replace("lift  p", "lift   p")
    );
    assert!(folder.read("arm.robot").contains("gravity = [0, -9.81, 0]"));
}

#[test]
fn import_refuses_what_it_cannot_use() {
    let folder = Folder::new();
    folder.write("arm.urdf", URDF);
    folder.write("broken.urdf", &URDF.replace("</robot>", ""));
    let said = folder.refuse(&["import", "broken.urdf", "-o", "arm.robot"]);
    assert!(
        said.starts_with("error: broken.urdf: the URDF does not parse: "),
        "{said}"
    );
    let said = folder.refuse(&["import", "arm.urdf", "-o", "arm.robot", "--tip", "hand"]);
    assert!(said.contains("the URDF has no link `hand`"), "{said}");
    let said = folder.refuse(&[
        "import",
        "arm.urdf",
        "-o",
        "arm.robot",
        "--effects",
        "all:magic",
    ]);
    assert!(said.starts_with("error: arm.urdf: --effects: "), "{said}");
    let said = folder.refuse(&["import", "arm.urdf", "-o", "nowhere/arm.robot"]);
    assert!(
        said.starts_with("error: cannot write `nowhere/arm.robot`: "),
        "{said}"
    );
    assert_eq!(
        folder
            .run(&["import", "arm.urdf", "-o", "arm.robot", "--gravity", "0,1"])
            .code,
        Some(2)
    );
}

#[test]
fn eval_gives_the_values_of_a_pendulum() {
    let folder = Folder::new();
    folder.write("pendulum.robot", PENDULUM);
    folder.write("states.json", r#"{"states":[{"q":[0,0],"dq":[0,0],"ddq":[0,0]},{"q":[0.3,-0.8],"dq":[1,2],"ddq":[-1,3]}]}"#);
    let out = json(&folder.succeed(&["eval", "pendulum.robot", "--states", "states.json"]));
    assert_eq!(
        (&out["robot"], &out["dof"]),
        (&Value::from("Pendulum"), &Value::from(2))
    );
    // Stretched out: g (m1 l1/2 + m2 (l1 + l2/2)), and l2/2 m2 g.
    let gravity = numbers(&out["states"][0]["gravity"]);
    close(gravity[0], 9.81 * (2.0 * 0.25 + 0.7), 1e-12);
    close(gravity[1], 9.81 * 0.2, 1e-12);
    let standard = out["standard_parameters"].as_array().expect("names").len();
    assert_eq!(standard, 20);

    // M ddq + C dq + G = tau = Y_b beta, with beta from the combinations.
    let state = &out["states"][1];
    let row = |name: &str, i: usize| numbers(&state[name][i]);
    let dot = |x: &[f64], y: &[f64]| x.iter().zip(y).map(|(x, y)| x * y).sum::<f64>();
    for i in 0..2 {
        let sum = dot(&row("mass_matrix", i), &[-1.0, 3.0])
            + dot(&row("coriolis_matrix", i), &[1.0, 2.0])
            + numbers(&state["gravity"])[i];
        close(sum, numbers(&state["torque"])[i], 1e-12);
        assert_eq!(row("regressor", i).len(), standard);
        assert_eq!(
            row("base_regressor", i).len(),
            out["base_parameters"].as_array().expect("a list").len()
        );
    }
}

#[test]
fn eval_takes_standard_and_base_parameters() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    folder.write(
        "states.json",
        r#"{"states":[{"q":[0.1],"dq":[0.5],"ddq":[2]}]}"#,
    );
    let eval = |text: &str| {
        folder.write("parameters.json", text);
        [
            "eval",
            "cart.robot",
            "--states",
            "states.json",
            "--parameters",
            "parameters.json",
        ]
    };
    let plain = json(&folder.succeed(&eval(r#"{"cart.m": 3, "rail.viscous_friction.fv": 5}"#)));
    close(numbers(&plain["states"][0]["torque"])[0], 8.5, 1e-12);
    let identified = r#"{"method":"wls","parameters":[{"name":"cart.m","value":3,"std":0.1},{"name":"rail.viscous_friction.fv","value":5,"std":1}]}"#;
    let identified = json(&folder.succeed(&eval(identified)));
    assert_eq!(identified, plain);

    assert_eq!(
        folder.refuse(&["eval", "cart.robot", "--states", "states.json"]),
        "error: cart.robot: no value for `cart.m`, `rail.viscous_friction.fv`; give it in a file with `--parameters`\n"
    );
    assert_eq!(
        folder.refuse(&eval(r#"{"cart.m": 3}"#)),
        "error: parameters.json: no value for `rail.viscous_friction.fv`; give it in a file with `--parameters`\n"
    );
    assert_eq!(
        folder.refuse(&eval(
            r#"{"cart.m": 3, "rail.viscous_friction.fv": 5, "cart.mass": 3}"#
        )),
        "error: parameters.json: Cart has no parameter `cart.mass`\n"
    );
    assert!(
        folder
            .refuse(&eval(r#"{"cart.m": 3,}"#))
            .starts_with("error: parameters.json: trailing comma at line 1")
    );
    assert!(
        folder
            .refuse(&eval(r#"{"cart.m": "heavy"}"#))
            .starts_with("error: parameters.json: write `{")
    );
}

#[test]
fn base_parameters_are_accepted_as_a_whole_set() {
    let folder = Folder::new();
    folder.write("pendulum.robot", PENDULUM);
    folder.write(
        "states.json",
        r#"{"states":[{"q":[0.3,-0.8],"dq":[1,2],"ddq":[-1,3]}]}"#,
    );
    let nominal = json(&folder.succeed(&["eval", "pendulum.robot", "--states", "states.json"]));
    // The spec's own values, regrouped as the output says.
    let standard = |name: &str| match name {
        "upper.m" => 2.0,
        "upper.mx" => -0.5,
        "upper.izz" => 0.05 + 2.0 * 0.0625,
        "lower.m" => 1.0,
        "lower.mx" => -0.2,
        "lower.izz" => 0.02 + 0.04,
        _ => 0.0,
    };
    let mut beta = serde_json::Map::new();
    for base in nominal["base_parameters"].as_array().expect("a list") {
        let terms = base["combination"].as_object().expect("terms");
        let value: f64 = terms
            .iter()
            .map(|(name, factor)| factor.as_f64().expect("a number") * standard(name))
            .sum();
        beta.insert(
            base["name"].as_str().expect("a name").to_owned(),
            Value::from(value),
        );
    }
    folder.write("beta.json", &Value::from(beta.clone()).to_string());
    let arguments = [
        "eval",
        "pendulum.robot",
        "--states",
        "states.json",
        "--parameters",
        "beta.json",
    ];
    let regrouped = json(&folder.succeed(&arguments));
    for (found, expected) in numbers(&regrouped["states"][0]["torque"])
        .into_iter()
        .zip(numbers(&nominal["states"][0]["torque"]))
    {
        close(found, expected, 1e-12);
    }
    let gone = beta
        .keys()
        .find(|name| !name.ends_with('r'))
        .expect("a parameter that stands alone")
        .clone();
    beta.remove(&gone);
    folder.write("beta.json", &Value::from(beta).to_string());
    assert!(folder.refuse(&arguments).contains("only as a whole set"));
}

#[test]
fn eval_refuses_states_of_another_arm() {
    let folder = Folder::new();
    folder.write("pendulum.robot", PENDULUM);
    let said = |text: &str| {
        folder.write("states.json", text);
        folder.refuse(&["eval", "pendulum.robot", "--states", "states.json"])
    };
    assert_eq!(
        said(r#"{"states":[{"q":[0,0],"dq":[0],"ddq":[0,0]}]}"#),
        "error: states.json: state 1: `dq` has 1 values, the arm has 2 joints\n"
    );
    assert!(said(r#"{"states":[{"q":[0,0],"dq":[0,0]}]}"#).contains("missing field `ddq`"));
    assert!(
        said(r#"{"states":[{"q":[0,0],"dq":[0,0],"ddq":[0,0],"v":1}]}"#)
            .contains("unknown field `v`")
    );
    assert!(said("{").contains("line 1"));
}

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
        table.contains("cart.m") && table.contains("RMSE"),
        "{table}"
    );
    let out = json(&folder.read("out.json"));
    assert_eq!(out["method"], "wls");
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
        "error: cannot write `nowhere/out.json`: No such file or directory (os error 2)\n"
    );
    folder.write("pendulum.robot", PENDULUM);
    assert!(
        folder
            .refuse(&["identify", "pendulum.robot", "log.csv"])
            .contains("missing columns `q2`, `tau2`")
    );
}

#[test]
fn trace_closes_the_loop() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    folder.write("log.csv", &cart_log(40, 2.0, 0.0));
    folder.write("other.csv", &cart_log(20, 2.0, 0.7));
    let outputs = [
        "--amend",
        "amended.robot",
        "--predict",
        "tau.csv",
        "--json",
        "out.json",
    ];
    let told = folder.succeed(
        &[
            &["trace", "cart.robot", "log.csv", "--validate", "other.csv"],
            outputs.as_slice(),
        ]
        .concat(),
    );
    assert!(
        told.starts_with("explained:\n  coulomb-friction on rail: fc = "),
        "{told}"
    );
    assert!(
        told.contains("+         coulomb_friction on rail;"),
        "{told}"
    );
    let out = json(&folder.read("out.json"));
    assert_eq!(out["outcome"], "explained");
    assert_eq!(
        (&out["effects"][0]["kind"], &out["effects"][0]["joint"]),
        (&Value::from("coulomb-friction"), &Value::from(1))
    );
    close(
        out["effects"][0]["parameters"][0]["value"]
            .as_f64()
            .expect("a number"),
        2.0,
        0.05,
    );
    assert!(numbers(&out["rmse_after"])[0] < 0.3 * numbers(&out["rmse_before"])[0]);

    let amended = folder.read("amended.robot");
    assert!(
        amended.contains("// runs level") && amended.contains("coulomb_friction on rail;"),
        "{amended}"
    );
    folder.succeed(&["check", "amended.robot"]);
    let prediction = folder.read("tau.csv");
    assert!(
        prediction.starts_with("time,tau1\n0.000000000,"),
        "{}",
        &prediction[..40]
    );
    assert_eq!(prediction.lines().count(), 20 * 200 + 1);

    // The amended spec lacks nothing.
    let told = folder.succeed(&["trace", "amended.robot", "log.csv", "--json", "again.json"]);
    assert!(told.starts_with("nothing missing"), "{told}");
    let again = json(&folder.read("again.json"));
    assert_eq!(
        (&again["effects"], &again["rmse_before"]),
        (&json("[]"), &Value::Null)
    );
}

#[test]
fn trace_writes_nothing_where_it_cannot_write_all() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    folder.write("log.csv", &cart_log(5, 0.0, 0.0));
    let said = folder.refuse(&[
        "trace",
        "cart.robot",
        "log.csv",
        "--json",
        "out.json",
        "--amend",
        "nowhere/out.robot",
    ]);
    assert!(said.contains("cannot write `nowhere/out.robot`"), "{said}");
}

#[test]
fn a_reader_that_goes_away_is_no_panic() {
    use std::process::{Command, Stdio};
    let folder = Folder::new();
    folder.write("pendulum.robot", PENDULUM);
    let mut child = Command::new(env!("CARGO_BIN_EXE_robot-model"))
        .args(["show", "pendulum.robot"])
        .current_dir(folder.path(""))
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    drop(child.stdout.take());
    let output = child.wait_with_output().expect("the program ends");
    assert_eq!(String::from_utf8_lossy(&output.stderr), "");
    assert_eq!(output.status.code(), Some(0));
}
