//! The type that stands for the robot, and its `RobotModel` implementation over the page's functions.

use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::quote;

use super::function::Function;
use crate::compiled::Compiled;

/// The type and its implementation.
pub fn items(compiled: &Compiled, functions: &[Function]) -> Vec<TokenStream> {
    let name = Ident::new(&compiled.model.name, Span::call_site());
    let doc = format!(
        " The equations of `{}` for code that is generic over arms.",
        compiled.model.name
    );
    let item = quote! {
        #[doc = #doc]
        #[allow(dead_code, reason = "a program uses what it needs of its arm")]
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        pub struct #name;
    };
    let implementation = implementation(compiled, functions, &name);
    // The import stays inside: the page may be included beside a module of the same name.
    let implementation = quote! {
        const _: () = {
            use ::robot_model::model::{self, as_array, from_rows};
            __blank!();
            #implementation
        };
    };
    vec![item, implementation]
}

/// `impl model::RobotModel<DOF, STANDARD, BASE> for name`, with the runtime's module `model`
/// and its conversions in scope.
pub fn implementation(compiled: &Compiled, functions: &[Function], name: &Ident) -> TokenStream {
    let dof = Literal::usize_unsuffixed(compiled.dof());
    let standard = Literal::usize_unsuffixed(compiled.standard.len());
    let base = Literal::usize_unsuffixed(compiled.base.kept.len());
    let robot = &compiled.model.name;
    let joints = compiled.model.joints.iter().map(|joint| &joint.name);
    let standard_names = compiled.standard.iter().map(|parameter| &parameter.name);
    let base_names = &compiled.base.names;
    let call = |wanted: &str| {
        let function = functions
            .iter()
            .find(|function| function.name == wanted)
            .expect("the page has this function");
        let name = Ident::new(function.name, Span::call_site());
        let arguments = function
            .arguments
            .iter()
            .map(|&argument| argument_value(argument));
        quote!(#name(#(#arguments),*))
    };
    let vector = |call: TokenStream| quote!(#call.into());
    let matrix = |call: TokenStream| quote!(from_rows(&#call));
    let base_parameters = vector(call("base_parameters"));
    let mut methods = vec![quote! {
        fn base_parameters(standard: &model::Vector<#standard>) -> model::Vector<#base> {
            #base_parameters
        }
    }];
    for name in ["mass_matrix", "coriolis_matrix"] {
        let value = matrix(call(name));
        let name = Ident::new(name, Span::call_site());
        methods.push(quote! {
            fn #name(state: &model::State<#dof>, beta: &model::Vector<#base>) -> model::Matrix<#dof, #dof> {
                #value
            }
        });
    }
    for name in ["gravity", "bias", "inverse_dynamics"] {
        let value = vector(call(name));
        let name = Ident::new(name, Span::call_site());
        methods.push(quote! {
            fn #name(state: &model::State<#dof>, beta: &model::Vector<#base>) -> model::Vector<#dof> {
                #value
            }
        });
    }
    for (name, columns) in [("regressor", &standard), ("base_regressor", &base)] {
        let value = matrix(call(name));
        let name = Ident::new(name, Span::call_site());
        methods.push(quote! {
            fn #name(state: &model::State<#dof>) -> model::Matrix<#dof, #columns> {
                #value
            }
        });
    }
    quote! {
        impl model::RobotModel<#dof, #standard, #base> for #name {
            const NAME: &'static str = #robot;
            const JOINTS: [&'static str; #dof] = [#(#joints),*];
            const STANDARD_PARAMETERS: [&'static str; #standard] = [#(#standard_names),*];
            const BASE_PARAMETERS: [&'static str; #base] = [#(#base_names),*];
            #(__blank!(); #methods)*
        }
    }
}

/// An argument of a free function, from the arguments of the trait's method.
fn argument_value(argument: &str) -> TokenStream {
    match argument {
        "time" => quote!(state.time),
        "beta" => quote!(as_array(beta)),
        "standard" => quote!(as_array(standard)),
        _ => {
            let name = Ident::new(argument, Span::call_site());
            quote!(as_array(&state.#name))
        }
    }
}
