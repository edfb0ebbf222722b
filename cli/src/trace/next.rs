//! What comes behind a trace: commands with the files of this one.

use std::path::{Path, PathBuf};

use robot_model::trace::Outcome;
use robot_model_spec::model::Model;

use super::TraceArguments;
use crate::close_the_loop::Loop;
use crate::output::path_word as word;
use crate::report::beside;

/// What follows the names of an amended spec and of a page's folder.
const AMENDED: &str = "-amended.robot";
const OF_FIT: &str = "fit";

/// Where the numbers of an arm go that the next command asks for.
const FIT: &str = "fit.json";

/// A motion that the next command designs.
const MOTION: &str = "next.csv";

/// What to do next, and the commands for it.
pub(super) struct Next {
    pub(super) what: String,
    pub(super) commands: Vec<String>,
}

impl TraceArguments {
    /// What comes next; none where the logs themselves are to be mended or read otherwise first, as the verdict says.
    pub(super) fn next(&self, closed: &Loop) -> Option<Next> {
        if closed.faults.iter().any(|fault| fault.is_last) || closed.reading.is_some() {
            return None;
        }
        let model = &closed.before.arm.compiled().model;
        match (closed.outcome(), &self.amend) {
            (Outcome::Explained, None) if closed.changed.is_some() => Some(Next {
                what: "This writes the spec with the effects declared:".to_owned(),
                commands: vec![self.trace_with_amended()],
            }),
            (Outcome::Explained, Some(amended)) if closed.changed.is_some() => Some(Next {
                what: "The amended spec is one like any other. These commands identify it, and check that its numbers are physically possible:".to_owned(),
                commands: vec![self.identify(amended), audit(amended)],
            }),
            (Outcome::NothingMissing, _) => Some(Next {
                what: format!(
                    "The spec is enough for these logs. These are its numbers, {}:",
                    uses(model)
                ),
                commands: [vec![self.identify(&self.spec)], self.handed_on(model)].concat(),
            }),
            (Outcome::Unexplained, _) => Some(self.another_motion(model)),
            // What is wrong with the logs is all that was found.
            _ => None,
        }
    }

    /// The words of a command that reads the same logs of a spec.
    fn on_the_logs(&self, verb: &str, spec: &Path) -> Vec<String> {
        let mut words = vec![format!("robot-model {verb}"), word(spec)];
        words.extend(self.logs.iter().map(|log| word(log)));
        if let Some(log) = &self.validate {
            words.extend(["--validate".to_owned(), word(log)]);
        }
        if let Some(file) = self.log_settings.given() {
            words.extend(["--log-settings".to_owned(), word(file)]);
        }
        words
    }

    fn trace_with_amended(&self) -> String {
        let mut words = self.on_the_logs("trace", &self.spec);
        words.extend(["--amend".to_owned(), word(&amended(&self.spec))]);
        if let Some(folder) = &self.report {
            words.extend(["--report".to_owned(), word(folder)]);
        }
        words.join(" ")
    }

    fn identify(&self, spec: &Path) -> String {
        let mut words = self.on_the_logs("identify", spec);
        words.extend(["--json".to_owned(), FIT.to_owned()]);
        if let Some(folder) = &self.report {
            words.extend(["--report".to_owned(), word(&beside(folder, OF_FIT))]);
        }
        words.join(" ")
    }

    /// The arm with its numbers, for controllers and for simulators.
    fn handed_on(&self, model: &Model) -> Vec<String> {
        let spec = word(&self.spec);
        let mut commands = vec![format!(
            "robot-model emit {spec} --lang rust --out . --parameters {FIT}"
        )];
        if model.chain().is_some() {
            commands.push(format!(
                "robot-model export {spec} --as urdf --parameters {FIT} -o identified.urdf"
            ));
        }
        commands
    }

    /// What is left follows the motion, so another motion tells more of it.
    fn another_motion(&self, model: &Model) -> Next {
        let mut joints = model.joints.iter();
        let unbound = joints.find(|joint| joint.limits.velocity.is_none());
        let first = unbound.map_or_else(String::new, |joint| {
            format!(
                ", after adding limits of `{}` and the other joints to the spec (`velocity = ..`)",
                joint.name
            )
        });
        Next {
            what: format!(
                "The section on structure says what it depends on. You can declare a law of your own for it in the spec, and another motion \
                 shows more of it: this designs one{first}. Drive it, log it, and trace both logs together:"
            ),
            commands: vec![format!(
                "robot-model excite {} --out {MOTION} --figure next.svg",
                word(&self.spec)
            )],
        }
    }
}

fn audit(spec: &Path) -> String {
    format!("robot-model audit {} --parameters {FIT}", word(spec))
}

fn uses(model: &Model) -> &'static str {
    if model.chain().is_some() {
        "and the arm with them for a controller and for a simulator"
    } else {
        "and the arm with them for a controller"
    }
}

/// `arm-amended.robot` beside `arm.robot`.
fn amended(spec: &Path) -> PathBuf {
    let mut name = spec.file_stem().unwrap_or_default().to_owned();
    name.push(AMENDED);
    spec.with_file_name(name)
}

#[cfg(test)]
mod tests {
    use clap::Parser;

    use super::*;
    use crate::CommandLine;
    use crate::close_the_loop::close;
    use crate::progress::Progress;
    use crate::trace::cart::{CART, log};

    #[derive(Parser)]
    struct Alone {
        #[command(flatten)]
        trace: TraceArguments,
    }

    /// The commands that come next, each of which the program understands.
    fn next(arguments: &str, closed: &Loop) -> (String, Vec<String>) {
        let words = shlex::split(arguments).expect("quotes are closed");
        let asked = Alone::try_parse_from(words).unwrap_or_else(|error| panic!("{error}"));
        let next = asked.trace.next(closed).expect("something comes next");
        for command in &next.commands {
            let words = shlex::split(command).expect("quotes are closed");
            let understood = CommandLine::try_parse_from(words);
            understood.unwrap_or_else(|error| panic!("{command}: {error}"));
        }
        (next.what, next.commands)
    }

    #[test]
    fn every_outcome_has_the_command_that_comes_next() {
        let mut closed = close("cart.robot", CART, &[log()], None, &Progress::silent())
            .unwrap_or_else(|error| panic!("{error}"));
        let (_, commands) = next(
            "trace arms/cart.robot 'my log.csv' --validate b.csv --report page",
            &closed,
        );
        assert_eq!(
            commands,
            [
                "robot-model trace arms/cart.robot 'my log.csv' --validate b.csv --amend arms/cart-amended.robot --report page"
            ]
        );
        let (_, commands) = next(
            "trace cart.robot a.csv --amend cart2.robot --report page --log-settings s.toml",
            &closed,
        );
        assert_eq!(
            commands,
            [
                "robot-model identify cart2.robot a.csv --log-settings s.toml --json fit.json --report page-fit",
                "robot-model audit cart2.robot --parameters fit.json"
            ]
        );

        closed.verdict.findings.clear();
        closed.changed = None;
        closed.verdict.outcome = Outcome::NothingMissing;
        let (_, commands) = next("trace cart.robot a.csv", &closed);
        assert_eq!(
            commands,
            [
                "robot-model identify cart.robot a.csv --json fit.json",
                "robot-model emit cart.robot --lang rust --out . --parameters fit.json",
                "robot-model export cart.robot --as urdf --parameters fit.json -o identified.urdf"
            ]
        );

        closed.verdict.outcome = Outcome::Unexplained;
        let (what, commands) = next("trace cart.robot a.csv --report page", &closed);
        assert_eq!(
            commands,
            ["robot-model excite cart.robot --out next.csv --figure next.svg"]
        );
        assert!(what.contains("after adding limits of `rail`"), "{what}");

        // How the logs are to be read comes before any command.
        closed.reading = Some("with positions in degrees ..".to_owned());
        let words = ["trace", "cart.robot", "a.csv"];
        let Ok(asked) = Alone::try_parse_from(words) else {
            panic!("a command");
        };
        assert!(asked.trace.next(&closed).is_none());
    }
}
