//! What a value of the robot's type holds, and how it gives parameters.

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use super::super::super::functions::its_standard;
use super::super::expression::number;
use super::super::sizes::Sizes;
use crate::compiled::Compiled;

/// How a value of the robot's type holds its parameters.
pub struct Parameters {
    /// Body of `fn standard(&self) -> model::Vector<STANDARD>`.
    pub standard: TokenStream,
    /// Body of `fn beta(&self) -> model::Vector<BASE>`, where it is more than `base_parameters` of `standard`.
    pub beta: Option<TokenStream>,
    /// Body of `fn shapes(&self) -> model::Vector<SHAPES>`.
    pub shapes: TokenStream,
    /// How a value is made from parameters, where it can be.
    pub from: Option<From>,
}

/// Making a value from parameters.
pub enum From {
    /// Body of `fn from_parameters(standard, shapes) -> Self`.
    Standard(TokenStream),
    /// Bodies of `from_parameters` and of `from_base`.
    Base(TokenStream, TokenStream),
}

/// A type that holds nothing.
pub fn one_arm(name: &Ident) -> TokenStream {
    let doc = format!(" `{name}` with the parameters of one arm, which are in its equations.");
    quote! {
        #[doc = #doc]
        #[allow(dead_code, reason = "a program uses what it needs of its arm")]
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
        pub struct #name;
    }
}

pub fn its_own(compiled: &Compiled, beta: &[f64]) -> Parameters {
    let standard = its_standard(compiled, beta).into_iter().map(number);
    let beta = beta.iter().map(|&value| number(value));
    Parameters {
        standard: quote!([#(#standard),*].into()),
        beta: Some(quote!([#(#beta),*].into())),
        shapes: quote!([].into()),
        from: None,
    }
}

/// A type that holds base parameters, and shape parameters where the spec leaves some open.
pub fn any_arm(compiled: &Compiled, name: &Ident) -> TokenStream {
    let doc = format!(" `{name}` with values for its parameters.");
    let Sizes { base, shapes, .. } = Sizes::of(compiled);
    let shapes_field = (!compiled.free_shapes().is_empty()).then(|| {
        quote! {
            /// Shape parameters, in the order of `SHAPE_PARAMETERS`.
            pub shapes: ::robot_model::Vector<#shapes>,
        }
    });
    quote! {
        #[doc = #doc]
        #[allow(dead_code, reason = "a program uses what it needs of its arm")]
        #[derive(Debug, Clone, Copy, PartialEq)]
        pub struct #name {
            /// Base parameters, in the order of `BASE_PARAMETERS`.
            pub beta: ::robot_model::Vector<#base>,
            #shapes_field
        }
    }
}

pub fn given(free_shapes: usize) -> Parameters {
    let has_shapes = free_shapes > 0;
    let (given, nominal) = if has_shapes {
        (
            quote!(, shapes: *shapes),
            quote!(, shapes: Self::NOMINAL_SHAPES.into()),
        )
    } else {
        (quote!(), quote!())
    };
    let shapes = if has_shapes {
        quote!(self.shapes)
    } else {
        quote!([].into())
    };
    Parameters {
        standard: quote!(Self::standard_of(&self.beta)),
        beta: Some(quote!(self.beta)),
        shapes,
        from: Some(From::Base(
            quote!(Self { beta: Self::base_parameters(standard) #given }),
            quote!(Self { beta: *beta #nominal }),
        )),
    }
}
