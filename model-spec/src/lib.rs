//! The robot-model language: `.robot` text in, a checked [`Model`] out, amendments back into the text.
//!
//! ```text
//! text -parse-> Ast -check-> Model        text + Amendment -amend-> text'        URDF -import-> text
//! TOML -log_settings-> columns of a Model's logs (feature `log-settings`)
//! ```
//! No files are read here: callers bring the text and the name that messages show.
pub mod amend;
// Syntax and places in it are of the crates that read it, `robot-model-codegen` and the derive: types of `syn` and `proc-macro2` are in
// their signatures, which nobody else has to follow.
#[doc(hidden)]
pub mod ast;
mod check;
pub mod diagnostic;
pub mod export;
mod inertia;
pub mod library;
#[cfg(feature = "log-settings")]
mod log_settings;
pub mod model;
pub mod parameter;
mod parse;
pub mod polynomial;
pub mod suggest;
mod transform;
pub mod urdf;
pub mod words;

pub use amend::{Amendment, amend};
#[doc(hidden)]
pub use ast::Ast;
#[doc(hidden)]
pub use check::check;
pub use diagnostic::{Diagnostic, Diagnostics};
pub use library::standard_effects;
#[cfg(feature = "log-settings")]
pub use log_settings::{ColumnKind, LogSettings, log_column_unit, log_settings};
pub use model::Model;
#[doc(hidden)]
pub use parse::parse_tokens;
pub use transform::upper_camel;

/// Parses and checks a spec. `source_name` is what messages call the text, usually its path.
///
/// # Errors
/// Every mistake of the first stage (tokens, grammar, rules) that has one.
pub fn load(source_name: &str, text: &str) -> Result<Model, Diagnostics> {
    let ast = parse(source_name, text)?;
    check(&ast, source_name).map_err(|errors| Diagnostics::new(source_name, text, errors))
}

/// Parses a spec without checking what it says.
///
/// # Errors
/// Every place where the text does not follow the grammar.
pub(crate) fn parse(source_name: &str, text: &str) -> Result<Ast, Diagnostics> {
    parse::parse_text(text).map_err(|errors| Diagnostics::new(source_name, text, errors))
}
