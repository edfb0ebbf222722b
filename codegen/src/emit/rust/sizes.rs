//! The sizes that an arm's type has, as the generated code writes them.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use crate::compiled::Compiled;

/// Numbers of everything that the traits count.
pub struct Sizes {
    pub dof: Literal,
    pub standard: Literal,
    pub base: Literal,
    pub shapes: Literal,
    pub states: Literal,
    pub inputs: Literal,
    /// Whether effects have a memory or read channels; else their numbers are not written.
    has_more_than_motion: bool,
}

impl Sizes {
    pub fn of(compiled: &Compiled) -> Self {
        let count = |n: usize| Literal::usize_unsuffixed(n);
        let states = compiled.model.states().len();
        let inputs = compiled.model.inputs().len();
        Self {
            dof: count(compiled.dof()),
            standard: count(compiled.standard.len()),
            base: count(compiled.base.kept.len()),
            shapes: count(compiled.free_shapes().len()),
            states: count(states),
            inputs: count(inputs),
            has_more_than_motion: states + inputs > 0,
        }
    }

    /// `<2, 20, 6, 0>`: the arguments of `RobotModel` and of the traits beside it.
    pub fn arguments(&self) -> TokenStream {
        let Self {
            dof,
            standard,
            base,
            shapes,
            states,
            inputs,
            ..
        } = self;
        let more = self
            .has_more_than_motion
            .then(|| quote!(, #states, #inputs));
        quote!(<#dof, #standard, #base, #shapes #more>)
    }

    /// `robot_model::State<2, 0, 0, S>`
    pub fn state(&self) -> TokenStream {
        let Self {
            dof,
            states,
            inputs,
            ..
        } = self;
        quote!(::robot_model::State<#dof, #states, #inputs, S>)
    }
}
