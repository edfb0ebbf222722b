//! The language: what is accepted, what it means, and how mistakes are told.

mod fail;
mod language;
mod log_settings;
mod meaning;
mod mutations;
mod pass;
mod urdf;
