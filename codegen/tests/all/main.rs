//! Compiled models against laws written out by hand.

mod computed;
mod effect_equations;
mod emitted;
mod forms;
mod laws;
mod motors;
mod show;
