//! Arms that stand otherwise than their spec says.

use std::fmt::Write;

use crate::verbs::common::{Folder, json};
use crate::verbs::readings::{moved, three_joints};

/// A spec says how the arm stands; another way is told, by `identify` and by `trace`.
#[test]
fn gravity_along_another_axis_is_told_by_the_torques() {
    let folder = Folder::new();
    let (header, rows) = moved(&folder);
    folder.write("log.csv", &format!("{header}\n{rows}"));
    let told = "with gravity along [0 m/s^2, 0 m/s^2, -9.81 m/s^2] the residual is";
    for gravity in ["[0, 0, 9.81]", "[9.81, 0, 0]"] {
        let other = three_joints("").replace("[0, 0, -9.81]", gravity);
        folder.write("other.robot", &other);
        for verb in ["identify", "trace"] {
            let said = folder.run(&[verb, "other.robot", "log.csv"]);
            assert_eq!(said.code, Some(0), "{}", said.stderr);
            let both = format!("{}{}", said.stdout, said.stderr);
            assert!(both.contains(told), "{verb} {gravity}: {both}");
        }
    }
    let result = folder.run(&["trace", "other.robot", "log.csv", "--json", "result.json"]);
    assert_eq!(result.code, Some(0), "{}", result.stderr);
    let result = json(&folder.read("result.json"));
    let reading = result["reading"].as_str().expect("a reading");
    assert!(reading.contains(told), "{reading}");
    // How the arm stands comes first: nothing is named.
    assert_eq!(
        (
            &result["outcome"],
            result["effects"].as_array().map(Vec::len)
        ),
        (&"unexplained".into(), Some(0))
    );
    for verb in ["identify", "trace"] {
        let right = folder.run(&[verb, "arm.robot", "log.csv"]);
        let both = format!("{}{}", right.stdout, right.stderr);
        assert!(!both.contains("with gravity along"), "{both}");
    }
}

/// A turntable with a spring: gravity across its axis would explain it with parameters of its own, and is not told.
#[test]
fn a_spring_is_no_gravity() {
    let folder = Folder::new();
    folder.write(
        "arm.robot",
        "robot T {
        gravity = [0, 0, -9.81];
        convention = standard_dh;
        joint turn: revolute { a = 0.3; alpha = 0; d = 0.2; }
        effects { viscous_friction on all; }
    }",
    );
    let mut log = String::from("time,q1,tau1\n");
    for k in 0..5000 {
        let t = f64::from(k) / 200.0;
        let (q, ddq) = (0.4 * (1.7 * t).sin(), -0.4 * 1.7 * 1.7 * (1.7 * t).sin());
        let (more, faster) = (0.2 * (4.1 * t).sin(), -0.2 * 4.1 * 4.1 * (4.1 * t).sin());
        let tau = 0.3 * (ddq + faster) + 6.0 * (q + more - 0.2);
        writeln!(log, "{t},{},{tau}", q + more).expect("a string takes all");
    }
    folder.write("log.csv", &log);
    let said = folder.run(&["identify", "arm.robot", "log.csv", "--json", "fit.json"]);
    let left = json(&folder.read("fit.json"))["relative_percent"][0].as_f64();
    assert!(left.is_some_and(|left| left > 10.0), "{left:?}");
    assert!(
        !said.stderr.contains("with gravity along"),
        "{}",
        said.stderr
    );
}
