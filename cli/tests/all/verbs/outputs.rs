//! Where results may go, and readers that are gone.

use std::fmt::Write;

use crate::verbs::common::{CART, Folder, PENDULUM, URDF, cart_log, json};

#[test]
fn no_output_takes_the_place_of_an_input() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    folder.write("log.csv", &cart_log(5, 0.0, 0.0));
    folder.write("other.csv", &cart_log(5, 0.0, 0.7));
    folder.write("arm.urdf", URDF);
    folder.write("cart.rs", CART);
    let trace = ["trace", "cart.robot", "log.csv", "--validate", "other.csv"];
    let with = |outputs: &[&'static str]| [trace.as_slice(), outputs].concat();
    for (arguments, input) in [
        (
            vec!["identify", "cart.robot", "log.csv", "--json", "cart.robot"],
            "cart.robot",
        ),
        (
            vec!["identify", "cart.robot", "log.csv", "--json", "./log.csv"],
            "log.csv",
        ),
        (vec!["import", "arm.urdf", "-o", "arm.urdf"], "arm.urdf"),
        (
            vec!["emit", "cart.rs", "--lang", "rust", "--out", "."],
            "cart.rs",
        ),
        (with(&["--amend", "cart.robot"]), "cart.robot"),
        (with(&["--predict", "other.csv"]), "other.csv"),
        (with(&["--json", "./../no-such-folder/../log.csv"]), ""),
        (with(&["--json", "log.csv"]), "log.csv"),
    ] {
        let before = (
            folder.read("cart.robot"),
            folder.read("log.csv"),
            folder.read("other.csv"),
        );
        let said = folder.refuse(&arguments);
        assert!(said.starts_with("error: cannot write `"), "{said}");
        if !input.is_empty() {
            let wanted = format!("it is the same file as the input `{input}`; give another name");
            assert!(said.contains(&wanted), "{arguments:?}: {said}");
        }
        let after = (
            folder.read("cart.robot"),
            folder.read("log.csv"),
            folder.read("other.csv"),
        );
        assert_eq!(before, after);
    }
}

#[test]
fn no_output_takes_the_place_of_another() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    folder.write("log.csv", &cart_log(5, 0.0, 0.0));
    let trace = ["trace", "cart.robot", "log.csv", "--validate", "log.csv"];
    for outputs in [
        ["--amend", "out", "--predict", "out"],
        ["--amend", "out", "--json", "./out"],
        ["--predict", "out", "--json", "../out"],
    ] {
        let other = folder
            .path("")
            .file_name()
            .map(|name| name.to_string_lossy().into_owned());
        let detour = format!("../{}/out", other.expect("a name"));
        let outputs = outputs.map(|output| {
            if output == "../out" {
                detour.as_str()
            } else {
                output
            }
        });
        let said = folder.refuse(&[trace.as_slice(), &outputs].concat());
        assert!(
            said.contains("it is the same file as the output `out`"),
            "{said}"
        );
    }
}

#[test]
fn only_regular_files_are_replaced() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    folder.write("log.csv", &cart_log(5, 0.0, 0.0));
    std::fs::create_dir(folder.path("results")).expect("a folder");
    let identify =
        |json: &str| folder.refuse(&["identify", "cart.robot", "log.csv", "--json", json]);
    assert_eq!(
        identify("results"),
        "error: cannot write `results`: it is a folder; name a file in it\n"
    );
    assert_eq!(
        identify("log.csv/out.json"),
        "error: cannot write `log.csv/out.json`: `log.csv` is not a folder\n"
    );
    assert!(identify("..").contains("it does not name a file"));

    folder.write("kept.json", "old");
    let kept = folder.path("kept.json");
    let mut permissions = std::fs::metadata(&kept).expect("a file").permissions();
    permissions.set_readonly(true);
    std::fs::set_permissions(&kept, permissions).expect("its owner may");
    assert_eq!(
        identify("kept.json"),
        "error: cannot write `kept.json`: it is read-only; give another name, or make it writable\n"
    );
    assert_eq!(folder.read("kept.json"), "old");
}

#[cfg(unix)]
#[test]
fn devices_are_not_replaced_and_links_are_followed() {
    use std::os::unix::fs::symlink;
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    folder.write("log.csv", &cart_log(5, 0.0, 0.0));
    symlink("/dev/null", folder.path("null")).expect("a link");
    symlink("nothing", folder.path("dangling")).expect("a link");
    symlink("log.csv", folder.path("link.csv")).expect("a link");
    folder.write("old.json", "{}");
    symlink("old.json", folder.path("link.json")).expect("a link");
    let identify = ["identify", "cart.robot", "log.csv", "--json"];
    for (output, why) in [
        ("/dev/stdout", "it is not a regular file"),
        ("null", "it is not a regular file"),
        ("dangling", "it is a broken link"),
        ("link.csv", "it is the same file as the input `log.csv`"),
    ] {
        let said = folder.refuse(&[identify.as_slice(), &[output]].concat());
        assert!(said.contains(why), "{output}: {said}");
    }
    folder.succeed(&[identify.as_slice(), &["link.json"]].concat());
    assert_eq!(json(&folder.read("old.json"))["method"], "wls");
    assert!(folder.path("link.json").is_symlink());
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

#[test]
fn a_closed_standard_error_is_no_panic() {
    use std::process::{Command, Stdio};
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    folder.write("log.csv", &cart_log(10, 0.0, 0.0));
    for (arguments, code) in [
        (vec!["identify", "cart.robot", "log.csv"], 0),
        (vec!["identify", "cart.robot", "none.csv"], 1),
    ] {
        // The reading end is gone before the program says anything.
        let (reader, writer) = std::io::pipe().expect("a pipe");
        drop(reader);
        let status = Command::new(env!("CARGO_BIN_EXE_robot-model"))
            .args(&arguments)
            .current_dir(folder.path(""))
            .stdout(Stdio::null())
            .stderr(writer)
            .status()
            .expect("the program runs");
        assert_eq!(status.code(), Some(code), "{arguments:?}");
    }
}

#[test]
fn a_result_takes_the_place_of_its_like_and_says_so() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    folder.write("log.csv", &cart_log(5, 0.0, 0.0));
    let run = |json: &str, report: &str| {
        let identify = ["identify", "cart.robot", "log.csv"];
        let run = folder.run(&[&identify[..], &["--json", json, "--report", report]].concat());
        assert_eq!(run.code, Some(0), "{}", run.stderr);
        run
    };
    let said = |name: &str| format!("note: `{name}` existed; this run's result");
    let first = run("fit.json", "page");
    assert!(!first.stderr.contains("existed; this"), "{}", first.stderr);
    // The same bytes again take nothing away.
    let again = run("fit.json", "page");
    assert!(!again.stderr.contains("existed; this"), "{}", again.stderr);
    assert_eq!(first.stdout, again.stdout);

    folder.write("fit.json", "{}");
    folder.write("page/index.html", "<!doctype html><p>of another run");
    let other = run("fit.json", "page");
    assert!(other.stderr.contains(&said("fit.json")), "{}", other.stderr);
    assert!(
        other.stderr.contains(&said("page/index.html")),
        "{}",
        other.stderr
    );
    assert_eq!(other.stdout, first.stdout);
    assert_eq!(json(&folder.read("fit.json"))["method"], "wls");
    // What is empty, as `mktemp` makes it, is nothing that could be lost.
    folder.write("empty.json", "");
    let made = run("empty.json", "page");
    assert!(!made.stderr.contains("`empty.json`"), "{}", made.stderr);
}

#[test]
fn a_result_takes_the_place_of_nothing_else() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    folder.write("other.robot", CART);
    folder.write("arm.urdf", URDF);
    folder.write("log.csv", &cart_log(5, 0.0, 0.0));
    folder.write("tuesday.csv", &cart_log(5, 0.0, 0.7));
    folder.write("motion.csv", "time,q1\n0,0\n0.5,0.1\n1,0\n");
    folder.write("fit.json", "{\"parameters\": {}}");
    folder.write("notes.txt", "what to ask on Monday");
    folder.write(
        "units.csv",
        "time [s],q1 [rad],dq1 [rad/s],tau1 [Nm]\n0,1,2,3\n",
    );
    folder.write("named.csv", "# robot UR5, Monday\ntime,q1,tau1\n0,1,2\n");
    folder.write("blanks.csv", "t;q1\n0;1\n");
    folder.write("kn.csv", "time,tau1\n0.0,1.25\n0.1,1.5\n");
    folder.write(
        "measured.csv",
        "time,q1,dq1,tau1\n0,0.25,0.5,1.25\n0.1,0.5,0.5,1.5\n",
    );
    std::fs::create_dir(folder.path("site")).expect("a folder");
    folder.write("site/index.html", "<p>of somebody else");
    folder.write("values.json", "{\"cart.m\": 3.0}");
    folder.write("payload.json", "{\"payload\": 2.5, \"method\": \"CAD\"}");
    folder.write("first.json", "{\n  \"method\": \"wls\"\n}");
    let of_identify = "result of `identify`";
    let identify = ["identify", "cart.robot", "log.csv"];
    let trace = ["trace", "cart.robot", "log.csv", "--validate", "log.csv"];
    let simulate = ["simulate", "cart.robot", "--trajectory", "motion.csv"];
    for (command, output, file, kind) in [
        (&identify[..], "--json", "tuesday.csv", of_identify),
        (&identify, "--json", "other.robot", of_identify),
        (&identify, "--json", "values.json", of_identify),
        (&identify, "--json", "fit.json", of_identify),
        (&trace, "--json", "first.json", "result of `trace`"),
        (&identify, "--factor", "tuesday.csv", "factor of `identify`"),
        (
            &["export", "cart.robot", "--as", "mjcf"],
            "-o",
            "arm.urdf",
            "MJCF model of `export`",
        ),
        // Of a maker, whose shapes would be lost.
        (
            &["export", "cart.robot", "--as", "urdf"],
            "-o",
            "arm.urdf",
            "URDF of `export`",
        ),
        // What somebody wrote has a name of a result.
        (&identify, "--json", "payload.json", of_identify),
        (&identify, "--report", "site", "page"),
        (&trace, "--amend", "tuesday.csv", "spec"),
        (&trace, "--amend", "arm.urdf", "spec"),
        (&trace, "--amend", "notes.txt", "spec"),
        (&trace, "--amend", "units.csv", "spec"),
        (&trace, "--amend", "named.csv", "spec"),
        (&trace, "--amend", "blanks.csv", "spec"),
        (&trace, "--predict", "fit.json", "prediction of `trace`"),
        (&trace, "--predict", "kn.csv", "prediction of `trace`"),
        (&trace, "--predict", "measured.csv", "prediction of `trace`"),
        (&simulate, "--out", "other.robot", "log of `simulate`"),
        (&simulate, "--out", "measured.csv", "log of `simulate`"),
        (&simulate, "--out", "tuesday.csv", "log of `simulate`"),
        (
            &["excite", "cart.robot"],
            "--out",
            "measured.csv",
            "motion of `excite`",
        ),
        (
            &["export", "cart.robot", "--as", "urdf"],
            "-o",
            "other.robot",
            "URDF of `export`",
        ),
    ] {
        let named = if output == "--report" {
            "site/index.html"
        } else {
            file
        };
        let before = folder.read(named);
        assert_eq!(
            folder.refuse(&[command, &[output, file]].concat()),
            format!(
                "error: cannot write `{named}`: the existing file is not a {kind}, and would be lost; give another name, or remove that \
                 file first\n"
            )
        );
        assert_eq!(folder.read(named), before);
    }
    let of_another = "// By hand.\nrobot Another { gravity = [0, 0, -9.81]; }\n";
    folder.write("another.robot", of_another);
    assert_eq!(
        folder.refuse(&[&trace[..], &["--amend", "another.robot"]].concat()),
        "error: cannot write `another.robot`: the existing file is the spec of robot `Another`, and would be lost; give another name, or \
         remove that file first\n"
    );
    assert_eq!(folder.read("another.robot"), of_another);
}

/// Logs that are simulated again, as text and as a bag.
#[test]
fn a_table_takes_the_place_of_what_its_verb_wrote() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    folder.write(
        "values.json",
        r#"{"cart.m": 2.5, "rail.viscous_friction.fv": 0.5}"#,
    );
    let mut motion = String::from("time,q1\n");
    for k in 0..=100 {
        let t = 0.01 * f64::from(k);
        writeln!(motion, "{t},{}", 0.1 * (3.0 * t).sin()).expect("a string takes all");
    }
    folder.write("motion.csv", &motion);
    let simulate = |out: &str, frequency: &str| {
        let inputs = ["--trajectory", "motion.csv", "--parameters", "values.json"];
        let more = ["--frequency", frequency, "--out", out];
        let run = folder.run(&[&["simulate", "cart.robot"], &inputs[..], &more].concat());
        assert_eq!(run.code, Some(0), "{}", run.stderr);
        run.stderr
    };
    for out in ["log.csv", "log.mcap"] {
        let note = format!("note: `{out}` existed");
        assert!(!simulate(out, "5").contains(&note));
        assert!(simulate(out, "10").contains(&note));
        // The same bytes again take nothing away.
        assert!(!simulate(out, "10").contains(&note));
    }
}

#[test]
fn a_report_that_has_no_folder_is_told_before_the_work() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    folder.write("log.csv", &cart_log(5, 0.0, 0.0));
    // Whoever refuses before it reads the log has not said that it does.
    let identify = |outputs: &[&str]| {
        let said = folder.refuse(&[&["identify", "cart.robot", "log.csv"], outputs].concat());
        assert!(!said.contains("reading log.csv"), "{said}");
        said
    };
    assert_eq!(
        identify(&["--json", "out", "--report", "./out"]),
        "error: cannot write `./out`: it is the same file as the output `out`; give each its own name\n"
    );
    assert_eq!(
        identify(&["--report", "log.csv"]),
        "error: cannot write `log.csv`: it is the same file as the input `log.csv`; give another name\n"
    );
    folder.write("notes", "of mine");
    assert_eq!(
        identify(&["--report", "notes"]),
        "error: cannot write `notes`: it is a file, but `--report` takes a folder\n"
    );
    assert_eq!(
        identify(&["--report", "notes/page"]),
        "error: cannot write `notes/page`: `notes` is not a folder\n"
    );
    assert_eq!(
        identify(&["--json", "none/fit.json"]),
        "error: cannot write `none/fit.json`: there is no folder `none`; create it first\n"
    );
}
