//! The robot-model language: `.robot` text in, a checked [`Model`](model::Model) out, amendments back into the text.
pub mod model;
pub mod parameter;
