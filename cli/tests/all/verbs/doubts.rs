//! What `identify` notes of logs and of what was found of them.

use std::fmt::Write;

use crate::verbs::common::{CART, Folder, PENDULUM, cart_log, cart_with, json, moved, tones};

const FRICTION: &str = "{\"upper.viscous_friction.fv\": 0.5, \"lower.viscous_friction.fv\": 0.2}";

/// Swings of both joints, by a share of wide ones.
fn swings(share: f64) -> impl Fn(f64) -> [f64; 2] {
    move |t| {
        let upper = 0.6 * (1.3 * t).sin() + 0.3 * (2.9 * t).sin();
        let lower = 0.7 * (1.9 * t).sin() - 0.4 * (3.3 * t).cos();
        [share * upper, share * lower]
    }
}

/// A folder with a log of the double pendulum, which has links of CAD and friction.
fn folder(share: f64) -> Folder {
    let folder = Folder::new();
    let spec = PENDULUM.replace("\n}\n", "\n    effects { viscous_friction on all; }\n}\n");
    moved(&folder, &spec, FRICTION, swings(share));
    folder
}

/// A log with torques times factors.
fn scaled(folder: &Folder, name: &str, factors: [f64; 2]) {
    let log = folder.read("log.csv");
    let header = log.lines().next().expect("a header");
    let place = |name: &str| header.split(',').position(|column| column == name);
    let places = ["tau1", "tau2"].map(|name| place(name).expect("a torque"));
    let mut text = format!("{header}\n");
    for line in log.lines().skip(1) {
        let mut fields: Vec<String> = line.split(',').map(str::to_owned).collect();
        for (place, factor) in places.into_iter().zip(factors) {
            let value: f64 = fields[place].parse().expect("a number");
            fields[place] = (factor * value).to_string();
        }
        writeln!(text, "{}", fields.join(",")).expect("a string takes all");
    }
    folder.write(name, &text);
}

/// What is noted.
fn notes(folder: &Folder, arguments: &[&str]) -> String {
    let run = folder.run(&[&["identify"], arguments].concat());
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let lines = run.stderr.lines();
    let told = lines.filter(|line| line.starts_with("note: ") || line.starts_with("warning: "));
    told.collect::<Vec<_>>().join("\n")
}

#[test]
fn torques_in_another_unit_or_with_another_sign_are_noted() {
    let folder = folder(1.0);
    scaled(&folder, "mm.csv", [1000.0, 1000.0]);
    scaled(&folder, "turned.csv", [1.0, -1.0]);
    assert_eq!(notes(&folder, &["true.robot", "log.csv"]), "");
    let said = notes(&folder, &["true.robot", "mm.csv", "--validate", "log.csv"]);
    assert!(
        said.contains("about 1000 times those of the spec's nominal links"),
        "{said}"
    );
    assert!(
        said.contains("of the validation log; residual: `upper` "),
        "{said}"
    );
    let said = notes(&folder, &["true.robot", "turned.csv"]);
    assert!(
        said.contains("with the torque of `lower` with the opposite sign the residual is"),
        "{said}"
    );
}

#[test]
fn joints_that_hardly_move_leave_parameters_untold() {
    let folder = folder(0.01);
    let said = notes(&folder, &["true.robot", "log.csv"]);
    assert!(
        said.contains("the logs hardly determine 1 of 8 parameters")
            && said.contains("`upper.viscous_friction.fv`; joints `upper`, `lower` hardly move"),
        "{said}"
    );
    assert!(said.contains("`excite`"), "{said}");
}

/// The same motion, with a torque that turns round in the middle: what is hardly told is so for what does not fit.
#[test]
fn a_misfit_is_not_told_as_a_want_of_motion() {
    let folder = folder(1.0);
    let log = folder.read("log.csv");
    let count = log.lines().count();
    let header = log.lines().next().expect("a header");
    let place = header.split(',').position(|name| name == "tau1");
    let place = place.expect("a torque");
    let mut text = format!("{header}\n");
    for (k, line) in log.lines().enumerate().skip(1) {
        let mut fields: Vec<String> = line.split(',').map(str::to_owned).collect();
        if (2 * count / 5..count / 2).contains(&k) {
            let value: f64 = fields[place].parse().expect("a number");
            fields[place] = (-value).to_string();
        }
        writeln!(text, "{}", fields.join(",")).expect("a string takes all");
    }
    folder.write("burst.csv", &text);
    let said = notes(&folder, &["true.robot", "burst.csv"]);
    assert!(
        said.contains(
            "`upper.viscous_friction.fv`; the motion would determine them with a residual of 2 % of the torque"
        ) && said.contains("the model does not fit: `upper` "),
        "{said}"
    );
    assert!(!said.contains("further and faster"), "{said}");
}

#[test]
fn a_shape_at_the_end_of_its_range_is_noted() {
    let folder = Folder::new();
    let spec = |range: &str| {
        let drag = "effect drag(j) { linear f; shape w in RANGE; torque(j) = f * dq(j) / (w + abs(dq(j))); }\n";
        drag.replace("RANGE", range) + &CART.replace("viscous_friction on rail;", "drag on rail;")
    };
    folder.write("narrow.robot", &spec("0.02 .. 0.1"));
    folder.write("wide.robot", &spec("0.02 .. 5"));
    let mut log = String::from("time,q1,tau1\n");
    for k in 0..6000 {
        let t = f64::from(k) / 200.0;
        let wave = |a: f64, w: f64| {
            let (sin, cos) = (w * t).sin_cos();
            [a * sin, a * w * cos, -a * w * w * sin]
        };
        let waves = [wave(0.2, 1.3), wave(0.05, 4.1)];
        let [q, dq, ddq] = [0, 1, 2].map(|k| waves[0][k] + waves[1][k]);
        let tau = 3.0 * ddq + 9.0 * dq / (0.4 + dq.abs());
        writeln!(log, "{t},{q},{tau}").expect("a string takes all");
    }
    folder.write("log.csv", &log);
    let said = notes(&folder, &["narrow.robot", "log.csv"]);
    assert!(
        said.contains("`rail.drag.w` is at the upper end of its range 0.02 .. 0.1"),
        "{said}"
    );
    assert_eq!(notes(&folder, &["wide.robot", "log.csv"]), "");
}

#[test]
fn a_log_that_is_given_twice_is_noted() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    for name in ["log.csv", "copy.csv"] {
        folder.write(name, &cart_log(20, 0.0, 0.0));
    }
    folder.write("other.csv", &cart_log(20, 0.0, 0.7));
    let said = |arguments: &[&str]| notes(&folder, &[&["cart.robot"], arguments].concat());
    assert_eq!(said(&["log.csv", "other.csv"]), "");
    for again in ["log.csv", "copy.csv"] {
        let told = said(&["log.csv", again]);
        assert!(
            told.contains(&format!("{again} is the same log as log.csv: ")),
            "{told}"
        );
    }
    let told = said(&["log.csv", "--validate", "copy.csv"]);
    assert!(
        told.contains("copy.csv is the same log as log.csv, which is fitted"),
        "{told}"
    );
    let told = said(&["log.csv", "log.csv", "--factor", "factor.json"]);
    assert!(told.contains("is the same log as"), "{told}");
}

/// Base parameters of a possible arm come with the standard ones that make them.
#[test]
fn an_audit_of_a_possible_arm_looks_at_its_bodies() {
    let folder = folder(1.0);
    let physical = ["--method", "physical", "--json", "fit.json"];
    folder.succeed(&[&["identify", "true.robot", "log.csv"][..], &physical].concat());
    let audit = |file: &str| folder.run(&["audit", "true.robot", "--parameters", file]);
    let run = audit("fit.json");
    assert_eq!(run.code, Some(0), "{}{}", run.stdout, run.stderr);
    assert!(
        run.stdout.contains("2 links: mass spread over space"),
        "{}",
        run.stdout
    );
    // Of another arm they are left out.
    let mut fit = json(&folder.read("fit.json"));
    let standard = fit["possible"]["standard"].as_array_mut().expect("a list");
    let inertia = standard
        .iter_mut()
        .find(|entry| entry["name"] == "lower.izz");
    inertia.expect("an inertia")["value"] = 7.0.into();
    folder.write("other.json", &fit.to_string());
    let run = audit("other.json");
    assert!(
        run.stderr.contains("contradict its base parameters"),
        "{}",
        run.stderr
    );
    assert!(
        run.stdout.contains("2 links, by base parameters"),
        "{}",
        run.stdout
    );
}

#[test]
fn a_fixed_body_that_is_another_than_the_arm_has_is_noted() {
    let folder = folder(1.0);
    let fixed = |mass: &str| {
        let spec = folder
            .read("true.robot")
            .replace("link upper {", "link upper: fixed {");
        spec.replace(
            "link lower { mass = 1;",
            &format!("link lower: fixed {{ mass = {mass};"),
        )
    };
    folder.write("as_it_is.robot", &fixed("1"));
    folder.write("heavy.robot", &fixed("1.2"));
    assert_eq!(notes(&folder, &["as_it_is.robot", "log.csv"]), "");
    let said = notes(&folder, &["heavy.robot", "log.csv"]);
    let told = "note: these logs fit better with `lower` identified instead of `fixed`: residual ";
    assert!(said.contains(told), "{said}");
    assert!(!said.contains("move all joints further"), "{said}");
}

#[test]
fn torque_that_is_left_and_goes_on_from_row_to_row_is_noted() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    let pushed = |force: f64| {
        cart_with(
            200,
            25,
            &tones(0.3),
            |q, _| if q > 0.15 { force } else { 0.0 },
        )
    };
    folder.write("free.csv", &pushed(0.0));
    folder.write("pushed.csv", &pushed(2.0));
    assert_eq!(notes(&folder, &["cart.robot", "free.csv"]), "");
    let said = notes(&folder, &["cart.robot", "pushed.csv"]);
    assert!(
        said.contains("the residual is correlated from row to row, unlike noise: `rail` "),
        "{said}"
    );
    assert!(!said.contains("the logs are"), "{said}");
}

/// Where both streams go to one place, what puts a whole fit in doubt is last, behind its errors.
#[test]
fn a_fit_that_is_none_is_doubted_behind_its_errors() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    let log = cart_log(40, 2.0, 0.0);
    let rows = log.lines().enumerate().map(|(k, line)| {
        let (motion, torque) = line.rsplit_once(',').expect("columns");
        let noise = ((k * k) % 97) as f64 - 48.0;
        if k == 0 {
            format!("{motion},{torque}")
        } else {
            format!("{motion},{noise}")
        }
    });
    folder.write("log.csv", &rows.collect::<Vec<_>>().join("\n"));
    let both = std::fs::File::create(folder.path("both.txt")).expect("a file");
    let status = std::process::Command::new(env!("CARGO_BIN_EXE_robot-model"))
        .current_dir(folder.path("."))
        .args(["identify", "cart.robot", "log.csv"])
        .stdout(both.try_clone().expect("a second one"))
        .stderr(both)
        .status();
    assert!(status.expect("the program starts").success());
    let said = folder.read("both.txt");
    let last = said.lines().last().expect("lines");
    assert!(
        last.starts_with("note: the model explains almost none"),
        "{said}"
    );
    let errors = said.find("NRMSE fit").expect("errors");
    assert!(
        errors < said.find("note: the model explains").expect("a note"),
        "{said}"
    );
}
