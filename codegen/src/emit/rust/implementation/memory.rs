//! `Memory`: how the internal states of an arm's effects change.

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use super::super::super::function::Function;
use super::super::sizes::Sizes;
use super::{Reads, call, find};
use crate::compiled::Compiled;

/// The implementation for a type that implements `RobotModel`, where effects have states.
pub fn implementation(
    compiled: &Compiled,
    functions: &[Function],
    name: &Ident,
) -> Option<TokenStream> {
    let names = compiled.model.states();
    if names.is_empty() {
        return None;
    }
    let sizes = Sizes::of(compiled);
    let (arguments, state) = (sizes.arguments(), sizes.state());
    let (states, shapes) = (&sizes.states, &sizes.shapes);
    let rates = call(functions, "state_rates", &Reads::state());
    let after = call(functions, "memory_after", &Reads::value(quote!(state.)));
    let reads = |argument| find(functions, "state_rates").takes(argument);
    let given_shapes = if reads("shapes") {
        quote!(shapes)
    } else {
        quote!(_shapes)
    };
    let load =
        reads("rigid_torque").then(|| quote!(let state = &model::RobotModel::loaded(self, state);));
    Some(quote! {
        __blank!();
        impl ::robot_model::Memory #arguments for #name {
            const STATES: [&'static str; #states] = [#(#names),*];
            __blank!();
            fn state_rates_at<S: ::robot_model::Scalar>(state: &#state, #given_shapes: &model::Vector<#shapes>) -> model::SVector<S, #states> {
                #rates.into()
            }
            __blank!();
            fn memory_after<S: ::robot_model::Scalar>(&self, state: &#state, seconds: f64) -> model::SVector<S, #states> {
                #load
                #after.into()
            }
        }
    })
}
