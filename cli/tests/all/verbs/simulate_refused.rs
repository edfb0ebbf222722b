//! What `simulate` refuses, with no log left behind.

use crate::verbs::common::CART;
use crate::verbs::simulate::{BASICS, folder};

#[test]
fn a_motion_that_blows_up_leaves_no_log() {
    let folder = folder();
    // So few samples and so many before the torque acts push the wrong way.
    let more = ["--rate", "20", "--delay", "4", "--frequency", "30"];
    let files = ["--trajectory", "wanted.csv", "--out", "log.csv"];
    let said = folder.refuse(&[&BASICS[..4], &more, &files].concat());
    assert!(said.contains("diverges"), "{said}");
    assert!(!folder.files().contains(&"log.csv".to_owned()));
}

#[test]
fn a_table_that_is_not_written_is_refused() {
    let folder = folder();
    let files = ["--trajectory", "wanted.csv", "--out", "log.parquet"];
    let said = folder.refuse(&[&BASICS[..4], &files].concat());
    assert!(said.contains("is written as CSV"), "{said}");
    assert!(!folder.files().contains(&"log.parquet".to_owned()));
}

#[test]
fn what_cannot_be_simulated_is_told() {
    let folder = folder();
    let refuse = |spec: &str, more: &[&str]| {
        let files = ["--out", "log.csv"];
        let wanted: &[&str] = if more.contains(&"--trajectory") {
            &[]
        } else {
            &["--trajectory", "wanted.csv"]
        };
        let values = if spec == "soft.robot" {
            "bare.json"
        } else {
            "values.json"
        };
        let arguments = ["simulate", spec, "--parameters", values];
        folder.refuse(&[&arguments[..], &files, wanted, more].concat())
    };
    folder.write(
        "soft.robot",
        &CART.replace("viscous_friction", "joint_elasticity(stiffness = 1000)"),
    );
    folder.write("bare.json", r#"{"cart.m": 3}"#);
    let said = refuse("soft.robot", &[]);
    assert!(
        said.contains("a spring separates the motor of joint rail from its link"),
        "{said}"
    );
    folder.write("semicolons.csv", "time;q1\n0;0\n1;0\n");
    let said = refuse("dry.robot", &["--trajectory", "semicolons.csv"]);
    assert!(
        said.contains("semicolons.csv:1: its columns are not separated by commas"),
        "{said}"
    );
    folder.write(
        "warm.robot",
        &CART.replace("viscous_friction", "temperature_viscous(beta = 0.1)"),
    );
    let said = refuse("warm.robot", &[]);
    assert!(
        said.contains("no column `temperature`, which a declared effect reads"),
        "{said}"
    );
    let said = refuse("dry.robot", &["--rate", "0"]);
    assert!(
        said.contains("the rate of the controller must be positive"),
        "{said}"
    );
    let said = refuse("dry.robot", &["--frequency", "nan"]);
    assert!(
        said.contains("the natural frequency must be positive"),
        "{said}"
    );
    let said = refuse("dry.robot", &["--control-parameters", "values.json"]);
    assert!(said.contains("`--controller computed-torque`"), "{said}");
    folder.write("wanted.csv", "time,q1\n0,1\n1,x\n");
    let said = refuse("dry.robot", &[]);
    assert!(
        said.contains("wanted.csv:3: `x` in column `q1` is no finite number"),
        "{said}"
    );
    folder.write("wanted.csv", "time,q1\n0,1\n1,2\n1,3\n2,4\n");
    let said = refuse("dry.robot", &[]);
    let told = "wanted.csv:4: the row has time 1 s, the one before it 1 s; sort the rows";
    assert!(said.contains(told), "{said}");
    folder.write("wanted.csv", "time,q1,q2\n0,1,1\n1,2,2\n2,3,3\n3,4,4\n");
    let said = refuse("dry.robot", &[]);
    assert!(
        said.contains("column `q2` belongs to no joint: the arm has 1 joint"),
        "{said}"
    );
    folder.write("wanted.csv", "time,q2\n0,1\n");
    assert!(refuse("dry.robot", &[]).contains("it has no column `q1`"));
}
