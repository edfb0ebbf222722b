//! What the derive itself says of a mistake. `goldens.rs` enumerates the lines that call it.

use std::fmt::Display;

use proc_macro2::Span;

/// A mistake at a place, with the way out in its message.
#[track_caller]
pub fn mistake(span: Span, message: impl Display) -> syn::Error {
    let message = message.to_string();
    #[cfg(test)]
    robot_model_goldens::note(&message);
    syn::Error::new(span, message)
}

/// Mistakes, collected.
#[derive(Default)]
pub struct Errors(Option<syn::Error>);

impl Errors {
    /// One more.
    #[track_caller]
    pub fn mistake(&mut self, span: Span, message: impl Display) {
        self.keep::<()>(Err(mistake(span, message)));
    }

    /// The value, or the mistake kept.
    pub fn keep<T>(&mut self, result: syn::Result<T>) -> Option<T> {
        match result {
            Ok(value) => Some(value),
            Err(error) => {
                match &mut self.0 {
                    Some(all) => all.combine(error),
                    None => self.0 = Some(error),
                }
                None
            }
        }
    }

    /// All of them, if there are any.
    pub fn finish<T>(self, value: T) -> syn::Result<T> {
        self.0.map_or(Ok(value), Err)
    }
}
