//! Logs in bags of ROS 2.

use serde_json::Value;

use crate::verbs::common::{Folder, PENDULUM, json, moved};

const EFFECTS: &str = "\n    effects { viscous_friction on all; }\n";
const VALUES: &str = r#"{"upper.viscous_friction.fv": 0.5, "lower.viscous_friction.fv": 0.2}"#;

fn arm(more: &str) -> String {
    PENDULUM.replace("\n}\n", &format!("{EFFECTS}{more}\n}}\n"))
}

fn wanted(t: f64) -> [f64; 2] {
    [
        0.6 * (1.3 * t).sin() + 0.2 * (2.9 * t).sin(),
        0.5 * (1.9 * t).sin() - 0.3 * (3.3 * t).cos(),
    ]
}

/// An arm's log as CSV and as a bag.
fn folder() -> Folder {
    let folder = Folder::new();
    folder.write("arm.robot", &arm(""));
    moved(&folder, &arm(""), VALUES, wanted);
    let simulate = ["simulate", "true.robot", "--parameters", "true.json"];
    let motion = ["--trajectory", "wanted.csv", "--out", "log.mcap"];
    let noise = ["--torque-noise", "0.02", "--seed", "1"];
    folder.succeed(&[&simulate[..], &motion, &noise].concat());
    folder
}

fn fit(folder: &Folder, spec: &str, log: &str) -> Value {
    folder.succeed(&["identify", spec, log, "--json", "fit.json"]);
    json(&folder.read("fit.json"))
}

#[test]
fn a_bag_has_the_fit_of_the_same_log_as_csv() {
    let folder = folder();
    let [csv, bag] = ["log.csv", "log.mcap"].map(|log| fit(&folder, "arm.robot", log));
    assert_eq!(csv["parameters"], bag["parameters"]);
    assert_eq!(csv["rmse"], bag["rmse"]);
    // Piece by piece, too.
    for log in ["log.csv", "log.mcap"] {
        folder.succeed(&[
            "identify",
            "arm.robot",
            log,
            "--factor",
            &format!("{log}.json"),
        ]);
    }
    assert_eq!(folder.read("log.csv.json"), folder.read("log.mcap.json"));
    let said = folder.refuse(&["merge", "arm.robot", "log.mcap"]);
    assert!(said.contains("it is a log, not a factor"), "{said}");
}

/// Settings of the tables in a folder are none of a bag beside them; those that name its topic are.
#[test]
fn settings_of_tables_are_none_of_bags() {
    let folder = folder();
    let plain = fit(&folder, "arm.robot", "log.mcap");
    let of_tables = "[log]\nq = { columns = [\"axis1\", \"axis2\"], unit = \"deg\" }\ntau = { columns = [\"i1\", \"i2\"], unit = \"A\" }\n";
    folder.write("robot-model.toml", of_tables);
    let run = folder.run(&["identify", "arm.robot", "log.mcap", "--json", "fit.json"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let note = "robot-model.toml names columns of tables and is not used for the bag log.mcap";
    assert!(run.stderr.contains(note), "{}", run.stderr);
    assert_eq!(
        json(&folder.read("fit.json"))["parameters"],
        plain["parameters"]
    );
    folder.write("robot-model.toml", "[log]\ntopic = \"/other\"\n");
    let said = folder.refuse(&["identify", "arm.robot", "log.mcap"]);
    assert!(said.contains("/other"), "{said}");
}

#[test]
fn joints_and_topics_are_named_in_the_spec() {
    let folder = folder();
    let wanted = fit(&folder, "arm.robot", "log.mcap");
    let renamed = arm("")
        .replace("joint upper", "joint first")
        .replace("joint lower", "joint second")
        .replace("link upper", "link first")
        .replace("link lower", "link second");
    folder.write("other.robot", &renamed);
    let said = folder.refuse(&["identify", "other.robot", "log.mcap"]);
    assert!(
        said.contains(
            "error: log.mcap: no message on `/joint_states` has the joints `first`, `second`; joints there are `upper`, `lower`; "
        ),
        "{said}"
    );
    let block = "log { q = \"upper.position\", \"lower.position\"; tau = \"upper.effort\", \"lower.effort\"; topic = \"/joint_states\"; }\n}\n";
    let end = renamed.rfind('}').expect("the end");
    folder.write("other.robot", &format!("{}{block}", &renamed[..end]));
    let found = fit(&folder, "other.robot", "log.mcap");
    let values = |fit: &Value| -> Vec<Value> {
        let list = fit["parameters"].as_array().expect("a list").iter();
        list.map(|entry| entry["value"].clone()).collect()
    };
    assert_eq!(values(&found), values(&wanted));
    folder.write(
        "wrong.robot",
        &arm("    log { topic = \"/left/joint_states\"; }"),
    );
    let said = folder.refuse(&["identify", "wrong.robot", "log.mcap"]);
    assert!(
        said.contains(
            "topic `/left/joint_states` has no joint states; they are on `/joint_states`"
        ),
        "{said}"
    );
    // What is written goes to the topic of the spec.
    let simulate = ["simulate", "wrong.robot", "--parameters", "true.json"];
    let motion = [
        "--trajectory",
        "wanted.csv",
        "--out",
        "left.mcap",
        "--duration",
        "2",
    ];
    folder.succeed(&[&simulate[..], &motion].concat());
    fit(&folder, "wrong.robot", "left.mcap");
}

#[test]
fn bags_that_break_off_are_refused() {
    let folder = folder();
    let bytes = std::fs::read(folder.path("log.mcap")).expect("the bag");
    std::fs::write(folder.path("cut.mcap"), &bytes[..bytes.len() / 2]).expect("a file");
    let said = folder.refuse(&["identify", "arm.robot", "cut.mcap", "--json", "fit.json"]);
    assert!(said.contains("error: cut.mcap:"), "{said}");
    assert!(
        said.contains("the file is truncated") && said.contains("`mcap recover`"),
        "{said}"
    );
}

#[test]
fn channels_of_effects_have_no_place_in_a_bag() {
    let folder = Folder::new();
    folder.write(
        "arm.robot",
        &arm("").replace("viscous_friction on all", "temperature_viscous on upper"),
    );
    folder.write(
        "wanted.csv",
        "time,q1,q2,temperature\n0,0,0,20\n1,1,1,20\n2,0,0,20\n",
    );
    let said = folder.refuse(&[
        "simulate",
        "arm.robot",
        "--trajectory",
        "wanted.csv",
        "--out",
        "log.mcap",
    ]);
    assert!(
        said.contains("error: log.mcap: a declared effect reads `temperature"),
        "{said}"
    );
}
