//! One page of Rust for one robot: free functions on arrays, and a type that implements `robot_model::RobotModel`.
//!
//! In: [`Compiled`]. Out: text for `include!`. Same spec, same bytes.

mod expression;
mod function;
mod implementation;
mod mechanics;
mod pretty;
mod sizes;

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use super::functions::functions;
use super::header;
use crate::compiled::Compiled;

/// What is the same in every language, for those who write only this one.
pub use super::{Cost, Costs, Extent, costs};
// Of the derive alone: tokens in, tokens out.
#[doc(hidden)]
pub use expression::number;
#[doc(hidden)]
pub use implementation::{From, Parameters};

/// What a reader of the page has to know; clippy looks at it too.
const NOTES: [&str; 3] = [
    "`S::mul_add(x, y, z)` is `x * y + z`, in one operation where the target has it.",
    "Clippy's pedantic lints speak of hand-written code: include the page in a module with",
    "`#[allow(clippy::pedantic)]` if your crate turns them on.",
];

/// The page.
#[must_use]
pub fn module(compiled: &Compiled) -> String {
    module_of(compiled, Extent::All)
}

/// The page, or the part of it that is wanted.
#[must_use]
pub fn module_of(compiled: &Compiled, extent: Extent) -> String {
    let functions = functions(compiled, extent);
    let mut items: Vec<TokenStream> = functions.iter().map(function::item).collect();
    items.extend(implementation::items(compiled, &functions, extent));
    let mut lines = header::header(compiled);
    lines.extend(header::legend(compiled));
    lines.extend(NOTES.map(str::to_owned));
    let header = header::comment("// ", &lines);
    pretty::page(&header, &items)
}

/// The page's functions and the implementation for a type that exists already, hidden in an anonymous constant.
/// `nominal_shapes` are values for all shape parameters before identification.
#[must_use]
#[doc(hidden)]
pub fn implementation_for(
    compiled: &Compiled,
    name: &Ident,
    parameters: &Parameters,
    nominal_shapes: &[f64],
) -> TokenStream {
    let functions = functions(compiled, Extent::All);
    let items = functions.iter().map(function::item);
    let implementation =
        implementation::implementation(compiled, &functions, name, parameters, nominal_shapes);
    let mechanics = mechanics::implementations(compiled, &functions, name);
    let conversions = implementation::conversions(compiled);
    pretty::without_markers(quote! {
        #[allow(clippy::all, clippy::pedantic, reason = "derived, not written")]
        const _: () = {
            #conversions
            #(#items)*
            #implementation
            #mechanics
        };
    })
}
