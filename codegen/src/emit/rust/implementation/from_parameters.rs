//! `FromParameters`: an arm made from a vector of parameters.

use proc_macro2::{Ident, Span, TokenStream};
use quote::quote;

use super::super::super::functions::standard_of;
use super::super::expression::Printer;
use super::super::sizes::Sizes;
use super::From;
use crate::compiled::Compiled;

/// The implementation for a type that implements `RobotModel`.
pub fn implementation(compiled: &Compiled, name: &Ident, from: &From) -> TokenStream {
    let sizes = Sizes::of(compiled);
    let arguments = sizes.arguments();
    let Sizes {
        standard,
        base,
        shapes: shape_count,
        ..
    } = &sizes;
    let free = compiled.free_shapes().len();
    let (from_standard, from_base) = match from {
        From::Standard(standard) => (standard, None),
        From::Base(standard, base) => (standard, Some(base)),
    };
    let shapes = Ident::new(
        if free > 0 { "shapes" } else { "_shapes" },
        Span::call_site(),
    );
    let from_base = from_base.map(|body| {
        quote! {
            fn from_base(beta: &model::Vector<#base>) -> Self {
                #body
            }
            __blank!();
        }
    });
    let beta = if compiled.base.kept.is_empty() {
        "_beta"
    } else {
        "beta"
    };
    let beta = Ident::new(beta, Span::call_site());
    let printer = Printer::of_numbers();
    let entries = standard_of(compiled);
    let entries = entries.iter().map(|entry| printer.tokens(entry));
    quote! {
        __blank!();
        impl model::FromParameters #arguments for #name {
            fn from_parameters(standard: &model::Vector<#standard>, #shapes: &model::Vector<#shape_count>) -> Self {
                #from_standard
            }
            __blank!();
            #from_base
            fn standard_of(#beta: &model::Vector<#base>) -> model::Vector<#standard> {
                [#(#entries),*].into()
            }
        }
    }
}
