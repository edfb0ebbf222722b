//! Types that hold the parameters of effects: `ViscousFriction { fv }` of `effect viscous_friction(j) { linear fv; .. }`.

use proc_macro2::{Span, TokenStream};
use quote::quote;
use robot_model_spec::library::effect_definitions;
use robot_model_spec::model::EffectDefinition;
use robot_model_spec::standard_effects;

use super::ReadFile;
use super::fields::FileName;
use super::holds::{identifier, type_name};
use super::source::{mistaken, with_places};
use crate::base::middle;
use crate::emit::rust::number;

/// Types of the standard effects.
#[must_use]
pub fn standard() -> TokenStream {
    standard_effects()
        .iter()
        .map(|definition| item(definition))
        .collect()
}

/// Types of the effects that a file defines, for `effects!("own.robot")`; a robot beside them is not looked at.
#[must_use]
pub fn of_file(input: TokenStream, read: ReadFile<'_>) -> TokenStream {
    tokens_of_file(input, read).unwrap_or_else(|error| error.to_compile_error())
}

pub(super) fn tokens_of_file(input: TokenStream, read: ReadFile<'_>) -> syn::Result<TokenStream> {
    let name: syn::LitStr = syn::parse2(input)?;
    let file = FileName {
        name: name.value(),
        span: name.span(),
    };
    let text = super::source::read_file(&file, read)?;
    let definitions = with_places(|| effect_definitions(&file.name, &text))
        .map_err(|mistakes| mistaken(&file, &mistakes))?;
    let tracked = super::track(&file.name);
    let items = definitions.iter().map(item);
    Ok(quote!(#(#items)* #tracked))
}

fn item(definition: &EffectDefinition) -> TokenStream {
    let name = identifier(&type_name(&definition.name), Span::call_site());
    let doc = lines(&definition.doc);
    let field = |name: &str| identifier(name, Span::call_site());
    let linear = definition.linear.iter().map(|linear| {
        let (doc, name) = (lines(&linear.doc), field(&linear.name));
        quote!(#(#[doc = #doc])* pub #name: f64,)
    });
    let shapes = definition.shapes.iter().map(|shape| {
        let (doc, name) = (lines(&shape.doc), field(&shape.name));
        let range = format!(" Searched in {} .. {}.", shape.low, shape.high);
        quote!(#(#[doc = #doc])* #[doc = #range] pub #name: f64,)
    });
    let zeros = definition.linear.iter().map(|linear| field(&linear.name));
    let middles = definition.shapes.iter().map(|shape| {
        let (name, value) = (field(&shape.name), number(middle(shape.low, shape.high)));
        quote!(#name: #value,)
    });
    quote! {
        #(#[doc = #doc])*
        #[derive(Debug, Clone, Copy, PartialEq)]
        pub struct #name { #(#linear)* #(#shapes)* }

        /// Without force; shape parameters in the middle of their ranges.
        impl ::core::default::Default for #name {
            fn default() -> Self {
                Self { #(#zeros: 0.0,)* #(#middles)* }
            }
        }
    }
}

/// Lines of a doc comment; one where there is none, as every public item has to have one.
fn lines(doc: &str) -> Vec<String> {
    let doc = if doc.is_empty() {
        "As its definition says."
    } else {
        doc
    };
    doc.lines().map(|line| format!(" {line}")).collect()
}
