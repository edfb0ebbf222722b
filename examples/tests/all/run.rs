//! Every example runs; its assertions are its claims.

#[path = "../../examples/build_script.rs"]
mod build_script;
#[path = "../../examples/close_the_loop.rs"]
mod close_the_loop;
#[path = "../../examples/custom_effect.rs"]
mod custom_effect;
#[path = "../../examples/derive.rs"]
mod derive;
#[path = "../../examples/node.rs"]
mod node;
#[path = "../../examples/scalars.rs"]
mod scalars;

#[test]
fn build_script() {
    build_script::main();
}

#[test]
fn custom_effect() {
    custom_effect::main().unwrap_or_else(|error| panic!("{error}"));
}

#[test]
fn derive() {
    derive::main();
}

#[test]
fn node() {
    assert_eq!(node::main(), std::process::ExitCode::SUCCESS);
}

#[test]
fn scalars() {
    scalars::main();
}

/// What README.md shows of lanes and slopes are lines of the example, which is compiled.
#[test]
fn readme_shows_the_example() {
    let example: Vec<String> = lines(include_str!("../../examples/scalars.rs")).collect();
    let readme = include_str!("../../../README.md");
    let blocks = readme.split("```rust,ignore\n").skip(1);
    let mut blocks = blocks.filter_map(|rest| Some(rest.split_once("\n```")?.0));
    let shown = blocks.find(|block| block.contains("Dual::variable"));
    for line in lines(shown.expect("README.md shows dual numbers")) {
        assert!(example.contains(&line), "{line}");
    }
}

/// Wherever their comments stand.
fn lines(text: &str) -> impl Iterator<Item = String> {
    let words = |line: &str| line.split_whitespace().collect::<Vec<_>>().join(" ");
    text.lines().map(words)
}

#[test]
fn close_the_loop() {
    close_the_loop::main().unwrap_or_else(|error| panic!("{error}"));
}
