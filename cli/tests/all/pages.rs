//! The C of README.md and docs/c.md, as it is shown: with their specs and parameter files, compiled without a warning, and run.

use std::path::{Path, PathBuf};
use std::process::Command;

const README: &str = include_str!("../../../README.md");
const C: &str = include_str!("../../../docs/c.md");

/// The first block of a language on a page that has these words.
fn block<'a>(page: &'a str, language: &str, words: &str) -> &'a str {
    let fence = format!("```{language}\n");
    let mut blocks = page.split(&fence).skip(1);
    let block = blocks.find_map(|rest| {
        let (block, _) = rest.split_once("\n```")?;
        block.contains(words).then_some(block)
    });
    block.unwrap_or_else(|| panic!("a block of {language} with `{words}`"))
}

/// The C compiler; where there is none, says what is therefore not tested.
fn compiler() -> Option<PathBuf> {
    let name = std::env::var_os("CC").unwrap_or("cc".into());
    let is_there = Command::new(&name).arg("--version").output().is_ok();
    if !is_there {
        eprintln!("absent: a C compiler, so this run does not test the C of the pages");
    }
    is_there.then(|| name.into())
}

fn run(program: &Path, arguments: &[&str], folder: &Path) -> String {
    let output = Command::new(program)
        .args(arguments)
        .current_dir(folder)
        .output()
        .unwrap_or_else(|error| panic!("{}: {error}", program.display()));
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{arguments:?}: {said}");
    assert_eq!(said, "", "{arguments:?}");
    String::from_utf8(output.stdout).expect("text")
}

/// Emits a spec with the options, and runs the program that is shown with it.
fn shown(
    spec: &str,
    program: &str,
    name: &str,
    files: &[(&str, &str)],
    options: &[&str],
) -> String {
    let Some(cc) = compiler() else {
        return String::new();
    };
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    for (name, text) in [("arm.robot", spec), ("main.c", program)]
        .iter()
        .chain(files)
    {
        std::fs::write(folder.join(name), text).expect("a writable folder");
    }
    let emit = ["emit", "arm.robot", "--lang", "c", "--out", "."];
    let robot_model = Path::new(env!("CARGO_BIN_EXE_robot-model"));
    let _ = run(robot_model, &[&emit[..], options].concat(), folder);
    let source = format!("{name}.c");
    let flags = [
        "-std=c99",
        "-Wall",
        "-Wextra",
        "-Wpedantic",
        "-Werror",
        "-o",
        "main",
    ];
    let _ = run(
        &cc,
        &[&flags[..], &["main.c", &source, "-lm"]].concat(),
        folder,
    );
    run(&folder.join("main"), &[], folder)
}

/// Two point masses: `M[0][0] = m1 l1^2 + m2 (l1^2 + l2^2 + 2 l1 l2 cos)`, the moment of their weights, and rest.
#[test]
fn the_readme_runs() {
    let spec = block(README, "text", "robot TwoLink");
    let program = block(README, "c", "int main");
    let said = shown(spec, program, "two_link", &[], &[]);
    let (first, second) = (0.4_f64, 0.4 - 0.8 + std::f64::consts::FRAC_PI_2);
    let between = (second - first).cos();
    let inertia = 2.0 * 0.25 + 0.25 + 0.16 + 2.0 * 0.5 * 0.4 * between;
    let weight = 9.81 * (3.0 * 0.5 * first.cos() + 0.4 * second.cos());
    let wanted = format!(
        "M[0][0] = {inertia:.3} kg m^2, tau[0] = {weight:.3} N m, ddq[0] = 0.000 rad/s^2\n"
    );
    assert!(said.is_empty() || said == wanted, "{said}{wanted}");
}

/// Held by its bristles: `fc z` is the torque. Pulled slowly the joint is at `-d g ln(1 - z / g)` then, with `g = 1 + rise`;
/// a torque that is there at once carries it further, and not to where it slides.
#[test]
fn the_loop_with_a_memory_runs() {
    let spec = block(C, "text", "robot Wrist");
    let program = block(C, "c", "wrist_memory_after");
    let parameters = block(C, "json", "lugre");
    let files = [("wrist.json", parameters)];
    let options = ["--parameters", "wrist.json"];
    let said = shown(spec, program, "wrist", &files, &options);
    if said.is_empty() {
        return;
    }
    let angle = said
        .strip_prefix("it sticks at ")
        .and_then(|rest| rest.strip_suffix(" rad\n"));
    let angle: f64 = angle
        .and_then(|angle| angle.parse().ok())
        .expect("an angle");
    let (deflection, steady) = (0.3 / 0.4, 1.3);
    let slow = -0.002 * steady * (1.0_f64 - deflection / steady).ln();
    assert!(angle > slow && angle < 2.0 * slow, "{angle} {slow}");
}
