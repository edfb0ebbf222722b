//! What all verbs share.

use crate::verbs::common::{CART, Folder, cart_log};

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
        vec!["merge", "broken.robot", "log.csv", "--json", "out.json"],
        vec![
            "friction",
            "broken.robot",
            "log.csv",
            "--joint",
            "rail",
            "--json",
            "out.json",
        ],
        vec!["audit", "broken.robot", "--parameters", "log.csv"],
        vec!["export", "broken.robot", "--as", "urdf", "-o", "out.urdf"],
        vec!["dissect", "broken.robot", "log.csv", "--json", "out.json"],
        vec![
            "simulate",
            "broken.robot",
            "--trajectory",
            "log.csv",
            "--out",
            "out.csv",
        ],
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
        vec!["merge", "none.robot", "factor.json"],
        vec!["friction", "none.robot", "log.csv", "--joint", "rail"],
        vec!["audit", "none.robot", "--parameters", "p.json"],
        vec!["trace", "none.robot", "log.csv"],
        vec!["dissect", "none.robot", "log.csv"],
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
        vec!["emit", "x", "--out", ".", "--lang", "fortran"],
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
