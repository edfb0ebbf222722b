//! `FromParameters`: an arm made from a vector of parameters.

use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::quote;
use robot_model_spec::parameter::Status;

use super::super::render::number;
use super::super::sizes::Sizes;
use super::From;
use crate::compiled::Compiled;
use crate::right_inverse::right_inverse;

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
    let combinations = right_inverse(
        &compiled.base.combinations,
        &compiled.base.kept,
        compiled.standard.len(),
    );
    let beta = if compiled.base.kept.is_empty() {
        "_beta"
    } else {
        "beta"
    };
    let beta = Ident::new(beta, Span::call_site());
    let entries = compiled
        .standard
        .iter()
        .zip(&combinations)
        .map(|(parameter, combination)| match parameter.status {
            Status::Fixed(value) => number(value),
            _ => in_beta(combination),
        });
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

/// `beta[0] - 0.5 * beta[3]`
fn in_beta(combination: &[(usize, f64)]) -> TokenStream {
    let mut sum = TokenStream::new();
    for &(j, coefficient) in combination {
        let j = Literal::usize_unsuffixed(j);
        let size = number(coefficient.abs());
        let is_one = coefficient.abs().to_bits() == 1.0f64.to_bits();
        let term = if is_one {
            quote!(beta[#j])
        } else {
            quote!(#size * beta[#j])
        };
        sum = match (sum.is_empty(), coefficient < 0.0) {
            (true, false) => term,
            (true, true) => quote!(-#term),
            (false, false) => quote!(#sum + #term),
            (false, true) => quote!(#sum - #term),
        };
    }
    if sum.is_empty() { number(0.0) } else { sum }
}
