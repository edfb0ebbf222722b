//! Parameters as `eval` and `emit` take them: from a file, and from the spec.

use serde_json::Value;

use crate::verbs::common::{CART, Folder, PENDULUM, close, json, numbers};

const CART_WITH_PARAMETERS: [&str; 6] = [
    "eval",
    "cart.robot",
    "--states",
    "states.json",
    "--parameters",
    "parameters.json",
];

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
        CART_WITH_PARAMETERS
    };
    let plain = json(&folder.succeed(&eval(r#"{"cart.m": 3, "rail.viscous_friction.fv": 5}"#)));
    close(numbers(&plain["states"][0]["torque"])[0], 8.5, 1e-12);
    let identified = r#"{"method":"wls","parameters":[{"name":"cart.m","value":3,"std":0.1},{"name":"rail.viscous_friction.fv","value":5,"std":1}]}"#;
    let identified = json(&folder.succeed(&eval(identified)));
    assert_eq!(identified, plain);

    assert_eq!(
        folder.refuse(&["eval", "cart.robot", "--states", "states.json"]),
        "error: cart.robot: no value for `cart.m`, `rail.viscous_friction.fv`; give it in a file of parameters (`--parameters`; of `identify` it is `--start`): {\"cart.m\": .., \"rail.viscous_friction.fv\": ..}\n"
    );
    assert_eq!(
        folder.refuse(&eval(r#"{"cart.m": 3}"#)),
        "error: parameters.json: no value for `rail.viscous_friction.fv`; give it in a file of parameters (`--parameters`; of `identify` it is `--start`): {\"rail.viscous_friction.fv\": ..}\n"
    );
    assert_eq!(
        folder.refuse(&eval(
            r#"{"cart.m": 3, "rail.viscous_friction.fv": 5, "cart.mass": 3}"#
        )),
        "error: parameters.json:1:46: Cart has no parameter `cart.mass`; is `cart.m` meant?\n  |\n1 | {\"cart.m\": 3, \
         \"rail.viscous_friction.fv\": 5, \"cart.mass\": 3}\n  |                                              ^\n"
    );
    assert!(folder.refuse(&eval(r#"{"cart.m": 3,}"#)).starts_with(
        "error: parameters.json:1:14: it is not JSON: trailing comma; repair it here"
    ));
}

/// What stands where JSON should is told for what it is, and a name that is near no other with those that there are.
#[test]
fn tables_and_names_of_nothing_are_told() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    folder.write(
        "states.json",
        r#"{"states":[{"q":[0],"dq":[1],"ddq":[0.5]}]}"#,
    );
    folder.write("fit.csv", "name,value\ncart.m,3\n");
    folder.write("arm.urdf", "<robot name=\"a\"/>");
    folder.write(
        "fit.json",
        "{\n  \"cart.m\": 3,\n  \"rail.viscous_friction.fv\": 5,\n    \"zzz\": 1\n}\n",
    );
    let refuse = |file: &str| {
        folder.refuse(&[
            "eval",
            "cart.robot",
            "--states",
            "states.json",
            "--parameters",
            file,
        ])
    };
    for (file, what) in [
        ("fit.csv", "a table (CSV)"),
        ("arm.urdf", "XML, as URDFs are"),
        ("cart.robot", "a spec"),
    ] {
        let said = refuse(file);
        let wanted = format!(
            "error: {file}: it looks like {what}, but JSON is expected here; parameters are written "
        );
        assert!(said.starts_with(&wanted), "{said}");
    }
    let said = refuse("fit.json");
    let wanted = "error: fit.json:4:5: Cart has no parameter `zzz`; it has `cart.ixx`, ";
    assert!(said.starts_with(wanted), "{said}");
}

/// What a file of one's own may have wrong, with its place and the way out.
#[test]
fn slips_in_a_parameter_file_are_told() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    folder.write(
        "states.json",
        r#"{"states":[{"q":[0],"dq":[1],"ddq":[0]}]}"#,
    );
    let forms =
        "write `{\"NAME\": VALUE, ..}` or `{\"parameters\": [{\"name\": .., \"value\": ..}, ..]}`";
    for (text, said) in [
        ("[3, 5]", format!("it is a list: {forms}")),
        (
            r#"{"parameters": [{"name": "cart.m", "value": 3}, {"value": 5}]}"#,
            format!("entry 2 of `parameters` has no text `name`: {forms}"),
        ),
    ] {
        folder.write("parameters.json", text);
        assert_eq!(
            folder.refuse(&CART_WITH_PARAMETERS),
            format!("error: parameters.json: {said}\n"),
            "{text}"
        );
    }
    folder.write("parameters.json", "{\"cart.m\": 3, \"cart.m\": 4}\n");
    assert_eq!(
        folder.refuse(&CART_WITH_PARAMETERS),
        "error: parameters.json:1:15: `cart.m` appears more than once; keep the right value\n  |\n1 | {\"cart.m\": 3, \"cart.m\": 4}\n  | \
         \u{20}             ^\n"
    );
    // What is no number is shown where its name stands.
    for (text, said) in [
        (
            "{\"rail.viscous_friction.fv\": 5,\n \"cart.m\": \"heavy\"}",
            format!("2:2: `cart.m` is text, but must be a number: {forms}\n"),
        ),
        (
            r#"{"cart.m": null, "rail.viscous_friction.fv": 5}"#,
            "1:2: `cart.m` is null; write its value, or remove it if the spec has one\n".to_owned(),
        ),
        (
            "{\"parameters\": [\n{\"name\": \"cart.m\", \"value\": \"3\"}]}",
            "2:10: the `value` of `cart.m` is text, but must be a number\n".to_owned(),
        ),
        (
            r#"{"parameters": [{"name": "cart.m"}]}"#,
            format!("1:26: `cart.m` has no `value`: {forms}\n"),
        ),
        (
            r#"{"parameters": [{"name": "cart.m", "value": 3}, {"name": "cart.m", "value": 3}]}"#,
            "1:26: parameter `cart.m` appears more than once; keep the right value\n".to_owned(),
        ),
    ] {
        folder.write("parameters.json", text);
        let refusal = folder.refuse(&CART_WITH_PARAMETERS);
        assert!(
            refusal.starts_with(&format!("error: parameters.json:{said}")),
            "{refusal}"
        );
    }
    let large = r#"{"cart.m": 1e999, "rail.viscous_friction.fv": 5}"#;
    folder.write("parameters.json", large);
    assert_eq!(
        folder.refuse(&CART_WITH_PARAMETERS),
        "error: parameters.json:1:16: it is not JSON: number out of range; repair it here\n  \
           |\n1 | {\"cart.m\": 1e999, \"rail.viscous_friction.fv\": 5}\n  |                ^\n"
    );
}

/// What no arm has is computed with all the same: an identification may miss zero by its error.
#[test]
fn values_that_no_arm_has_are_told() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    folder.write(
        "states.json",
        r#"{"states":[{"q":[0],"dq":[1],"ddq":[1]}]}"#,
    );
    let warned = |text: &str| {
        folder.write("parameters.json", text);
        let run = folder.run(&CART_WITH_PARAMETERS);
        assert_eq!(run.code, Some(0), "{}", run.stderr);
        (
            json(&run.stdout)["states"][0]["torque"][0].clone(),
            run.stderr,
        )
    };
    let (torque, said) = warned(r#"{"cart.m": 3, "rail.viscous_friction.fv": 5}"#);
    assert_eq!((torque, said), (Value::from(8.0), String::new()));
    let (torque, said) = warned(r#"{"cart.m": -3, "rail.viscous_friction.fv": -0.5}"#);
    let wanted = "warning: parameters.json: `cart.m` is -3, but cannot be negative\nwarning: parameters.json: `rail.viscous_friction.fv` \
                  is -0.5, but cannot be negative\n";
    assert_eq!((torque, said.as_str()), (Value::from(-3.5), wanted));

    // Slender rods whose mass is farther from the joint than their moment of inertia says, and sums of what is not negative.
    folder.write("pendulum.robot", PENDULUM);
    folder.write(
        "states.json",
        r#"{"states":[{"q":[0,0],"dq":[0,0],"ddq":[0,0]}]}"#,
    );
    let eval = [&["eval", "pendulum.robot"], &CART_WITH_PARAMETERS[2..]].concat();
    folder.write("parameters.json", r#"{"lower.izz": 0.03}"#);
    let run = folder.run(&eval);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let wanted = "warning: parameters.json: link `lower` has a physically impossible inertia: ";
    assert!(run.stderr.starts_with(wanted), "{}", run.stderr);
}

/// A base parameter or two are no set of them.
#[test]
fn parts_of_a_set_of_base_parameters_are_told() {
    let folder = Folder::new();
    folder.write("pendulum.robot", PENDULUM);
    folder.write(
        "states.json",
        r#"{"states":[{"q":[0,0],"dq":[0,0],"ddq":[0,0]}]}"#,
    );
    let eval = [&["eval", "pendulum.robot"], &CART_WITH_PARAMETERS[2..]].concat();
    for (text, said) in [
        (
            r#"{"upper.mxr": 1, "upper.my": 0, "upper.izzr": 1, "lower.mxr": 1, "lower.izzr": 1}"#,
            ": `lower.izzr`, `lower.mxr`, `upper.izzr`, `upper.mxr` are base parameters, and these are accepted only as a whole set, \
             with no others: Pendulum has 6 base parameters, the file lacks `lower.my`; give standard parameters by name, or a \
             result of `identify` for this spec",
        ),
        (
            r#"{"upper.mxr": 1, "upper.my": 0, "upper.izzr": 1, "lower.mxr": 1, "lower.my": 0, "lower.izz": 1}"#,
            ": `lower.mxr`, `upper.izzr`, `upper.mxr` are base parameters, and these are accepted only as a whole set, with no others: \
             Pendulum has 6 base parameters, the file lacks `lower.izzr`, and also has `lower.izz`; give standard \
             parameters by name, or a result of `identify` for this spec",
        ),
        (
            r#"{"upper.mxr": 1, "upper.my": 0, "upper.izzr": 1, "lower.mxr": 1, "lower.my": 0, "lower.izrr": 1}"#,
            ":1:81: Pendulum has no parameter `lower.izrr`; is `lower.izzr` meant?",
        ),
    ] {
        folder.write("parameters.json", text);
        let refused = folder.refuse(&eval);
        let first = refused.lines().next();
        assert_eq!(
            first,
            Some(format!("error: parameters.json{said}").as_str())
        );
    }
}

/// A file that leaves out what the spec has gets the spec's values, and is told so.
#[test]
fn values_from_the_spec_are_told() {
    let folder = Folder::new();
    folder.write("pendulum.robot", PENDULUM);
    folder.write(
        "states.json",
        r#"{"states":[{"q":[0,0],"dq":[0,0],"ddq":[0,0]}]}"#,
    );
    folder.write(
        "parameters.json",
        r#"{"lower.m": 1, "lower.mx": 0.2, "lower.my": 0, "lower.izz": 0.06}"#,
    );
    let eval = [&["eval", "pendulum.robot"], &CART_WITH_PARAMETERS[2..]].concat();
    let run = folder.run(&eval);
    let wanted = "note: parameters.json: no value for 4 parameters: the spec's value is used for `upper.m`, `upper.mx`, `upper.my`, \
                  `upper.izz`\n";
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), wanted));
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
fn a_shape_is_what_the_law_allows() {
    let folder = Folder::new();
    let spec = CART.replace("effects {", "effects { stribeck() on rail;");
    assert_ne!(spec, CART);
    folder.write("cart.robot", &spec);
    folder.write(
        "parameters.json",
        r#"{"cart.m": 3, "rail.viscous_friction.fv": 5, "rail.stribeck.fs": 1, "rail.stribeck.vs": -0.01}"#,
    );
    folder.write(
        "states.json",
        r#"{"states":[{"q":[0],"dq":[1],"ddq":[0]}]}"#,
    );
    let said = folder.refuse(&CART_WITH_PARAMETERS);
    assert_eq!(
        said,
        "error: parameters.json: `rail.stribeck.vs` is -0.01; it must be a positive number\n"
    );
}
