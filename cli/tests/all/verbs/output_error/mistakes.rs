//! What `--method output-error` refuses, and how.

use std::fmt::Write;

use super::soft;
use crate::verbs::common::{CART, Folder, cart_log};

/// An arm with a log of one joint, and files with mistakes.
fn mistaken() -> Folder {
    let folder = Folder::new();
    folder.write("arm.robot", &soft("(stiffness = 500)"));
    folder.write(
        "start.json",
        r#"{"a.motor_inertia.ia": 0.3, "a.viscous_friction.fv": 0.8}"#,
    );
    let mut log = String::from("time,q1,tau1,ref1\n");
    for k in 0..400 {
        let t = 0.005 * f64::from(k);
        let (q, tau) = (0.3 * (3.0 * t).sin(), 5.0 * (3.0 * t).cos());
        writeln!(log, "{t},{q},{tau},{q}").expect("a string takes all");
    }
    folder.write("log.csv", &log);
    folder.write(
        "two.json",
        r#"{"joints": [{"position": [1]}, {"position": [1]}]}"#,
    );
    folder.write("typo.json", r#"{"joints": [{"positions": [1]}]}"#);
    folder.write("other.json", r#"{"joints": [{"columns": {"qref1": [1]}}]}"#);
    folder.write(
        "limit.json",
        r#"{"joints": [{"position": [-1], "limit": 0}]}"#,
    );
    folder.write("wild.json", r#"{"joints": [{"position": [1e9]}]}"#);
    folder.write("far.json", r#"{"a.viscous_friction.fv": [1, 2]}"#);
    folder.write("name.json", r#"{"a.fv": [1, 2]}"#);
    folder.write("fall.json", r#"{"a.viscous_friction.fv": [2, 1]}"#);
    folder
}

#[test]
fn what_a_simulation_cannot_take_is_told() {
    let folder = mistaken();
    let basics = ["identify", "arm.robot", "log.csv"];
    let simulated = ["--method", "output-error", "--start", "start.json"];
    for (options, word) in [
        (
            &["--start", "start.json"][..],
            "`--start` belongs to `--method output-error`",
        ),
        (
            &["--method", "wls", "--window", "1"],
            "`--window` belongs to `--method output-error`",
        ),
        (
            &["--method", "output-error", "--prior", "0.2"],
            "`--prior` belongs to methods with equations",
        ),
        (
            &["--method", "output-error", "--form", "filtered"],
            "`--form filtered` belongs to methods",
        ),
        (
            &["--method", "output-error"],
            "nor the spec: arm.robot: no value for `a.motor_inertia.ia`, ",
        ),
        (
            &[&simulated[..], &["--window", "0.02"]].concat(),
            "too few samples for a motion",
        ),
        (
            &[&simulated[..], &["--window", "0"]].concat(),
            "`--window` must be positive",
        ),
        (
            &[&simulated[..], &["--within", "-5"]].concat(),
            "`--within` must be a positive number of percent, not -5",
        ),
        (
            &[&simulated[..], &["--controller", "two.json"]].concat(),
            "has 2 laws for an arm with 1 joint",
        ),
        (
            &[&simulated[..], &["--controller", "typo.json"]].concat(),
            "unknown field `positions`",
        ),
        (
            &[&simulated[..], &["--controller", "other.json"]].concat(),
            "no column `qref1`, which the controller reads",
        ),
        (
            &[&simulated[..], &["--controller", "limit.json"]].concat(),
            "joint a: `limit` must be positive",
        ),
        (
            &[&simulated[..], &["--controller", "wild.json"]].concat(),
            "with the start parameters",
        ),
        (
            &[&simulated[..], &["--bounds", "far.json"]].concat(),
            "starts at 0.8, outside of its bounds 1 .. 2",
        ),
        (
            &[
                &simulated[..],
                &["--controller", "limit.json", "--hold", "mean"],
            ]
            .concat(),
            "`--hold` needs an arm driven by the logged torque",
        ),
        (
            &[&simulated[..], &["--bounds", "name.json"]].concat(),
            "no parameter is called `a.fv`",
        ),
        (
            &[&simulated[..], &["--bounds", "fall.json"]].concat(),
            "two ascending numbers",
        ),
    ] {
        let said = folder.refuse(&[&basics[..], options].concat());
        assert!(said.contains(word), "{options:?}: {said}");
    }
}

#[test]
fn a_log_without_a_motion_is_refused_at_once() {
    let folder = mistaken();
    let mut log = String::from("time,q1,tau1\n");
    for k in 0..4000 {
        let t = 0.005 * f64::from(k);
        writeln!(log, "{t},0.3,2").expect("a string takes all");
    }
    folder.write("still.csv", &log);
    let identify = ["identify", "arm.robot", "still.csv", "--method"];
    let run = folder.run(&[&identify[..], &["output-error", "--start", "start.json"]].concat());
    assert_ne!(run.code, Some(0));
    assert!(
        run.stderr.contains("no joint moves in these logs"),
        "{}",
        run.stderr
    );
}

/// Parameters that no arm has, as least squares may give where the data are silent: the simulated arm runs away from what pushes it.
#[test]
fn an_arm_that_cannot_be_is_told_as_why_it_runs_away() {
    let folder = mistaken();
    folder.write(
        "free.robot",
        "robot Free {
            gravity = [0, 0, 0];
            convention = standard_dh;
            joint a: revolute { a = 0.5; alpha = 0; d = 0; }
            effects { viscous_friction on a; }
        }",
    );
    folder.write(
        "impossible.json",
        r#"{"a.izz": -0.01, "a.m": 0, "a.mx": 0, "a.my": 0, "a.viscous_friction.fv": 0.8}"#,
    );
    let identify = ["identify", "free.robot", "log.csv", "--method"];
    let said = folder.refuse(
        &[
            &identify[..],
            &["output-error", "--start", "impossible.json"],
        ]
        .concat(),
    );
    assert!(said.contains("with the start parameters"), "{said}");
    assert!(
        said.contains("the mass matrix is not positive definite: least eigenvalue"),
        "{said}"
    );
    assert!(
        said.contains("`--method physical --json start.json`"),
        "{said}"
    );
}

/// A cart of 3 kg and 5 N s/m, and where to start.
fn cart() -> Folder {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    folder.write("log.csv", &cart_log(2, 0.0, 0.0));
    folder.write(
        "start.json",
        r#"{"cart.m": 2.8, "rail.viscous_friction.fv": 5.2}"#,
    );
    folder
}

const BY_SIMULATION: [&str; 7] = [
    "identify",
    "cart.robot",
    "log.csv",
    "--method",
    "output-error",
    "--start",
    "start.json",
];

/// Ranges of a file beside what is said of all.
#[test]
fn ranges_that_are_not_what_is_said_are_told() {
    let folder = cart();
    for (ranges, said) in [
        (
            r#"{"cart.m": [1.95, 3.7], "rail.viscous_friction.fv": [4, 8]}"#,
            Some(
                "note: bounds.json sets other ranges than 30 %: `rail.viscous_friction.fv` 4 .. 8 and not 3.64 .. 6.76\n",
            ),
        ),
        (
            r#"{"cart.m": [1.95, 3.7], "rail.viscous_friction.fv": [3.6, 6.8]}"#,
            None,
        ),
    ] {
        folder.write("bounds.json", ranges);
        let ranges = ["--within", "30", "--bounds", "bounds.json"];
        let run = folder.run(&[&BY_SIMULATION[..], &ranges].concat());
        assert_eq!(run.code, Some(0), "{}", run.stderr);
        match said {
            Some(said) => assert!(run.stderr.contains(said), "{}", run.stderr),
            None => assert!(!run.stderr.contains("other ranges"), "{}", run.stderr),
        }
    }
}

/// Nobody has written a file: all stay within a share of where the search starts, and what a file has within its own range.
#[test]
fn parameters_stay_within_a_share_of_the_start() {
    let folder = cart();
    folder.write("wide.json", r#"{"cart.m": [1, 9]}"#);
    for (options, mass, held) in [
        (&["--within", "2"][..], 2.856, 1),
        (&["--within", "2", "--bounds", "wide.json"], 3.0, 1),
        (&["--within", "30"], 3.0, 0),
    ] {
        let json = ["--json", "fit.json"];
        folder.succeed(&[&BY_SIMULATION[..], options, &json].concat());
        let report = crate::verbs::common::json(&folder.read("fit.json"));
        assert_eq!(
            report["at_bounds"].as_array().map(Vec::len),
            Some(held),
            "{report}"
        );
        let found = report["parameters"][0]["value"].as_f64().expect("a number");
        assert!((found - mass).abs() < 0.05, "{found} {mass}");
    }
}
