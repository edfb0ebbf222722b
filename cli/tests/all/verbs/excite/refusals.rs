//! What leaves no design.

use super::{ARM, FRICTION, SMALL, arm, folder};
use crate::verbs::common::CART;

#[test]
fn what_leaves_no_design_is_told() {
    let folder = folder();
    let range = "link = cart; position = -1 m .. 1 m;";
    folder.write("cart.robot", &CART.replace("link = cart;", range));
    let refused = |arguments: &[&str]| {
        folder.refuse(&[&ARM[..], &SMALL, &["--out", "out.csv"], arguments].concat())
    };
    for (arguments, word) in [
        (["--noise", "1,2,3"], "3 numbers, the arm 2 joints"),
        (["--noise", "0"], "a positive standard deviation"),
        (["--budget", "0"], "a positive number of seconds"),
        (["--rate", "0"], "a rate in Hz"),
        (["--rate", "NaN"], "a rate in Hz"),
        (["--pose", "0.1"], "1 positions, the arm 2 joints"),
        (["--pose", "0,9"], "joint `lower` at 9, which is not within"),
        (["--pose", "nan,0"], "joint `upper` at NaN"),
        (["--columns", "upper.m"], "names 1 parameter"),
        (
            ["--unit-columns", "--seed=1"],
            "add `--criterion condition`",
        ),
        (["--json", "arm.robot"], "same file as the input"),
        (["--acceleration", "5"], "has one for each"),
        (
            ["--acceleration", "0"],
            "0 is no limit; write a positive number",
        ),
    ] {
        let said = refused(&arguments);
        assert!(said.contains(word), "{arguments:?}: {said}");
    }
    let unit = ["--criterion", "hadamard", "--unit-columns"];
    assert!(refused(&unit).contains("the same for every motion"));
    let said = folder.refuse(&["excite", "cart.robot", "--out", "out.csv"]);
    assert!(said.contains("`rail` has no velocity limit"), "{said}");
    for period in ["0", "inf", "NaN"] {
        let said = folder.refuse(&["excite", "arm.robot", "--out", "o.csv", "--period", period]);
        assert!(said.contains("period"), "{period}: {said}");
    }
    let said = folder.refuse(&["excite", "arm.robot", "--out", "o.csv", "--harmonics", "1"]);
    assert!(said.contains("at least two"), "{said}");
    let said = folder.refuse(&[
        "excite",
        "arm.robot",
        "--out",
        "o.csv",
        "--harmonics",
        "1000000",
    ]);
    assert!(said.contains("from 2 to 100"), "{said}");
    folder.write(
        "slide.robot",
        &CART.replace("link = cart;", "link = cart; velocity = 1;"),
    );
    let said = folder.refuse(&["excite", "slide.robot", "--out", "o.csv"]);
    assert!(said.contains("has no position limits"), "{said}");
    let still = ["--period", "0.001", "--starts", "1", "--budget", "1"];
    let said = folder.refuse(&[&["excite", "arm.robot", "--out", "o.csv"], &still[..]].concat());
    assert!(said.contains("the parameters from each other"), "{said}");
    // Dry friction alone is more than the motor has, wherever the arm is.
    let upper = arm().replacen("torque = 25", "torque = 30", 1);
    folder.write("rusty.robot", &upper.replace("torque = 25", "torque = 5"));
    folder.write(
        "rusty.json",
        &FRICTION.replace(
            r#""lower.coulomb_friction.fc": 0.4"#,
            r#""lower.coulomb_friction.fc": 6"#,
        ),
    );
    let rusty = [
        "excite",
        "rusty.robot",
        "--parameters",
        "rusty.json",
        "--out",
        "o.csv",
    ];
    let said = folder.refuse(&rusty);
    assert!(said.contains("torque of `lower`"), "{said}");
}
