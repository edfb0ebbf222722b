//! Source code from the derived forms.
//!
//! What the functions of a page are is decided once: which there are, with their sentences (`functions`), what each takes and
//! returns (`function`), which expressions get a name and in which order they are computed (`schedule`, `names`), how an
//! expression is written with operators and parentheses (`written`). A language spells that: [`rust`], [`c`].

pub mod c;
pub mod rust;

mod function;
mod functions;
mod header;
pub(crate) mod names;
pub(crate) mod schedule;
mod table;
mod written;

use crate::compiled::Compiled;
pub use crate::optimize::Cost;
pub use header::MARK;

/// What is on the page.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Extent {
    /// Everything.
    #[default]
    All,
    /// Torque and its regressors: what `RobotModel` needs. About half of the page.
    Torque,
}

/// Costs of the emitted functions, in the order of the page.
pub type Costs = Vec<(&'static str, Cost)>;

/// What each emitted function costs.
#[must_use]
pub fn costs(compiled: &Compiled) -> Costs {
    let functions = functions::functions(compiled, Extent::All);
    let functions = functions.iter();
    functions
        .map(|function| (function.name, function.cost()))
        .collect()
}
