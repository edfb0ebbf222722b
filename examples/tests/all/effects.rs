//! The pages of the effects are those of their definitions, and the commands on them work.

use std::fs;
use std::path::Path;
use std::process::ExitCode;

use robot_model_examples::effects::{COMMAND, contents, pages, partings};

const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/..");

/// Links that are known, so that effects of the load have something to be told from.
const ARM: &str = "robot Arm {
    gravity = [0, 0, -9.81];
    convention = standard_dh;
    joint base: revolute { a = 0; alpha = 90 deg; d = 0.3; position = -150 deg .. 150 deg; velocity = 2; acceleration = 10; }
    joint shoulder: revolute { a = 0.4; alpha = 0; d = 0; position = -150 deg .. 150 deg; velocity = 2; acceleration = 10; }
    joint elbow: revolute { a = 0.3; alpha = 90 deg; d = 0; position = -150 deg .. 150 deg; velocity = 2; acceleration = 10; }
    link base: fixed { mass = 4; com = [0, -0.1, 0]; inertia = [0.04, 0, 0, 0.02, 0, 0.04]; }
    link shoulder: fixed { mass = 3; com = [-0.2, 0, 0]; inertia = [0.01, 0, 0, 0.05, 0, 0.05]; }
    link elbow: fixed { mass = 2; com = [-0.1, 0, 0.05]; inertia = [0.01, 0, 0, 0.02, 0, 0.02]; }
    effects { viscous_friction on base, shoulder; coulomb_friction on base, shoulder; }
}
";

#[test]
fn pages_are_those_of_the_definitions() {
    let folder = Path::new(ROOT).join("docs/effects");
    let pages = pages();
    let mut old: Vec<String> = Vec::new();
    for (name, text) in &pages {
        let is_same = fs::read_to_string(folder.join(name)).is_ok_and(|page| page == *text);
        if !is_same {
            old.push(format!("docs/effects/{name}"));
        }
    }
    for entry in fs::read_dir(&folder).expect("docs/effects") {
        let name = entry.expect("an entry").file_name();
        if !pages.iter().any(|(page, _)| **page == *name) {
            old.push(format!("docs/effects/{}", name.display()));
        }
    }
    let summary = fs::read_to_string(Path::new(ROOT).join("book/src/SUMMARY.md"));
    let summary = summary.expect("the book's table of contents");
    if contents(&summary).as_ref() != Some(&summary) {
        old.push("book/src/SUMMARY.md".to_owned());
    }
    assert!(
        old.is_empty(),
        "of another library: {}; write them anew: {COMMAND}",
        old.join(", ")
    );
}

/// In a book, Markdown is read before the formulas are.
#[test]
fn formulas_come_through_markdown() {
    let pages = pages();
    let lines = pages.iter().flat_map(|(_, text)| text.lines());
    let formulas: Vec<&str> = lines.filter(|line| line.starts_with("$$")).collect();
    assert!(formulas.len() > pages.len(), "{}", formulas.len());
    for formula in formulas {
        assert!(formula.ends_with(" $$"), "{formula}");
        let mut open = 0_i32;
        for (here, next) in formula.chars().zip(formula.chars().skip(1)) {
            let is_escape = here == '\\' && next.is_ascii_punctuation();
            let is_emphasis = here == '*' || (here == '_' && !next.is_ascii_alphanumeric());
            assert!(!is_escape && !is_emphasis, "{here}{next} in {formula}");
            open += i32::from(here == '{') - i32::from(here == '}');
            assert!(open >= 0, "{formula}");
        }
        assert_eq!(open, 0, "{formula}");
        let count = |word: &str| formula.matches(word).count();
        assert_eq!(count("\\left"), count("\\right"), "{formula}");
        assert_eq!(count("\\begin{"), count("\\end{"), "{formula}");
    }
}

/// As a shell takes it.
fn words(command: &str) -> Vec<String> {
    let parts = command.split('\'').enumerate();
    let words = parts.flat_map(|(k, part)| match k % 2 {
        0 => part.split_whitespace().map(str::to_owned).collect(),
        _ => vec![part.to_owned()],
    });
    words.collect()
}

/// Every motion that a page designs is designed, and leaves of both effects a part that the other one and the arm cannot imitate.
#[test]
fn commands_part_what_looks_alike() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = |name: &str| folder.path().join(name).display().to_string();
    fs::write(path("arm.robot"), ARM).expect("a writable folder");
    let mut count = 0;
    for command in partings().iter().filter_map(|pair| pair.command().ok()) {
        let words = words(&command).into_iter();
        let here = |word: String| match word.as_str() {
            "arm.robot" | "next.csv" => path(&word),
            _ => word,
        };
        let few = ["--starts", "1", "--budget", "0.5", "--json"].map(str::to_owned);
        let code = robot_model_cli::run(
            words
                .map(here)
                .chain(few)
                .chain([path("worth.json")])
                .map(Into::into),
        );
        assert_eq!(code, ExitCode::SUCCESS, "{command}");
        let worth = fs::read_to_string(path("worth.json")).expect("what the motion is worth");
        let worth: serde_json::Value = serde_json::from_str(&worth).expect("JSON");
        let distances = worth["distances"].as_array();
        for distance in distances.unwrap_or_else(|| panic!("{command}: {worth}")) {
            let distance = distance.as_f64().expect("N m");
            assert!(distance > 0.05, "{command}: {distance}");
        }
        count += 1;
    }
    assert!(count > 20, "only {count} commands");
}
