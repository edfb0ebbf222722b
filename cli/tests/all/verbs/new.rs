//! Specs to start from.

use std::fmt::Write;

use crate::verbs::common::Folder;

const VARIANTS: [(&str, &[&str]); 8] = [
    ("one joint", &["--joints", "1"]),
    ("standard_dh", &[]),
    (
        "standard_dh of 4",
        &["--joints", "4", "--convention", "standard_dh"],
    ),
    (
        "modified_dh",
        &["--joints", "3", "--convention", "modified_dh"],
    ),
    ("origin", &["--joints", "3", "--convention", "origin"]),
    ("energies", &["--energies"]),
    ("energies of 1", &["--energies", "--joints", "1"]),
    ("energies of 3", &["--energies", "--joints", "3"]),
];

/// Of a chain, of links with names and inertials; of all, columns of logs.
fn with_examples_of_comments(spec: &str) -> String {
    let mut text = String::new();
    let mut is_log = false;
    let mut used = 0;
    for line in spec.lines() {
        let code = line.trim_start().strip_prefix("// ");
        is_log |= code.is_some_and(|code| code.starts_with("log {"));
        let is_link = code.is_some_and(|code| code.starts_with("link "));
        match code {
            Some(code) if is_log || is_link => {
                used += 1;
                is_log &= code.trim() != "}";
                writeln!(text, "{code}").expect("a string takes all");
            }
            _ => writeln!(text, "{line}").expect("a string takes all"),
        }
    }
    assert!(used >= 6, "{used} lines of examples: {spec}");
    text
}

#[test]
fn another_name_than_the_one_that_was_asked_for_is_told() {
    let folder = Folder::new();
    let run = folder.run(&["new", "2Link", "-o", "arm.robot"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert!(
        run.stderr
            .starts_with("note: the robot is called `Robot2Link` instead of `2Link`: "),
        "{}",
        run.stderr
    );
    assert!(folder.read("arm.robot").contains("robot Robot2Link {"));
    for plain in ["Picker", "picker"] {
        let run = folder.run(&["new", plain, "-o", "arm.robot", "--force"]);
        assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""), "{plain}");
    }
}

#[test]
fn every_starter_is_sound_as_it_is_and_with_what_its_comments_say() {
    for (variant, options) in VARIANTS {
        let folder = Folder::new();
        let said = folder.succeed(&[&["new", "TwoLink"], options].concat());
        assert!(
            said.starts_with("wrote two_link.robot: "),
            "{variant}: {said}"
        );
        assert_eq!(folder.files(), ["two_link.robot"], "{variant}");
        let run = folder.run(&["check", "two_link.robot"]);
        assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""), "{variant}");
        let shown = folder.succeed(&["show", "two_link.robot", "--what", "mass-matrix"]);
        assert!(shown.contains("M[1,1]"), "{variant}: {shown}");
        let spec = folder.read("two_link.robot");
        let longest = spec.lines().map(|line| line.chars().count()).max();
        assert!(longest <= Some(260), "{variant}: {longest:?}");
        // The vocabulary is that of the library, word for word.
        for effect in robot_model_spec::standard_effects() {
            let told = |line: &str| line.trim().starts_with(&format!("//   {} ", effect.name));
            assert_eq!(
                spec.lines().filter(|line| told(line)).count(),
                1,
                "{}",
                effect.name
            );
        }
        let (words, _) = spec.split_once("// There are:").expect("the vocabulary");
        let with_examples = format!("{}// There are:\n}}}}", with_examples_of_comments(words));
        folder.write("two_link.robot", &with_examples);
        let run = folder.run(&["check", "two_link.robot"]);
        assert_eq!(run.code, Some(0), "{variant}: {}", run.stderr);
    }
}

#[test]
fn a_starter_is_designed_for_simulated_and_identified() {
    let all = [(&["--joints", "2"][..], "joint1"), (&["--energies"], "q1")];
    for (options, first) in all {
        let folder = Folder::new();
        folder.succeed(&[&["new", "Arm", "-o", "arm.robot"], options].concat());
        let excite = [
            "excite",
            "arm.robot",
            "--starts",
            "1",
            "--out",
            "motion.csv",
        ];
        folder.succeed(&excite);
        // Of an arm of that kind: values by the names that `identify` gives.
        let energies = r#"{"m1": 2, "I1": 0.02, "c1": 0.1, "m2": 1, "I2": 0.01, "c2": 0.1"#;
        let chain = r#"{"joint1.m": 2, "joint1.izz": 0.05, "joint1.iyy": 0.05, "joint2.m": 1, "joint2.mx": -0.2, "joint2.my": 0.01, "joint2.ixx": 0.01, "joint2.iyy": 0.05, "joint2.izz": 0.06, "joint2.mz": 0, "joint2.ixy": 0, "joint2.ixz": 0, "joint2.iyz": 0"#;
        let second = if first == "q1" { "q2" } else { "joint2" };
        let own = if first == "q1" { energies } else { chain };
        let friction: String = [first, second]
            .map(|joint| {
                format!(r#", "{joint}.viscous_friction.fv": 2, "{joint}.coulomb_friction.fc": 1"#)
            })
            .concat();
        folder.write("values.json", &format!("{own}{friction}}}"));
        let simulate = ["simulate", "arm.robot", "--trajectory", "motion.csv"];
        let values = ["--parameters", "values.json", "--out", "log.csv"];
        let rate = ["--torque-noise", "0.01", "--log-rate", "250"];
        folder.succeed(&[&simulate[..], &values, &rate].concat());
        let fit = folder.succeed(&["identify", "arm.robot", "log.csv"]);
        assert!(
            fit.contains(&format!("{first}.viscous_friction.fv")),
            "{fit}"
        );
    }
}

#[test]
fn what_is_there_stays() {
    let folder = Folder::new();
    folder.write("arm.robot", "mine");
    for options in [&["-o", "arm.robot"][..], &[]] {
        let said = folder.refuse(&[&["new", "Arm"], options].concat());
        assert!(
            said.contains("cannot write `arm.robot`: this file exists"),
            "{said}"
        );
        assert!(said.contains("`--force`"), "{said}");
        assert_eq!(folder.read("arm.robot"), "mine");
    }
    folder.succeed(&["new", "Arm", "--force"]);
    assert!(folder.read("arm.robot").contains("robot Arm {"));
}

#[test]
fn names_and_numbers_that_are_none_are_refused() {
    let folder = Folder::new();
    for (arguments, wanted) in [
        (vec!["new", "arm.robot"], "its file after `-o`"),
        (vec!["new", "7"], "write the robot's name"),
        (vec!["new", "Arm", "--joints", "0"], "0 is not in 1..=40"),
        (vec!["new", "Arm", "--convention", "dh"], "standard_dh"),
        (
            vec!["new", "Arm", "--energies", "--convention", "origin"],
            "cannot be used with",
        ),
    ] {
        let run = folder.run(&arguments);
        assert_eq!(run.code, Some(2), "{arguments:?}: {}", run.stderr);
        assert!(run.stderr.contains(wanted), "{arguments:?}: {}", run.stderr);
    }
    let many = folder.refuse(&["new", "Arm", "--energies", "--joints", "7"]);
    assert!(many.contains("at most 6 coordinates"), "{many}");
    let nowhere = folder.refuse(&["new", "Arm", "-o", "none/arm.robot"]);
    assert!(nowhere.contains("there is no folder `none`"), "{nowhere}");
    folder.succeed(&["new", "my arm 2"]);
    assert!(folder.read("my_arm2.robot").contains("robot MyArm2 {"));
}
