//! The pages of the standard effects, written from their definitions: `docs/effects`, and its list in the book.

mod page;
mod parting;

use std::fmt::Write as _;

use robot_model::columns::Candidate;
use robot_model_cli::interpreted::{InterpretedArm, is_tried};
use robot_model_codegen::compile_model;
use robot_model_spec::model::{Act, EffectDefinition};
use robot_model_spec::standard_effects;

use page::page;
pub use parting::{Parting, partings};

/// The place of the list in the book's table of contents.
const LIST: &str = "- [Effects](docs/effects/README.md)\n";

/// How the pages are written anew.
pub const COMMAND: &str = "cargo run -p robot-model-examples --bin effects";

/// Every page by the name of its file in `docs/effects`.
#[must_use]
pub fn pages() -> Vec<(String, String)> {
    let effects = standard_effects();
    let own = effects
        .iter()
        .map(|effect| (format!("{}.md", effect.name), page(effect)));
    own.chain([("README.md".to_owned(), index())]).collect()
}

/// The table of contents of the book with the effects that there are; `None` where it has no place for them.
#[must_use]
pub fn contents(summary: &str) -> Option<String> {
    let (before, after) = summary.split_once(LIST)?;
    let is_own =
        |line: &str| line.trim_start().starts_with("- [") && line.contains("(docs/effects/");
    let rest = after.lines().skip_while(|line| is_own(line));
    let mut text = format!("{before}{LIST}");
    for effect in standard_effects() {
        let name = &effect.name;
        writeln!(text, "    - [{}](docs/effects/{name}.md)", title(effect))
            .expect("a string takes all");
    }
    for line in rest {
        writeln!(text, "{line}").expect("a string takes all");
    }
    Some(text)
}

/// Its name in words.
fn title(effect: &EffectDefinition) -> String {
    const NAMES: [(&str, &str); 2] = [("lugre", "LuGre"), ("coulomb", "Coulomb")];
    let words = effect.name.split('_').map(|word| {
        let name = NAMES.iter().find(|(plain, _)| *plain == word);
        name.map_or(word, |(_, written)| written)
    });
    page::capital(&words.collect::<Vec<_>>().join(" "))
}

/// What reports and JSON call it.
fn traced(effect: &EffectDefinition) -> String {
    if effect.acts.is_empty() && is_tried(effect) && !is_candidate(effect) {
        "not tried: a case of another law, which is".to_owned()
    } else if is_tried(effect) {
        let [name, kind] = [&effect.name, &effect.kind].map(|one| one.replace('_', "-"));
        if name == kind {
            format!("`{name}`")
        } else {
            format!("`{name}`, of the kind `{kind}`")
        }
    } else {
        "not tried: a sum of other laws, which are".to_owned()
    }
}

/// Whether a law of torques is tried by itself, on an arm that declares nothing.
fn is_candidate(effect: &EffectDefinition) -> bool {
    const ARM: &str = "robot Arm {
        gravity = [0, 0, -9.81];
        convention = standard_dh;
        joint shoulder: revolute { a = 0.5; alpha = 0; d = 0; }
        joint elbow: revolute { a = 0.4; alpha = 90 deg; d = 0; }
        joint wrist: revolute { a = 0; alpha = 0; d = 0.1; }
    }";
    let model = robot_model_spec::load("arm.robot", ARM).expect("a sound spec");
    let candidates = InterpretedArm::new(compile_model(&model)).candidates();
    let mut names = candidates.iter().map(Candidate::effect);
    names.any(|name| name == effect.name)
}

/// What it does to the torque, in a word for a table.
fn means(effect: &EffectDefinition) -> &'static str {
    let acts = effect.acts.first().map(|act| match act {
        Act::Force { .. } => "a force on a link",
        Act::Body { .. } => "a body on a link",
        Act::Position { .. } => "a link that is not where the log has its joint",
        Act::Tilt { .. } => "another direction of gravity",
        Act::Delay { .. } => "a shift in time",
        _ => "a change of the arm",
    });
    acts.unwrap_or("a torque")
}

fn index() -> String {
    let mut text = String::from(
        "# Effects\n\n\
         A page for each effect beside the rigid body: its equation, its parameters, when it is identifiable, which effects look similar, and \
         the motion that distinguishes them.\n\
         A spec declares an effect by its name, `effects { stribeck on elbow; }`; [`trace`](../tracing.md) tries those that it does not \
         declare, and writes their names with hyphens.\n\
         [The language](../../model-spec/LANGUAGE.md#effects) says how an effect is defined, for those of one's own.\n\n\
         | effect | what it is | acts as | in `trace` |\n|---|---|---|---|\n",
    );
    for effect in standard_effects() {
        writeln!(
            text,
            "| [`{0}`]({0}.md) | {1} | {2} | {3} |",
            effect.name,
            effect.summary(),
            means(effect),
            traced(effect),
        )
        .expect("a string takes all");
    }
    write!(
        text,
        "\nThese pages are written from the files of `model-spec/effects` by `{COMMAND}`.\n"
    )
    .expect("a string takes all");
    text
}
