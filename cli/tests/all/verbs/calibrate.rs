//! `calibrate`: from a current to a torque, and the back-EMF of a motor.

use std::fmt::Write;

use crate::verbs::common::{Folder, close, json, numbers, white};

#[path = "../../../../runtime/src/calibrate/commanded/tests/arm.rs"]
mod arm;

/// Forces at 0.45 m from the joint of an arm with 0.1132 N m/A and 0.02 N m of friction, up to 8 A and back.
fn blocked() -> String {
    let mut text = String::from("i, remark, f\n");
    let mut noise = 7;
    for k in 0..=16_i32 {
        let (current, way) = (
            f64::from(8 - (8 - k).abs()),
            if k <= 8 { 1.0 } else { -1.0 },
        );
        let torque = 0.1132 * current - 0.02 * way + 0.004 * white(&mut noise);
        writeln!(text, "{current}, row {k}, {:.6}", torque / 0.45).expect("a string takes all");
    }
    text
}

#[test]
fn the_gain_of_a_blocked_arm() {
    let folder = Folder::new();
    folder.write("blocked.csv", &blocked());
    let columns = ["--current", "i", "--force", "f", "--arm", "0.45"];
    let files = ["--json", "gain.json", "--figure", "gain.svg"];
    let calibrate = ["calibrate", "static", "blocked.csv"];
    let said = folder.succeed(&[&calibrate[..], &columns, &files].concat());
    let found = json(&folder.read("gain.json"));
    let number = |name: &str| found[name].as_f64().expect(name);
    close(number("gain"), 0.1132, 0.002);
    close(number("offset"), 0.0, 0.01);
    let interval = numbers(&found["gain_interval"]);
    assert!(interval[0] < 0.1132 && 0.1132 < interval[1] && number("gain_std") < 0.003);
    assert!(number("r") > 0.99 && number("residual_std") < 0.03);
    close(number("friction"), 0.02, 0.001);
    close(number("hysteresis"), 0.04, 0.002);
    assert!(number("hysteresis_p") < 1e-6 && number("curvature_p") > 0.05);
    assert_eq!(found["samples"], 17);
    // The line for the spec has the gain, within its deviation.
    let line = said.lines().last().expect("a line").trim();
    let gain = line
        .strip_prefix("actuator_gain = ")
        .and_then(|rest| rest.strip_suffix(" Nm/A;"))
        .unwrap_or_else(|| panic!("{said}"));
    let beside = number("gain_beside_hysteresis");
    let std = number("gain_beside_hysteresis_std");
    close(gain.parse().expect("a number"), beside, 0.1 * std);
    close(beside, 0.1132, 4.0 * std);
    assert!(std < 0.5 * number("gain_std"));
    assert_eq!(found["spec"], line);
    assert!(said.contains("N m, is friction"), "{said}");
    let figure = folder.read("gain.svg");
    assert_eq!(figure.matches("<circle").count(), 17);
    assert!(figure.contains("<polygon") && figure.contains("torque, N m"));
}

#[test]
fn a_gain_that_saturates_is_no_line() {
    let folder = Folder::new();
    let mut text = String::from("i,tau\n");
    for k in 0..10 {
        let i = f64::from(k);
        writeln!(text, "{i},{}", 0.1 * i - 0.002 * i * i).expect("a string takes all");
    }
    folder.write("bent.csv", &text);
    let columns = ["--current", "i", "--torque", "tau", "--json", "bent.json"];
    let said = folder.succeed(&[&["calibrate", "static", "bent.csv"][..], &columns].concat());
    assert!(said.contains("NOT LINEAR"), "{said}");
    assert!(said.contains("hysteresis  unknown"), "{said}");
    let found = json(&folder.read("bent.json"));
    close(found["curvature"].as_f64().expect("told"), -0.002, 1e-9);
    // A gain that is not there is in no spec.
    assert!(
        found["spec"].is_null() && !said.contains("actuator_gain"),
        "{said}"
    );
    assert!(said.contains("saturates, and calibrate again"), "{said}");
    assert!(found["hysteresis"].is_null() && found["friction"].is_null());
}

#[test]
fn tables_that_are_none_are_refused() {
    let folder = Folder::new();
    folder.write("blocked.csv", &blocked());
    let said = |table: &str, text: &str, columns: &[&str]| {
        if !text.is_empty() {
            folder.write(table, text);
        }
        let files = ["--json", "out.json", "--figure", "out.svg"];
        folder.refuse(&[&["calibrate", "static", table][..], columns, &files].concat())
    };
    let columns = ["--current", "i", "--torque", "tau"];
    for (text, words) in [
        (
            "i,tau\n1,2\n2,x\n3,4\n",
            "t.csv:3: `x` in column `tau` is no finite number",
        ),
        ("i,tau\n1,2\n2,NaN\n3,4\n", "t.csv:3: `NaN`"),
        ("i,tau\n1,2\n2,\n3,4\n", "t.csv:3: ``"),
        ("i,tau\n1,2\n2\n3,4\n", "t.csv:3: the row has 1 fields"),
        (
            "i,tau\n1,2\n2,3\n",
            "2 samples are too few; give at least 3",
        ),
        ("i,tau\n1,2\n1,3\n1,4\n", "the current is constant"),
        (
            "i,force\n1,2\n",
            "no column `tau` for --torque; the header has `i`, `force`",
        ),
        ("i,tau,i\n1,2,3\n", "column `i` appears twice"),
        ("i;tau\n1;2\n", "separate columns with commas"),
        ("1,2\n2,3\n", "no header"),
        ("\n", "empty"),
    ] {
        let said = said("t.csv", text, &columns);
        assert!(said.contains(words), "{text}: {said}");
    }
    let other = |columns: &[&str]| said("blocked.csv", "", columns);
    let twice = other(&["--current", "i", "--torque", "i"]);
    assert!(
        twice.contains("--current and --torque name the same column"),
        "{twice}"
    );
    for arm in ["0", "-0.4", "NaN"] {
        let said = other(&["--current", "i", "--force", "f", "--arm", arm]);
        assert!(said.contains("--arm"), "{said}");
    }
    let remark = other(&["--current", "i", "--torque", "remark"]);
    assert!(remark.contains("blocked.csv:2: `row 0`"), "{remark}");
    assert!(said("none.csv", "", &columns).contains("cannot read `none.csv`"));
    let calibrate = ["calibrate", "static", "blocked.csv", "--current", "i"];
    for usage in [
        &[][..],
        &["--force", "f"],
        &["--torque", "f", "--arm", "0.4"],
        &["--torque", "f", "--force", "f", "--arm", "0.4"],
    ] {
        assert_eq!(
            folder.run(&[&calibrate[..], usage].concat()).code,
            Some(2),
            "{usage:?}"
        );
    }
}

/// The upright arm of the paper, with an encoder of 12 bits and some noise of the current.
fn swing(noise: f64) -> String {
    let log = arm::arm(2.6, 1.5);
    let encoded = arm::encoded(&log.position, 12);
    let mut text = String::from("time,q1,u,w,volts\n");
    let mut random = 11;
    for k in 0..log.time.len() {
        let u = log.drop[k] + noise * white(&mut random);
        let (t, q, w) = (log.time[k], encoded[k], log.velocity[k]);
        // What a meter tells that has its own offset, with 0.4 ohm in place of 1 before the motor.
        let volts = 0.4 * u + 1.5 * w + 0.1 + noise * white(&mut random);
        writeln!(text, "{t:.6},{q:.8},{u:.8},{w:.8},{volts:.8}").expect("a string takes all");
    }
    text
}

#[test]
fn a_voltage_that_nobody_logged_is_found_in_positions_and_in_velocities() {
    let folder = Folder::new();
    folder.write("swing.csv", &swing(0.1));
    let log = arm::arm(2.6, 1.5);
    let calibrate = ["calibrate", "back-emf", "swing.csv", "--current", "u"];
    for motion in [["--position", "q1"], ["--velocity", "w"]] {
        let files = ["--json", "k.json", "--figure", "k.svg"];
        let said = folder.succeed(&[&calibrate[..], &motion, &files].concat());
        let found = json(&folder.read("k.json"));
        let number = |name: &str| found[name].as_f64().expect(name);
        close(number("back_emf"), 1.5, 0.05);
        assert!(number("back_emf_std") < 0.05 && number("explained_percent") > 99.0);
        assert!(number("by_jumps_percent") > 90.0 && number("attenuation_percent") < 5.0);
        let switches = numbers(&found["switches"]);
        assert_eq!(switches.len(), log.switches.len(), "{said}");
        for (found, truth) in switches.iter().zip(&log.switches) {
            close(*found, *truth, 0.1);
        }
        let levels = found["levels"].as_array().expect("a list");
        for (k, level) in levels.iter().enumerate() {
            let wanted = if k % 2 == 0 { 2.6 } else { -2.6 };
            close(level["level"].as_f64().expect("a number"), wanted, 0.1);
        }
        assert!(
            said.starts_with("back-EMF    1.") && said.contains("levels"),
            "{said}"
        );
        assert!(folder.read("k.svg").contains("v = u + k w"));
    }
}

#[test]
fn a_logged_voltage_gives_the_resistance_too() {
    let folder = Folder::new();
    folder.write("swing.csv", &swing(0.02));
    let calibrate = ["calibrate", "back-emf", "swing.csv", "--current", "u"];
    // At 30 Hz positions tell little of how the arm starts to move.
    for (motion, tolerance) in [(["--position", "q1"], 0.05), (["--velocity", "w"], 0.002)] {
        let files = [
            "--voltage",
            "volts",
            "--json",
            "motor.json",
            "--figure",
            "motor.svg",
        ];
        let said = folder.succeed(&[&calibrate[..], &motion, &files].concat());
        let found = json(&folder.read("motor.json"));
        for (name, truth) in [("resistance", 0.4), ("back_emf", 1.5), ("offset", 0.1)] {
            let number = |end: &str| found[format!("{name}{end}")].as_f64().expect(name);
            close(number(""), truth, tolerance);
            assert!(number("_std") > 0.0 && number("_std") < tolerance);
        }
        assert!(
            said.contains("ohm") && said.contains("inductance"),
            "{said}"
        );
        assert!(folder.read("motor.svg").contains("voltage, V"));
    }
}

#[test]
fn logs_that_do_not_tell_are_refused() {
    let folder = Folder::new();
    let mut sine = String::from("time,u,w,q,still\n");
    for k in 0..400 {
        let t = 0.02 * f64::from(k);
        let (w, v) = ((3.0 * t).sin(), 4.0 * (1.1 * t).sin());
        writeln!(
            sine,
            "{t},{},{w},{},0.5",
            v - 1.5 * w,
            -(3.0 * t).cos() / 3.0
        )
        .expect("a string takes all");
    }
    folder.write("sine.csv", &sine);
    let late: Vec<&str> = sine
        .lines()
        .enumerate()
        .filter(|(k, _)| !(50..80).contains(k))
        .map(|(_, line)| line)
        .collect();
    folder.write("gap.csv", &late.join("\n"));
    let mut twice: Vec<&str> = sine.lines().collect();
    twice.insert(10, twice[10]);
    folder.write("twice.csv", &twice.join("\n"));
    let said = |log: &str, more: &[&str]| {
        let current = [
            "calibrate",
            "back-emf",
            log,
            "--current",
            "u",
            "--json",
            "out.json",
        ];
        folder.refuse(&[&current[..], more].concat())
    };
    for motion in [["--velocity", "w"], ["--position", "q"]] {
        let none = said("sine.csv", &motion);
        assert!(
            none.contains("piecewise constant") && none.contains("log the voltage"),
            "{none}"
        );
        assert!(said("gap.csv", &motion).contains("gap.csv:51: a gap of 31.0 usual steps"));
        assert!(said("twice.csv", &motion).contains("twice.csv:12: time does not increase"));
    }
    assert!(said("sine.csv", &["--velocity", "still"]).contains("the velocity is constant"));
    let names = said("sine.csv", &["--velocity", "w", "--time", "t"]);
    assert!(names.contains("no column `t` for --time"), "{names}");
    let calibrate = ["calibrate", "back-emf", "sine.csv", "--current", "u"];
    for usage in [&[][..], &["--velocity", "w", "--position", "q"]] {
        assert_eq!(folder.run(&[&calibrate[..], usage].concat()).code, Some(2));
    }
}

/// Without a spec, columns that are named on the command line have the units of the file.
#[test]
fn calibrations_are_in_the_units_of_the_file() {
    let folder = Folder::new();
    let mut table = String::from("i,tau\n");
    for k in 0..12 {
        let current = 0.5 * f64::from(k);
        let torque = 0.11 * current + 0.001 * f64::from(k % 3);
        writeln!(table, "{current},{torque}").expect("a string takes all");
    }
    folder.write("si.csv", &table);
    let calibrate = |table: &str| {
        let columns = ["--current", "i", "--torque", "tau", "--json", "gain.json"];
        let run = folder.run(&[&["calibrate", "static", table][..], &columns].concat());
        assert_eq!(run.code, Some(0), "{}", run.stderr);
        let gain = json(&folder.read("gain.json"));
        (gain["gain"].as_f64().expect("a number"), run.stderr)
    };
    let (wanted, silent) = calibrate("si.csv");
    assert_eq!(silent, "");
    std::fs::create_dir(folder.path("mA")).expect("a folder");
    let rows = table.lines().skip(1).map(|row| {
        let (current, torque) = row.split_once(',').expect("two fields");
        format!(
            "{},{torque}\n",
            1e3 * current.parse::<f64>().expect("a number")
        )
    });
    folder.write(
        "mA/table.csv",
        &format!("i,tau\n{}", rows.collect::<String>()),
    );
    folder.write(
        "mA/robot-model.toml",
        "[log]\ntau = { columns = ['i'], unit = 'mA' }\n",
    );
    let (found, said) = calibrate("mA/table.csv");
    assert!((found - wanted).abs() < 1e-9, "{found} and {wanted}");
    assert!(
        said.contains("note: mA/robot-model.toml gives the unit of column `i`"),
        "{said}"
    );
    folder.write(
        "mA/robot-model.toml",
        "[log]\ntau = { columns = ['i'], unit = 'Nm' }\n",
    );
    let static_of = [
        "calibrate",
        "static",
        "mA/table.csv",
        "--current",
        "i",
        "--torque",
        "tau",
    ];
    let refused = folder.refuse(&static_of);
    assert!(
        refused.contains("expected a current, found a torque"),
        "{refused}"
    );
}
