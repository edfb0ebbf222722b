//! Source code from the derived forms.

pub mod rust;
