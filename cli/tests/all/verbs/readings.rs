//! Logs in another unit or order than the spec's, where no limit of a joint tells it.

use std::fmt::Write;

use crate::verbs::common::{Folder, json, two_joints_waving};
use crate::verbs::payload::spec;

const SPEC: &str = "robot P {
    gravity = [0, -9.81, 0];
    convention = standard_dh;
    joint turn: revolute { a = 0.5; alpha = 0; d = 0; }
    LOG
}";

/// A pendulum that swings by 20 degrees; `unit` is what one of the logged positions is worth, rad.
fn log(unit: f64) -> String {
    swinging(unit, 1.0)
}

/// One that swings so many times as far.
fn swinging(unit: f64, times: f64) -> String {
    let mut log = String::from("time,q1,tau1\n");
    for k in 0..4000 {
        let t = f64::from(k) / 200.0;
        let swing = |a: f64, w: f64| {
            let a = times * a;
            (a * (w * t).sin(), -a * w * w * (w * t).sin())
        };
        let ((q, ddq), (more, faster)) = (swing(0.25, 1.7), swing(0.1, 4.3));
        let tau = 0.3 * (ddq + faster) + 2.0 * (q + more).sin();
        writeln!(log, "{t},{},{tau}", (q + more) / unit).expect("a string takes all");
    }
    log
}

#[test]
fn degrees_within_all_limits_are_told_by_the_torques() {
    const ASKED: &str = "are they in degrees? Logs are in rad";
    let folder = Folder::new();
    let declared = SPEC.replace("LOG", "log { q = \"q1\": deg; }");
    folder.write("plain.robot", &SPEC.replace("LOG", ""));
    folder.write("declared.robot", &declared);
    folder.write("degrees.csv", &log(1.0_f64.to_radians()));
    folder.write("radians.csv", &log(1.0));
    let told = |spec: &str, log: &str| {
        let said = folder.run(&["identify", spec, log, "--json", "fit.json"]);
        // A program that goes on from the result sees it, too.
        let notes = json(&folder.read("fit.json"))["notes"].clone();
        let notes = notes.as_array().expect("a list").iter();
        let is_noted = notes
            .filter_map(|note| note.as_str())
            .any(|note| note.contains(ASKED));
        assert_eq!(is_noted, said.stderr.contains(ASKED));
        // It is no note among others.
        let warned = said.stderr.lines().filter(|line| line.contains(ASKED));
        assert!(warned.into_iter().all(|line| line.starts_with("warning: ")));
        is_noted
    };
    assert!(told("plain.robot", "degrees.csv"));
    assert!(!told("declared.robot", "degrees.csv"));
    assert!(!told("plain.robot", "radians.csv"));
    // Before anything is simulated.
    let simulated = ["degrees.csv", "--method", "output-error"];
    let run = folder.run(&[&["identify", "plain.robot"], &simulated[..]].concat());
    assert!(run.stderr.contains(ASKED), "{}", run.stderr);
}

#[test]
fn revolutions_are_told_by_the_torques() {
    let folder = Folder::new();
    folder.write("plain.robot", &SPEC.replace("LOG", ""));
    let declared = SPEC.replace("LOG", "log { q = \"q1\": rev; }");
    folder.write("declared.robot", &declared);
    folder.write("turns.csv", &swinging(std::f64::consts::TAU, 5.0));
    folder.write("radians.csv", &swinging(1.0, 5.0));
    let told = |spec: &str, log: &str| {
        let said = folder.run(&["identify", spec, log]).stderr;
        said.contains("are they in revolutions? Logs are in rad")
    };
    assert!(told("plain.robot", "turns.csv"));
    assert!(!told("declared.robot", "turns.csv"));
    assert!(!told("plain.robot", "radians.csv"));
}

/// A spec that has a unit, and a log in another one.
#[test]
fn a_log_in_radians_is_told_where_the_spec_has_another_unit() {
    let folder = Folder::new();
    folder.write("radians.csv", &swinging(1.0, 5.0));
    for (unit, plural) in [("deg", "degrees"), ("rev", "revolutions")] {
        let declared = format!("log {{ q = \"q1\": {unit}; }}");
        folder.write("declared.robot", &SPEC.replace("LOG", &declared));
        let said = folder.run(&["identify", "declared.robot", "radians.csv"]);
        let asked = format!(
            "are they in radians? The spec, a robot-model.toml or a line of units says {plural}; write `log {{ q = \"q1\": rad, ..; }}`, \
             or `unit = \"rad\"` in the settings"
        );
        assert!(said.stderr.contains(&asked), "{}", said.stderr);
    }
}

/// An arm of three joints with friction; of its links the spec knows nothing, or all.
pub(crate) fn three_joints(links: &str) -> String {
    format!(
        "robot A {{
            gravity = [0, 0, -9.81];
            convention = standard_dh;
            joint turn: revolute {{ a = 0; alpha = 90 deg; d = 0.4; }}
            joint lift: revolute {{ a = 0.5; alpha = 0; d = 0; }}
            joint bend: revolute {{ a = 0.4; alpha = 0; d = 0; }}
            {links}
            effects {{ viscous_friction on all; coulomb_friction on all; }}
        }}"
    )
}

const BODIES: &str = "
    link turn: fixed { mass = 4; com = [0, -0.1, 0.02]; inertia = [0.02, 0, 0, 0.01, 0, 0.02]; }
    link lift: fixed { mass = 3; com = [-0.25, 0.02, 0]; inertia = [0.005, 0, 0, 0.06, 0, 0.06]; }
    link bend: fixed { mass = 1.5; com = [-0.2, 0, 0.03]; inertia = [0.002, 0, 0, 0.02, 0, 0.02]; }";

/// `arm.robot`, and the header and the rows of a log of it.
pub(crate) fn moved(folder: &Folder) -> (String, String) {
    folder.write("true.robot", &three_joints(BODIES));
    folder.write("arm.robot", &three_joints(""));
    let friction = ["turn", "lift", "bend"].map(|joint| {
        format!("\"{joint}.viscous_friction.fv\": 0.6, \"{joint}.coulomb_friction.fc\": 0.8")
    });
    let parameters = format!("{{{}}}", friction.join(", "));
    folder.write("true.json", &parameters);
    let mut wanted = String::from("time,q1,q2,q3\n");
    for k in 0..=4000 {
        let t = f64::from(k) / 200.0;
        let q = [(0.9, 1.9, 0.3), (0.7, 2.7, 1.1), (0.8, 3.7, 2.0)]
            .map(|(a, w, phase)| a * ((w * t + phase).sin() + 0.5 * (0.43 * w * t).sin()));
        writeln!(wanted, "{t},{},{},{}", q[0], q[1], q[2]).expect("a string takes all");
    }
    folder.write("wanted.csv", &wanted);
    let simulate = ["simulate", "true.robot", "--parameters", "true.json"];
    let motion = ["--trajectory", "wanted.csv", "--out", "log.csv"];
    let noise = ["--torque-noise", "0.05", "--seed", "1"];
    folder.succeed(&[&simulate[..], &motion, &noise].concat());
    let log = folder.read("log.csv");
    let (header, rows) = log.split_once('\n').expect("a header");
    (header.to_owned(), rows.to_owned())
}

/// Names of columns that stand for others, all at once.
fn renamed(header: &str, names: &[(&str, &str)]) -> String {
    let columns = header.split(',').map(|column| {
        let new = names.iter().find(|(old, _)| *old == column);
        new.map_or(column, |(_, new)| *new)
    });
    columns.collect::<Vec<_>>().join(",")
}

#[test]
fn columns_in_another_order_are_told_by_the_torques() {
    let folder = Folder::new();
    let (header, rows) = moved(&folder);
    let said = |names: &[(&str, &str)]| {
        let log = format!("{}\n{rows}", renamed(&header, names));
        folder.write("other.csv", &log);
        folder.run(&["identify", "arm.robot", "other.csv"]).stderr
    };
    let exchanged = said(&[("tau1", "tau2"), ("tau2", "tau1")]);
    let told = "with the torques of `turn` and `lift` swapped the residual is";
    assert!(exchanged.contains(told), "{exchanged}");
    // Beside a torque of another joint no position is late.
    assert!(!exchanged.contains(" late against"), "{exchanged}");
    let around = said(&[("tau1", "tau2"), ("tau2", "tau3"), ("tau3", "tau1")]);
    // The spec's first joint has what is called `tau2`.
    let told = "with the torques in the order `lift`, `bend`, `turn` the residual is";
    assert!(around.contains(told), "{around}");
    let moved = [("q2", "q3"), ("q3", "q2"), ("dq2", "dq3"), ("dq3", "dq2")];
    let positions = said(&moved);
    let told = "with the positions of `lift` and `bend` swapped the residual is";
    assert!(positions.contains(told), "{positions}");
    let torques = [("tau2", "tau3"), ("tau3", "tau2")];
    let both = said(&[&moved[..], &torques].concat());
    let told = "with positions and torques of `lift` and `bend` swapped the residual is";
    assert!(both.contains(told), "{both}");
    let right = said(&[]);
    assert!(!right.contains("the residual is"), "{right}");
}

/// A log without velocities, and with a column that is another multiple of what it was.
fn scaled(header: &str, rows: &str, column: &str, factor: f64) -> String {
    let own = header.split(',').position(|name| name == column);
    let names = [("dq1", "a"), ("dq2", "b"), ("dq3", "c")];
    let mut log = format!("{}\n", renamed(header, &names));
    for row in rows.lines() {
        let fields = row.split(',').enumerate().map(|(k, field)| {
            let value: f64 = field.parse().expect("a number");
            let value = if Some(k) == own {
                factor * value
            } else {
                value
            };
            value.to_string()
        });
        let fields: Vec<String> = fields.collect();
        writeln!(log, "{}", fields.join(",")).expect("a string takes all");
    }
    log
}

#[test]
fn one_joint_in_degrees_or_of_the_other_sign_is_told_by_the_torques() {
    let folder = Folder::new();
    let (header, rows) = moved(&folder);
    let degree = 1.0_f64.to_degrees();
    for (column, factor, told, way_out) in [
        (
            "q2",
            degree,
            "position of `lift` in degrees",
            "q = \"q2\": deg",
        ),
        (
            "q2",
            -1.0,
            "position of `lift` with the opposite sign",
            "q = \"q2\": -1 rad",
        ),
        (
            "tau3",
            -1.0,
            "torque of `bend` with the opposite sign",
            "tau = \"tau3\": -1 Nm",
        ),
    ] {
        folder.write("other.csv", &scaled(&header, &rows, column, factor));
        let said = folder.run(&["identify", "arm.robot", "other.csv"]).stderr;
        let told = format!("with the {told} the residual is");
        assert!(said.contains(&told) && said.contains(way_out), "{said}");
    }
}

/// The torque of one of two joints the other way round is that of the other, with an arm of negative friction and links.
#[test]
fn a_torque_is_the_other_way_round_where_the_arm_is_possible() {
    let folder = crate::verbs::payload::folder("");
    let log = folder.read("empty.csv");
    let (header, rows) = log.split_once('\n').expect("a header");
    for (column, joint) in [("tau1", "up"), ("tau2", "lo")] {
        folder.write("other.csv", &scaled(header, rows, column, -1.0));
        let said = folder.run(&["identify", "arm.robot", "other.csv"]).stderr;
        let told = format!("with the torque of `{joint}` with the opposite sign the residual is");
        assert!(said.contains(&told), "{said}");
    }
}

/// The way out that is told leads out.
#[test]
fn a_column_that_the_spec_turns_is_that_of_the_joint() {
    let folder = Folder::new();
    let (header, rows) = moved(&folder);
    folder.write("other.csv", &scaled(&header, &rows, "q2", -1.0));
    let turned = "log { q = \"q1\": rad, \"q2\": -1 rad, \"q3\": rad; }";
    let spec = three_joints("");
    let (spec, end) = spec.rsplit_once('}').expect("an end");
    folder.write("turned.robot", &format!("{spec}{turned}}}{end}"));
    let said = folder
        .run(&["identify", "turned.robot", "other.csv"])
        .stderr;
    assert!(
        !said.contains("the residual is") && !said.contains("error"),
        "{said}"
    );
}

#[test]
fn accelerations_of_a_coarse_encoder_are_told() {
    let folder = Folder::new();
    folder.write("plain.robot", &SPEC.replace("LOG", ""));
    // 10 bits a turn, or 20.
    let coarse = |bits: i32| {
        let step = std::f64::consts::TAU / f64::powi(2.0, bits);
        let fine = log(1.0);
        let rows = fine.lines().enumerate().map(|(k, row)| {
            let fields: Vec<&str> = row.split(',').collect();
            if k == 0 {
                return row.to_owned();
            }
            let q: f64 = fields[1].parse().expect("a number");
            format!("{},{},{}", fields[0], (q / step).round() * step, fields[2])
        });
        rows.collect::<Vec<_>>().join("\n") + "\n"
    };
    folder.write("coarse.csv", &coarse(10));
    folder.write("fine.csv", &coarse(20));
    let said = |log: &str| folder.run(&["identify", "plain.robot", log]).stderr;
    let told = "accelerations are largely position noise";
    let coarse = said("coarse.csv");
    assert!(
        coarse.contains(told) && coarse.contains("`turn` "),
        "{coarse}"
    );
    assert!(!said("fine.csv").contains(told));
    // Instruments have no noise of an encoder.
    let fine = log(1.0);
    let motion = fine
        .lines()
        .map(|row| row.rsplit_once(',').expect("a torque").0);
    folder.write(
        "motion.csv",
        &(motion.collect::<Vec<_>>().join("\n") + "\n"),
    );
    let identify = ["identify", "plain.robot", "coarse.csv"];
    let iv = ["--method", "iv", "--instruments", "motion.csv"];
    let run = folder.run(&[&identify[..], &iv].concat());
    assert!(
        run.code == Some(0) && !run.stderr.contains(told),
        "{}",
        run.stderr
    );
}

/// Gravity of links of negative weight makes up for most of a torque that is the other way round, and what friction leaves of the light joint is
/// there in either reading.
#[test]
fn a_torque_of_the_other_sign_is_told_where_the_arm_fits_all_the_same() {
    let folder = Folder::new();
    folder.write("arm.robot", &spec(""));
    folder.write(
        "values.json",
        r#"{"up.viscous_friction.fv": 1.0, "lo.viscous_friction.fv": 0.5, "up.coulomb_friction.fc": 1.5, "lo.coulomb_friction.fc": 0.7}"#,
    );
    folder.write(
        "wanted.csv",
        &two_joints_waving(5000, 0.4, &[0.9, 1.4, 2.2]),
    );
    let simulate = ["simulate", "arm.robot", "--parameters", "values.json"];
    let motion = ["--trajectory", "wanted.csv", "--rate", "500"];
    let sensors = [
        "--torque-noise",
        "0.02",
        "--encoder-bits",
        "14",
        "--seed",
        "1",
    ];
    folder.succeed(&[&simulate[..], &motion, &sensors, &["--out", "log.csv"]].concat());
    let log = folder.read("log.csv");
    let (header, rows) = log.split_once('\n').expect("a header");
    folder.write("other.csv", &scaled(header, rows, "tau2", -1.0));
    let said = |log: &str| folder.run(&["identify", "arm.robot", log]).stderr;
    let asked = "with the torque of `lo` with the opposite sign";
    assert!(said("other.csv").contains(asked), "{}", said("other.csv"));
    assert!(!said("log.csv").contains(asked), "{}", said("log.csv"));
}
