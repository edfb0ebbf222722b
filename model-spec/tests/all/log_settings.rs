//! Columns of logs in a file beside the spec: the same as in its `log`.

use robot_model_spec::model::LogColumns;
use robot_model_spec::{ColumnKind, Model, load, log_column_unit, log_settings};

const SPEC: &str = "robot Gantry {
    gravity = [0, 0, -9.81];
    convention = standard_dh;
    joint rail: prismatic { a = 0; alpha = 90 deg; theta = 0; actuator_gain = 42 N/A; }
    joint swing: revolute { a = 0.4; alpha = 0; d = 0; actuator_gain = -0.11 Nm/A; }
    LOG
    effects { temperature_viscous on swing; }
}";

const BLOCK: &str = "log {
        time = \"stamp [ms]\": ms;
        q = \"rail/pos\": mm, \"swing/pos\": -360 deg/65536;
        dq = \"rail/vel\": 0.001, \"swing/vel\": rpm;
        tau = \"rail/current\": A, \"swing/current\": mA;
        temperature = \"motor temp\";
    }";

const FILE: &str = r#"
[log]
time = { column = "stamp [ms]", unit = "ms" }
q = [{ column = "rail/pos", unit = "mm" }, { unit = "-360 deg/65536", column = "swing/pos" }]
tau = { columns = ["rail/current", "swing/current"], unit = ["A", "mA"] }
temperature = "motor temp"

[log.dq]
columns = ['rail/vel', "swing/vel"]
unit = [1e-3, """rpm"""]
"#;

fn model(block: &str) -> Model {
    load("gantry.robot", &SPEC.replace("LOG", block)).unwrap_or_else(|errors| panic!("{errors}"))
}

fn columns(block: &str, file: &str) -> LogColumns {
    let settings = log_settings(&model(block), "robot-model.toml", file);
    settings.unwrap_or_else(|errors| panic!("{errors}")).columns
}

#[test]
fn a_file_says_what_a_block_says() {
    let mut wanted = model(BLOCK).log;
    wanted.line = None;
    assert_eq!(columns("", FILE), wanted);
    assert_eq!(wanted.all().count(), 8);
}

#[test]
fn a_unit_alone_is_that_of_the_standard_columns() {
    let told = columns(
        "",
        "[log]\ntime = { unit = 'ms' }\ndq = { unit = ['mm/s', 'rpm'] }",
    );
    let named = "[log]\ntime = { column = 'time', unit = 'ms' }\ndq = { columns = ['dq1', 'dq2'], unit = ['mm/s', 'rpm'] }";
    assert_eq!(told, columns("", named));
    let unit = |column| {
        let file = "[log]\ntau = { unit = 'mA' }\n";
        log_column_unit("robot-model.toml", file, column, ColumnKind::Current).expect("a unit")
    };
    assert_eq!((unit("tau2"), unit("i2")), (Some(1e-3), None));
    let listed = "[log]\ntau = { unit = ['mA', 'A'] }\ndq = { unit = ['mm/s', 'rpm'] }\n";
    let unit = |column| {
        log_column_unit("robot-model.toml", listed, column, ColumnKind::Current).expect("a unit")
    };
    assert_eq!((unit("tau2"), unit("i2")), (Some(1.0), None));
}

/// A unit that no joint has is one mistake, of however many joints.
#[test]
fn a_mistake_of_one_place_is_told_once() {
    let file = "[log]\nq = { unit = 'degr' }";
    let errors = log_settings(&model(""), "robot-model.toml", file).expect_err("no unit");
    assert_eq!(errors.len(), 1, "{errors}");
}

#[test]
fn channels_of_the_file_stand_in_place_of_those_of_the_spec_as_a_whole() {
    let spec = model(BLOCK);
    let merged = columns(
        BLOCK,
        "[log]\nq = ['a', 'b']\ntemperature = { column = 't', unit = 0.1 }",
    );
    assert_eq!((&merged.time, &merged.tau), (&spec.log.time, &spec.log.tau));
    let q: Vec<(&str, f64)> = merged
        .q
        .iter()
        .map(|own| (own.name.as_str(), own.unit))
        .collect();
    assert_eq!(q, [("a", 1.0), ("b", 1.0)]);
    let [(name, own)] = merged.inputs.as_slice() else {
        panic!("one input: {:?}", merged.inputs);
    };
    assert_eq!(
        (name.as_str(), own.name.as_str(), own.unit),
        ("temperature", "t", 0.1)
    );
    // What the spec had there is free for another channel.
    let swapped = columns(
        BLOCK,
        "[log]\nq = ['rail/vel', 'swing/vel']\ndq = ['rail/pos', 'swing/pos']",
    );
    assert_eq!(swapped.dq[0].name, "rail/pos");
}

#[test]
fn a_file_of_any_size_and_any_bytes_ends_in_an_answer() {
    let model = model("");
    let large = format!("# {}\n[log]\ntime = 't'\n", "x".repeat(70_000));
    let errors = log_settings(&model, "large.toml", &large).expect_err("large");
    assert!(errors.to_string().contains("too large"), "{errors}");
    // Cut everywhere, and with every byte exchanged.
    let mut refused = 0;
    for at in (0..FILE.len()).filter(|at| FILE.is_char_boundary(*at)) {
        refused += usize::from(log_settings(&model, "cut.toml", &FILE[..at]).is_err());
        for other in ["\"", "'", "[", "}", "=", "\n", "\u{e4}", "\\", "9", "\u{0}"] {
            let text = format!("{}{other}{}", &FILE[..at], &FILE[at + 1..]);
            if let Err(errors) = log_settings(&model, "changed.toml", &text) {
                refused += 1;
                assert!(errors.to_string().contains("--> changed.toml:"), "{errors}");
            }
        }
    }
    assert!(refused > 1000, "{refused} refused");
}

/// The reference says one mapping twice: in the spec's block, and in a file.
#[test]
fn the_references_file_is_the_references_block() {
    let reference = include_str!("../../LANGUAGE.md");
    let (_, logs) = reference.split_once("## Logs").expect("a section");
    let block = |from: &str, fence: &str| -> String {
        let (_, text) = from.split_once(fence).expect("a block");
        text.split_once("```").expect("its end").0.to_owned()
    };
    let spec = block(logs, "```text\n");
    let with = load("gantry.robot", &spec).unwrap_or_else(|errors| panic!("{errors}"));
    let start = spec.find("    log {").expect("a block");
    let end = start + spec[start..].find("    }\n").expect("its end") + 6;
    let without = format!("{}{}", &spec[..start], &spec[end..]);
    let without = load("gantry.robot", &without).unwrap_or_else(|errors| panic!("{errors}"));
    let mut wanted = with.log;
    wanted.line = None;
    let found = log_settings(&without, "robot-model.toml", &block(logs, "```toml\n"));
    let found = found.unwrap_or_else(|errors| panic!("{errors}"));
    assert_eq!(found.columns, wanted);
    assert_eq!(found.said, ["q", "tau", "temperature", "time"]);

    let readme = include_str!("../../../README.md");
    let (_, own) = readme
        .split_once("in a `robot-model.toml` beside the log")
        .expect("a section");
    let arm = SPEC.replace("LOG", "").replace(
        "prismatic { a = 0; alpha = 90 deg; theta = 0; actuator_gain = 42 N/A; }",
        "revolute { a = 0; alpha = 0; d = 0; actuator_gain = 0.11 Nm/A; }",
    );
    let arm = load("arm.robot", &arm).unwrap_or_else(|errors| panic!("{errors}"));
    let found = log_settings(&arm, "README.md", &block(own, "```toml\n"));
    let found = found.unwrap_or_else(|errors| panic!("{errors}"));
    assert_eq!(found.columns.all().count(), 7);
}
