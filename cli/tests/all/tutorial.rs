//! docs/tutorial.md as its reader goes through it: every command, in order, in an empty folder, and what the page says of the results.

use std::fs;
use std::path::Path;
use std::process::Command;

use serde_json::Value;

const PAGE: &str = include_str!("../../../docs/tutorial.md");

/// The blocks of a language, in their order.
fn blocks(language: &str) -> impl Iterator<Item = &'static str> {
    let blocks = PAGE.split("```").skip(1).step_by(2);
    blocks.filter_map(move |block| block.strip_prefix(language)?.strip_prefix('\n'))
}

/// What the commands of a block print, run by a shell that finds this program.
fn run(block: &str, folder: &Path) -> String {
    let program = Path::new(env!("CARGO_BIN_EXE_robot-model"));
    let mut paths = vec![program.parent().expect("a folder").to_path_buf()];
    paths.extend(std::env::split_paths(
        &std::env::var_os("PATH").expect("a PATH"),
    ));
    let output = Command::new("sh")
        .args(["-e", "-c", block])
        .current_dir(folder)
        .env("PATH", std::env::join_paths(paths).expect("a PATH"))
        .output()
        .expect("a shell");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{block}\n{said}");
    String::from_utf8(output.stdout).expect("text")
}

fn json(folder: &Path, name: &str) -> Value {
    let text = fs::read_to_string(folder.join(name)).unwrap_or_else(|error| panic!("{error}"));
    serde_json::from_str(&text).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// A line without its numbers, and these.
fn shape(line: &str) -> (String, Vec<f64>) {
    let mut numbers = Vec::new();
    let mut shape = |word: &str| {
        let digits = word.trim_matches(|c: char| !c.is_ascii_digit());
        match digits.parse::<f64>() {
            Ok(number) => {
                numbers.push(number);
                word.replace(digits, "#")
            }
            Err(_) => word.to_owned(),
        }
    };
    let words: Vec<String> = line.split_whitespace().map(&mut shape).collect();
    (words.join(" "), numbers)
}

/// What may differ between numbers of the page and of a run: last digits follow the rounding of the machine.
const ROUNDING: f64 = 0.02;

/// Whether lines say the same.
fn is_same(printed: &(String, Vec<f64>), shown: &(String, Vec<f64>)) -> bool {
    let near = |(one, other): (&f64, &f64)| (one - other).abs() <= ROUNDING * other.abs();
    printed.0 == shown.0 && printed.1.iter().zip(&shown.1).all(near)
}

/// Blocks that show what a command prints.
fn shown() -> impl Iterator<Item = &'static str> {
    blocks("text").filter(|block| !block.contains("log {"))
}

/// The base parameter of a result by its name.
fn parameter(fit: &Value, name: &str) -> f64 {
    let parameters = fit["parameters"].as_array().expect("parameters");
    let found = parameters.iter().find(|one| one["name"] == name);
    let found = found.unwrap_or_else(|| panic!("no {name}"));
    found["value"].as_f64().expect("a number")
}

#[test]
fn a_reader_gets_what_the_page_says() {
    if Command::new("sh")
        .args(["-c", "sed --version || :"])
        .output()
        .is_err()
    {
        eprintln!("absent: a shell, so this run does not test docs/tutorial.md");
        return;
    }
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    let printed: String = blocks("sh").map(|block| run(block, folder)).collect();
    let lines: Vec<(String, Vec<f64>)> = printed.lines().map(shape).collect();
    let mut count = 0;
    for line in shown().flat_map(str::lines) {
        let shown = shape(line);
        let is_printed = lines.iter().any(|printed| is_same(printed, &shown));
        assert!(is_printed, "nothing prints: {line}\n{printed}");
        count += 1;
    }
    assert!(count > 20, "{count} lines of results on the page");

    let trace = json(folder, "trace.json");
    assert_eq!(trace["outcome"], "explained");
    let effects = trace["effects"].as_array().expect("effects");
    let names: Vec<(&Value, &Value)> = effects
        .iter()
        .map(|effect| (&effect["effect"], &effect["joint"]))
        .collect();
    assert_eq!(names, [(&"load_dependent_friction".into(), &2.into())]);
    let fall = |joint: usize| {
        let error = |key: &str| trace[key][joint].as_f64().expect("an error");
        error("relative_percent_after") / error("relative_percent_before")
    };
    assert!(fall(1) < 0.15, "{}", fall(1));
    assert!(fall(0) < 1.1 && fall(2) < 1.1);

    let spec = fs::read_to_string(folder.join("arm2.robot")).expect("the amended spec");
    assert!(spec.contains("load_dependent_friction on shoulder;"));
    let report = fs::read_to_string(folder.join("page/index.html")).expect("the report");
    assert!(report.contains("load-dependent-friction") && report.contains("<svg"));
    let mu = parameter(
        &json(folder, "fit.json"),
        "shoulder.load_dependent_friction.mu",
    );
    assert!((mu - 0.12).abs() < 0.004, "{mu}");
    for file in [
        "motion.svg",
        "src/arm2.rs",
        "src/reach.c",
        "src/reach.h",
        "identified.urdf",
        "identified.xml",
    ] {
        assert!(folder.join(file).exists(), "{file}");
    }
    // Friction that grows with the load is no delay.
    let _ = run(
        "robot-model identify arm.robot tuesday.csv --json alone.json",
        folder,
    );
    let notes = json(folder, "alone.json")["notes"].to_string();
    assert!(!notes.contains("against the position"), "{notes}");
    own_log(folder);
}

/// The log in the units and under the names of the page's `log` block, or of its `robot-model.toml`, is the same log.
fn own_log(folder: &Path) {
    let block = blocks("text").find(|block| block.contains("log {"));
    let block = block
        .expect("a log block")
        .split_once("..\n")
        .expect("a gap");
    let (_, log) = block;
    let spec = fs::read_to_string(folder.join("arm.robot")).expect("the spec");
    let gains = spec.replace("link = ", "actuator_gain = 10 Nm/A; link = ");
    let own = gains.replace("    effects {", &format!("{log}\n    effects {{"));
    for (name, spec) in [("own.robot", own), ("gains.robot", gains)] {
        fs::write(folder.join(name), spec).expect("a writable folder");
    }

    let mut own = String::from(
        "t [ms],base.pos,shoulder.pos,elbow.pos,base.current,shoulder.current,elbow.current\n",
    );
    let rows = fs::read_to_string(folder.join("monday.csv")).expect("the log");
    for row in rows.lines().skip(1) {
        let row: Vec<f64> = row
            .split(',')
            .map(|cell| cell.parse().expect("a number"))
            .collect();
        let positions = row[1..4].iter().map(|q| q.to_degrees());
        let currents = row[7..10].iter().map(|tau| tau / 10.0);
        let cells: Vec<String> = [row[0] * 1000.0]
            .into_iter()
            .chain(positions)
            .chain(currents)
            .map(|cell| cell.to_string())
            .collect();
        own.push_str(&cells.join(","));
        own.push('\n');
    }
    fs::write(folder.join("own.csv"), own).expect("a writable folder");
    is_as_first(folder, "own.robot");
    let settings = blocks("toml").next().expect("a `robot-model.toml`");
    fs::write(folder.join("robot-model.toml"), settings).expect("a writable folder");
    is_as_first(folder, "gains.robot");
}

/// What `own.csv` tells by a spec is what the log in standard columns told.
fn is_as_first(folder: &Path, spec: &str) {
    let _ = run(
        &format!("robot-model identify {spec} own.csv --json own.json"),
        folder,
    );
    let (own, first) = (json(folder, "own.json"), json(folder, "first.json"));
    for name in ["fore.mz", "elbow.viscous_friction.fv"] {
        let (own, first) = (parameter(&own, name), parameter(&first, name));
        assert!(
            (own - first).abs() < 1e-6 * first.abs(),
            "{spec}, {name}: {own} {first}"
        );
    }
}
