//! What logs tell of parameters that they do not tell apart, which parameters matter, and intervals without a formula.

use std::fmt::Write;

use crate::verbs::common::{CART, Folder, cart_log, json, numbers, white};

/// A cart whose spec has friction that is another one's where its log is, and one that this never reaches.
fn twice() -> Folder {
    let folder = Folder::new();
    let spec = CART.replace(
        "viscous_friction on rail;",
        "one on rail; more on rail; coulomb_friction on rail; stop on rail;",
    ) + "effect one(j) { linear c; torque(j) = c * dq(j) * (2 - sign(q(j) + 1)); }\n\
         effect more(j) { linear c; torque(j) = 4 * c * dq(j) * (2 + sign(q(j) - 1)); }\n\
         effect stop(j) { linear c; torque(j) = c * (1 + sign(q(j) - 1)); }\n";
    folder.write("cart.robot", &spec);
    folder.write("log.csv", &cart_log(20, 2.0, 0.0));
    folder
}

#[test]
fn logs_that_do_not_tell_all_apart_are_refused_with_what_they_tell() {
    let folder = twice();
    let said = folder.refuse(&["identify", "cart.robot", "log.csv", "--json", "out.json"]);
    for part in [
        "rank 3 of 5",
        "the logs say nothing about `rail.stop.c`",
        "cannot be separated from others, only `",
        "--partial",
        "excite",
    ] {
        assert!(said.contains(part), "{said}");
    }
}

#[test]
fn what_they_tell_is_taken_where_that_is_wanted() {
    let folder = twice();
    let partial = ["--partial", "--json", "out.json"];
    let table = folder.succeed(&[&["identify", "cart.robot", "log.csv"][..], &partial].concat());
    let out = json(&folder.read("out.json"));
    let unexcited = out["unexcited"].as_array().expect("a list");
    assert!(unexcited.len() == 2 && unexcited.contains(&"rail.stop.c".into()));
    let combinations = out["combinations"].as_array().expect("a list");
    assert_eq!(combinations.len(), 1, "{combinations:?}");
    let terms = combinations[0]["terms"].as_array().expect("a list");
    let term = |k: usize| {
        let name = terms[k]["name"].as_str().expect("a name");
        (name, terms[k]["factor"].as_f64().expect("a number"))
    };
    // Both are shares of the same friction, which is 5, whichever leads.
    let (expected, factor) = match term(0) {
        ("rail.one.c", _) => (5.0, 4.0),
        ("rail.more.c", _) => (1.25, 0.25),
        other => panic!("{other:?} is told by itself"),
    };
    assert_eq!(terms.len(), 2);
    assert!((term(0).1 - 1.0).abs() < 1e-12 && (term(1).1 - factor).abs() < 1e-6 * factor);
    let value = combinations[0]["value"].as_f64().expect("a number");
    assert!(
        (value - expected).abs() < 0.01 * expected,
        "{value} {expected}"
    );
    let parameters = out["parameters"].as_array().expect("a list");
    for k in [0, 1] {
        let own = parameters.iter().find(|p| p["name"] == *term(k).0);
        assert!(
            own.expect("listed")["value"].is_null(),
            "no claim on a part"
        );
    }
    let line = format!("  {} + {factor:.4} {} = ", term(0).0, term(1).0);
    assert!(table.contains(&line), "{table}");
    let mass = &parameters[0];
    assert!((mass["value"].as_f64().expect("told by itself") - 3.0).abs() < 0.02);
}

/// A part of a sum has no value of its own among essential ones either.
#[test]
fn sums_that_are_told_are_essential_and_their_parts_are_not() {
    let folder = twice();
    let asked = ["--partial", "--essential", "--json", "out.json"];
    let table = folder.succeed(&[&["identify", "cart.robot", "log.csv"][..], &asked].concat());
    let out = json(&folder.read("out.json"));
    let essential = &out["essential"];
    let names = essential["parameters"].as_array().expect("a list").iter();
    let names: Vec<&str> = names.filter_map(|one| one["name"].as_str()).collect();
    assert_eq!(names, ["cart.m", "rail.coulomb_friction.fc"], "{table}");
    assert_eq!(essential["combinations"].as_array().map(Vec::len), Some(1));
    assert_eq!(
        essential["combinations"][0]["terms"],
        out["combinations"][0]["terms"]
    );
    assert!(
        table.contains("essential: 2 of 5 parameters and 1 sum"),
        "{table}"
    );
}

/// Others may tell what a log does not, so a factor is made of it, and it is said.
#[test]
fn a_factor_of_logs_that_do_not_tell_all_apart_is_made_and_noted() {
    let folder = twice();
    let reduce = ["identify", "cart.robot", "log.csv", "--factor", "f.json"];
    let run = folder.run(&reduce);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let told = "rank 3 of 5";
    assert!(
        run.stderr.contains("note: ") && run.stderr.contains(told),
        "{}",
        run.stderr
    );
    let merge = folder.refuse(&["merge", "cart.robot", "f.json"]);
    assert!(merge.contains(told), "{merge}");
    let run = folder.run(&[&reduce[..], &["--partial"]].concat());
    assert!(!run.stderr.contains(told), "{}", run.stderr);
}

/// Friction behind 0.35 m, where the cart is once in twenty seconds.
#[test]
fn what_one_block_of_a_factor_tells_is_named() {
    let folder = Folder::new();
    let spec = CART.replace(
        "viscous_friction on rail;",
        "viscous_friction on rail; stop on rail;",
    ) + "effect stop(j) { linear c; torque(j) = c * (1 + sign(q(j) - 0.35)); }\n";
    folder.write("cart.robot", &spec);
    let mut log = String::from("time,q1,tau1\n");
    let mut state = 3;
    for k in 0..4000 {
        let time = 0.005 * f64::from(k);
        let (swing, far) = (1.9 * time, (time - 10.6) / 0.3);
        let bump = 0.4 * (-far * far).exp();
        let q = 0.1 * swing.sin() + bump;
        let dq = 0.19 * swing.cos() - 2.0 * far / 0.3 * bump;
        let ddq = -0.361 * swing.sin() + (4.0 * far * far - 2.0) / 0.09 * bump;
        let stop = if q > 0.35 { 2.0 } else { 0.0 };
        let tau = 3.0 * ddq + 5.0 * dq + stop + 0.2 * white(&mut state);
        writeln!(log, "{time:.3},{q:.8},{tau:.6}").expect("a string takes all");
    }
    folder.write("log.csv", &log);
    let reduce = ["identify", "cart.robot", "log.csv", "--factor", "f.json"];
    let run = folder.run(&[&reduce[..], &["--json", "fit.json"]].concat());
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let told = "only one block of the logs determines `rail.stop.c`";
    assert!(run.stderr.contains(told), "{}", run.stderr);
    let fit = json(&folder.read("fit.json"));
    let stop = fit["parameters"].as_array().expect("a list").iter();
    let stop = stop
        .clone()
        .find(|one| one["name"] == "rail.stop.c")
        .expect("it is told");
    let [value, std] = ["value", "std"].map(|key| stop[key].as_f64().expect("a number"));
    assert!((value - 1.0).abs() < 3.0 * std && std < 0.2, "{stop}");
}

#[test]
fn intervals_of_draws_and_independent_samples_are_told() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    folder.write("log.csv", &cart_log(30, 0.0, 0.0));
    let asked = ["--bootstrap", "400", "--json", "out.json"];
    let identify = [&["identify", "cart.robot", "log.csv"][..], &asked].concat();
    let table = folder.succeed(&identify);
    assert!(
        table.contains("95 % confidence intervals from 400 draws of"),
        "{table}"
    );
    let out = json(&folder.read("out.json"));
    for parameter in out["parameters"].as_array().expect("a list") {
        let [low, high] = numbers(&parameter["interval"])[..] else {
            panic!("{parameter}");
        };
        let (value, std) = (&parameter["value"], &parameter["std"]);
        let (value, std) = (
            value.as_f64().expect("a number"),
            std.as_f64().expect("a number"),
        );
        let wide = (high - low) / (2.0 * 1.96 * std);
        assert!(low < value && value < high, "{parameter}");
        assert!((0.6..1.5).contains(&wide), "{parameter} {wide}");
    }
    let effective = numbers(&out["effective_samples"]);
    assert!(effective.len() == 1 && effective[0] > 100.0);
    for (method, said) in [("iv", "--bootstrap"), ("output-error", "--bootstrap")] {
        let options = [&identify[..], &["--method", method]].concat();
        assert!(folder.refuse(&options).contains(said));
    }
}

#[test]
fn parameters_that_are_not_told_from_zero_are_not_essential() {
    let folder = Folder::new();
    let friction = "viscous_friction on rail; coulomb_friction on rail; quadratic_viscous on rail; joint_spring on rail;";
    folder.write(
        "cart.robot",
        &CART.replace("viscous_friction on rail;", friction),
    );
    folder.write("log.csv", &cart_log(30, 0.0, 0.0));
    let asked = ["--essential", "--json", "out.json"];
    let table = folder.succeed(&[&["identify", "cart.robot", "log.csv"][..], &asked].concat());
    let out = json(&folder.read("out.json"));
    assert_eq!(out["parameters"].as_array().expect("a list").len(), 6);
    let essential = out["essential"]["parameters"].as_array().expect("a list");
    let names: Vec<&str> = essential
        .iter()
        .filter_map(|p| p["name"].as_str())
        .collect();
    assert!(names.len() <= 3, "{names:?}");
    for (name, truth) in [("cart.m", 3.0), ("rail.viscous_friction.fv", 5.0)] {
        let k = names.iter().position(|found| *found == name).expect(name);
        let value = essential[k]["value"].as_f64().expect("a number");
        assert!((value - truth).abs() < 0.01 * truth, "{name}: {value}");
    }
    let (alone, all) = (
        &out["essential"]["relative_percent"],
        &out["relative_percent"],
    );
    assert!(numbers(alone)[0] < 1.01 * numbers(all)[0]);
    assert!(table.contains("essential: "), "{table}");
}

/// Two of three joints are held, and move by what their controllers let go: friction comes out far beyond its deviation. Without the
/// rows in which dry friction may hold them, logs do not tell their parameters at all.
#[test]
fn joints_that_hardly_move_are_told() {
    let folder = Folder::new();
    let arm = |dry: &str| {
        let arm = "robot A {
        gravity = [0, 0, -9.81];
        convention = standard_dh;
        joint j1: revolute { a = 0; alpha = 90 deg; d = 0.4; }
        joint j2: revolute { a = 0.5; alpha = 0; d = 0; }
        joint j3: revolute { a = 0.3; alpha = 90 deg; d = 0.1; }
        link j1 { mass = 5; com = [0, -0.1, 0.02]; inertia = [0.05, 0, 0, 0.04, 0, 0.05]; }
        link j2 { mass = 3; com = [-0.25, 0, 0.05]; inertia = [0.01, 0, 0, 0.07, 0, 0.07]; }
        link j3 { mass = 2; com = [-0.1, 0.02, 0.05]; inertia = [0.01, 0, 0, 0.02, 0, 0.02]; }
        effects { viscous_friction on all; DRY }
    }";
        folder.write("arm.robot", &arm.replace("DRY", dry));
        let names = ["viscous_friction.fv", "coulomb_friction.fc"];
        let names = &names[..if dry.is_empty() { 1 } else { 2 }];
        let of = |joint| {
            names
                .iter()
                .map(move |name| format!("\"j{joint}.{name}\": 0.5"))
        };
        let values: Vec<String> = (1..=3).flat_map(of).collect();
        folder.write("values.json", &format!("{{{}}}", values.join(", ")));
    };
    let run = |others: &dyn Fn(f64) -> [f64; 2]| {
        let mut wanted = String::from("time,q1,q2,q3\n");
        for k in 0..=2000 {
            let t = f64::from(k) / 200.0;
            let first = 0.6 * (1.3 * t).sin() + 0.2 * (4.1 * t).sin();
            let [second, third] = others(t);
            writeln!(wanted, "{t},{first},{second},{third}").expect("a string takes all");
        }
        folder.write("wanted.csv", &wanted);
        let motion = ["--trajectory", "wanted.csv", "--out", "log.csv"];
        let more = ["--parameters", "values.json", "--encoder-bits", "18"];
        folder.succeed(&[&["simulate", "arm.robot"], &motion[..], &more].concat());
        let identify = ["identify", "arm.robot", "log.csv"];
        [
            folder.run(&identify),
            folder.run(&[&identify[..], &["--leave-out-turns"]].concat()),
        ]
    };
    let held = |_| [-0.5, 0.3];
    arm("coulomb_friction on all;");
    // Dry friction holds them: whatever their torque is, no law says it.
    for refused in run(&held) {
        assert_eq!(refused.code, Some(1), "{}", refused.stdout);
        let told = "`j2`, `j3` are at rest or reverse nearly all the time";
        assert!(refused.stderr.contains(told), "{}", refused.stderr);
    }
    let said = |others: &dyn Fn(f64) -> [f64; 2]| {
        let [run, without_turns] = run(others);
        for run in [&run, &without_turns] {
            assert_eq!(run.code, Some(0), "{}", run.stderr);
        }
        run.stderr
    };
    let moves = |t: f64| {
        let second = 0.7 * (2.1 * t + 1.0).sin() + 0.2 * (5.3 * t).cos();
        [second, 0.6 * (1.7 * t + 0.4).sin() + 0.2 * (4.7 * t).cos()]
    };
    let moving = said(&moves);
    assert!(!moving.contains("hardly"), "{moving}");
    arm("");
    // Without it the noise of their encoders alone parts what they carry.
    for refused in run(&held) {
        assert_eq!(refused.code, Some(1), "{}", refused.stdout);
        let told = "cannot be separated from others";
        assert!(refused.stderr.contains(told), "{}", refused.stderr);
    }
    let moving = said(&moves);
    assert!(!moving.contains("hardly"), "{moving}");
}
