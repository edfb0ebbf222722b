//! Text of the language to equations.

use robot_model_cli::interpreted::InterpretedArm;
use robot_model_codegen::{Compiled, compile_model};

use super::Error;

/// A spec, compiled.
///
/// # Errors
/// What the language says of it.
pub fn compiled(name: &str, text: &str) -> Result<Compiled, Error> {
    Ok(compile_model(&robot_model_spec::load(name, text)?))
}

/// The same behind the traits of the runtime.
///
/// # Errors
/// Those of [`compiled`].
pub fn interpreted(name: &str, text: &str) -> Result<InterpretedArm, Error> {
    Ok(InterpretedArm::new(compiled(name, text)?))
}

/// What is wrong with a text, with the dimensions that do not fit; nothing where it is a spec.
#[must_use]
pub fn refused(name: &str, text: &str) -> Option<String> {
    let errors = robot_model_spec::load(name, text).err()?;
    let messages: Vec<&str> = errors.messages().collect();
    let rendered = errors.render(false);
    let labels = rendered
        .lines()
        .filter_map(|line| line.split("this is ").nth(1));
    let labels: Vec<&str> = labels.collect();
    Some(format!("{}: {}", messages.join("; "), labels.join(" and ")))
}
