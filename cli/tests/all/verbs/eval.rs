//! `eval`.

use serde_json::Value;

use crate::verbs::common::{Folder, PENDULUM, close, json, numbers};

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
fn eval_refuses_states_of_another_arm() {
    let folder = Folder::new();
    folder.write("pendulum.robot", PENDULUM);
    let said = |text: &str| {
        folder.write("states.json", text);
        folder.refuse(&["eval", "pendulum.robot", "--states", "states.json"])
    };
    assert_eq!(
        said(r#"{"states":[{"q":[0,0],"dq":[0],"ddq":[0,0]}]}"#),
        "error: states.json: state 1: `dq` has 1 value, the arm has 2 joints\n"
    );
    assert!(said(r#"{"states":[{"q":[0,0],"dq":[0,0]}]}"#).contains("missing field `ddq`"));
    assert!(
        said(r#"{"states":[{"q":[0,0],"dq":[0,0],"ddq":[0,0],"v":1}]}"#)
            .contains("unknown field `v`")
    );
    assert!(
        said("{\n")
            .starts_with("error: states.json:1:1: it is not JSON: EOF while parsing an object")
    );
    let typed = said(r#"{"states":[{"q":[0,0],"dq":[0,"x"],"ddq":[0,0]}]}"#);
    assert!(
        typed.starts_with("error: states.json: state 1: dq[1]: invalid type"),
        "{typed}"
    );
    assert!(
        typed.contains("write `{\"states\": [{\"q\": [..]"),
        "{typed}"
    );
}

/// A link that is known, and one that is not.
const HALF_KNOWN: &str = "robot Arm {
    gravity = [0, -9.81, 0];
    convention = standard_dh;
    joint upper: revolute { a = 0.5; alpha = 0; d = 0; }
    joint lower: revolute { a = 0.4; alpha = 0; d = 0; }
    link upper: fixed { mass = 2; com = [-0.25, 0, 0]; inertia = [0, 0, 0, 0.05, 0, 0.05]; }
    link lower: nominal { mass = 1; com = [-0.2, 0, 0]; inertia = [0, 0, 0, 0.02, 0, 0.02]; }
}";

#[test]
fn the_known_torque_completes_that_of_the_base_parameters() {
    let folder = Folder::new();
    folder.write("arm.robot", HALF_KNOWN);
    folder.write(
        "states.json",
        r#"{"states":[{"q":[0.3,-0.8],"dq":[1,2],"ddq":[-1,3]}]}"#,
    );
    let out = json(&folder.succeed(&["eval", "arm.robot", "--states", "states.json"]));
    let standard = |name: &str| match name {
        "lower.m" => 1.0,
        "lower.mx" => -0.2,
        "lower.izz" => 0.02 + 0.04,
        _ => 0.0,
    };
    let state = &out["states"][0];
    let base = out["base_parameters"].as_array().expect("a list");
    for joint in 0..2 {
        let row = numbers(&state["base_regressor"][joint]);
        let known = numbers(&state["known_torque"])[joint];
        let unknown = row.iter().zip(base).map(|(y, parameter)| {
            let combination = parameter["combination"].as_object().expect("an object");
            let beta: f64 = combination
                .iter()
                .map(|(name, c)| c.as_f64().expect("a number") * standard(name))
                .sum();
            y * beta
        });
        close(
            unknown.sum::<f64>() + known,
            numbers(&state["torque"])[joint],
            1e-12,
        );
        assert!(joint == 1 || known.abs() > 1.0, "{known}");
    }
}

#[test]
fn what_is_not_finite_is_refused_with_its_state() {
    let folder = Folder::new();
    folder.write("pendulum.robot", PENDULUM);
    folder.write(
        "states.json",
        r#"{"states":[{"q":[0,0],"dq":[0,0],"ddq":[0,0]},{"q":[0,0],"dq":[1e200,0],"ddq":[0,0]}]}"#,
    );
    let said = folder.refuse(&["eval", "pendulum.robot", "--states", "states.json"]);
    assert!(
        said.starts_with("error: states.json: state 2: `") && said.contains("is not finite there"),
        "{said}"
    );
}

#[test]
fn what_is_no_text_is_refused_with_the_way_out() {
    let folder = Folder::new();
    std::fs::write(folder.path("arm.robot"), b"robot A {\n\xff\xfe").expect("a file in the folder");
    assert_eq!(
        folder.refuse(&["check", "arm.robot"]),
        "error: cannot read `arm.robot`: line 2 is not UTF-8 text; save the file as UTF-8, or name a text file\n"
    );
}

/// A force on the last link turns it by its lever to the tip, and other links by that to the origin of their frames.
#[test]
fn forces_of_the_world_act_on_the_tip() {
    let folder = Folder::new();
    let link = "{ mass = 1; com = [0, 0, 0]; inertia = [0, 0, 0, 0, 0, 1]; }";
    let spec = format!(
        "effect push(j) {{ linear f; force(j) = [0, f, 0]; }}
        robot A {{
            gravity = [0, 0, 0];
            convention = standard_dh;
            tip = [0.1, 0, 0];
            joint up: revolute {{ a = 0.5; alpha = 0; d = 0; }}
            joint lo: revolute {{ a = 0.4; alpha = 0; d = 0; }}
            link up: fixed {link}
            link lo: fixed {link}
            effects {{ push on lo, up; }}
        }}"
    );
    folder.write("arm.robot", &spec);
    let still = r#"{"states":[{"q":[0,0],"dq":[0,0],"ddq":[0,0]}]}"#;
    folder.write("states.json", still);
    // Stretched out along x the motors hold against it: `-J^T F`.
    for (lo, up, wanted) in [(1, 0, [-1.0, -0.5]), (0, 1, [-0.5, 0.0])] {
        let values = format!(r#"{{"lo.push.f": {lo}, "up.push.f": {up}}}"#);
        folder.write("values.json", &values);
        let eval = ["eval", "arm.robot", "--states", "states.json"];
        let given = ["--parameters", "values.json"];
        let out = json(&folder.succeed(&[&eval[..], &given].concat()));
        for (found, wanted) in numbers(&out["states"][0]["torque"]).iter().zip(wanted) {
            close(*found, wanted, 1e-12);
        }
    }
}
