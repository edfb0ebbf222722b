//! The robot-model compiler: a checked model in, equations and specialized Rust or C out.
//!
//! ```text
//! Model -derive-> Dynamics -linearize-> LinearForm -reduce-> BaseForm -compute-> Computed
//!       -optimize-> programs (interpreter) | Rust or C (emit)
//! ```

pub mod base;
// Of the derive alone: tokens in, tokens out.
#[doc(hidden)]
pub mod derive_input;
pub mod dynamics;
mod elimination;
pub mod emit;
pub mod expr;
pub mod filtered;
pub mod interpreter;
pub mod lumps;
pub mod optimize;
#[cfg(feature = "parameters")]
pub mod parameters;
mod random;
pub mod regressor;
mod right_inverse;
mod rounded;
mod sample;
mod selection;
pub mod show;
pub mod states;

mod alone;
mod audited;
mod baked;
mod block;
mod build_script;
mod compiled;
mod design;
mod forms;
mod linkage;
mod measured;
mod motors;
mod parametric;
mod plant;
mod terms;

pub use alone::{EffectColumns, effect_columns};
pub use baked::{BakeError, Given, Origin};
pub use block::Block;
pub use build_script::{CompileError, compile, compile_text};
#[cfg(feature = "parameters")]
pub use build_script::{compile_text_with, compile_with};
pub use compiled::{Compiled, compile_for_rows, compile_model};
pub use design::{DesignColumn, DesignColumns, Differentiable, Nominal, Remembering, RivalColumns};
pub use linkage::{Driven, Linkage};
pub use measured::NotInstantaneous;
pub use parametric::PlantParameters;
pub use plant::{Plant, PlantSlopes, Share};
pub use terms::Terms;
