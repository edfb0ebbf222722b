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
    vec![item, implementation(compiled, functions, &name)]
}

/// `impl RobotModel<DOF, STANDARD, BASE> for name`.
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
    let (mass_matrix, coriolis_matrix) = (call("mass_matrix"), call("coriolis_matrix"));
    let (gravity, bias, inverse_dynamics) =
        (call("gravity"), call("bias"), call("inverse_dynamics"));
    let (regressor, base_regressor) = (call("regressor"), call("base_regressor"));
    let base_parameters = call("base_parameters");
    quote! {
        impl ::robot_model::RobotModel<#dof, #standard, #base> for #name {
            const NAME: &'static str = #robot;
            const JOINTS: [&'static str; #dof] = [#(#joints),*];
            const STANDARD_PARAMETERS: [&'static str; #standard] = [#(#standard_names),*];
            const BASE_PARAMETERS: [&'static str; #base] = [#(#base_names),*];

            fn base_parameters(standard: &::robot_model::Vector<#standard>) -> ::robot_model::Vector<#base> {
                #base_parameters.into()
            }
            fn mass_matrix(state: &::robot_model::State<#dof>, beta: &::robot_model::Vector<#base>)
                -> ::robot_model::Matrix<#dof, #dof>
            {
                ::robot_model::model::from_rows(&#mass_matrix)
            }
            fn coriolis_matrix(state: &::robot_model::State<#dof>, beta: &::robot_model::Vector<#base>)
                -> ::robot_model::Matrix<#dof, #dof>
            {
                ::robot_model::model::from_rows(&#coriolis_matrix)
            }
            fn gravity(state: &::robot_model::State<#dof>, beta: &::robot_model::Vector<#base>)
                -> ::robot_model::Vector<#dof>
            {
                #gravity.into()
            }
            fn bias(state: &::robot_model::State<#dof>, beta: &::robot_model::Vector<#base>)
                -> ::robot_model::Vector<#dof>
            {
                #bias.into()
            }
            fn inverse_dynamics(state: &::robot_model::State<#dof>, beta: &::robot_model::Vector<#base>)
                -> ::robot_model::Vector<#dof>
            {
                #inverse_dynamics.into()
            }
            fn regressor(state: &::robot_model::State<#dof>) -> ::robot_model::Matrix<#dof, #standard> {
                ::robot_model::model::from_rows(&#regressor)
            }
            fn base_regressor(state: &::robot_model::State<#dof>) -> ::robot_model::Matrix<#dof, #base> {
                ::robot_model::model::from_rows(&#base_regressor)
            }
        }
    }
}

/// An argument of a free function, from the arguments of the trait's method.
fn argument_value(argument: &str) -> TokenStream {
    match argument {
        "time" => quote!(state.time),
        "beta" => quote!(::robot_model::model::as_array(beta)),
        "standard" => quote!(::robot_model::model::as_array(standard)),
        _ => {
            let name = Ident::new(argument, Span::call_site());
            quote!(::robot_model::model::as_array(&state.#name))
        }
    }
}
