//! Whether the commands that people are shown are commands: examples of the help texts, of the README and of the documentation.

use std::fs;
use std::path::Path;

use clap::{Command, CommandFactory, Parser};

use crate::CommandLine;

/// A command of all that are there, and all below it.
fn all(command: &Command) -> Vec<&Command> {
    let below = command.get_subcommands().flat_map(all);
    std::iter::once(command).chain(below).collect()
}

/// The command in a line that somebody would type, without its comment and where its output goes.
fn words(line: &str) -> Vec<String> {
    let words = shlex::split(line).unwrap_or_else(|| panic!("quotes are closed: {line}"));
    words.into_iter().take_while(|word| word != ">").collect()
}

fn assert_is_understood(line: &str, place: &str) {
    if let Err(error) = CommandLine::try_parse_from(words(line)) {
        panic!("{place}: {line}\n{error}");
    }
}

#[test]
fn examples_of_every_verb_are_understood() {
    let mut program = CommandLine::command().disable_help_subcommand(true);
    program.build();
    for command in all(&program) {
        let name = command
            .get_bin_name()
            .unwrap_or(command.get_name())
            .to_owned();
        let help = command.clone().render_long_help().to_string();
        let examples = help
            .split_once("Examples:\n")
            .unwrap_or_else(|| panic!("{name}: {help}"))
            .1;
        let examples: Vec<&str> = examples.lines().map(str::trim).collect();
        assert!(!examples.is_empty(), "{name}");
        for example in &examples {
            // Of the program any verb will do; of a verb, itself.
            assert!(
                example.starts_with(&format!("{name} ")) || *example == name,
                "{name}: {example}"
            );
            assert_is_understood(example, &name);
        }
    }
}

#[test]
fn commands_of_the_documentation_are_understood() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut pages = vec![root.join("README.md"), root.join("model-spec/LANGUAGE.md")];
    let mut folders = vec![root.join("docs")];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).expect("the folder of the documentation") {
            let path = entry.expect("a readable folder").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "md") {
                pages.push(path);
            }
        }
    }
    let mut checked = 0;
    for page in pages {
        let text = fs::read_to_string(&page).expect("a readable page");
        let mut lines = text.lines().enumerate();
        while let Some((number, line)) = lines.next() {
            let mut line = line.trim().to_owned();
            let is_command = line.starts_with("robot-model ") && !line.contains(" = {");
            if !is_command {
                continue;
            }
            // What goes on in the next line ends with a backslash.
            while let Some(start) = line.strip_suffix('\\') {
                let (_, more) = lines.next().expect("a line that goes on");
                line = format!("{start}{}", more.trim());
            }
            assert_is_understood(&line, &format!("{}:{}", page.display(), number + 1));
            checked += 1;
        }
    }
    assert!(checked > 20, "{checked} commands");
}
