//! `RobotModel` over the page's functions, for the page's own type or for a struct of the user's.

mod from_parameters;
mod memory;
mod parameters;

use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::quote;

use super::super::Extent;
use super::super::function::Function;
use super::super::table::Table;
use super::expression::number;
use super::mechanics;
use super::sizes::Sizes;
use crate::base;
use crate::compiled::Compiled;
pub use parameters::{From, Parameters};

/// The page's type and its implementation: it holds base parameters, or nothing where the equations have them.
pub fn items(compiled: &Compiled, functions: &[Function], extent: Extent) -> Vec<TokenStream> {
    let name = type_of(&compiled.model.name);
    let (item, parameters) = match &compiled.baked {
        Some(beta) => (
            parameters::one_arm(&name),
            parameters::its_own(compiled, beta),
        ),
        None => (
            parameters::any_arm(compiled, &name),
            parameters::given(compiled.free_shapes().len()),
        ),
    };
    let implementation = implementation(
        compiled,
        functions,
        &name,
        &parameters,
        &base::shape_values(&compiled.model),
    );
    let mechanics = match extent {
        Extent::All => mechanics::implementations(compiled, functions, &name),
        Extent::Torque => quote!(),
    };
    let conversions = conversions(compiled);
    // The import stays inside: the page may be included beside a module of the same name.
    let implementation = quote! {
        #[allow(clippy::approx_constant, reason = "the spec's numbers")]
        const _: () = {
            #conversions
            __blank!();
            #implementation
            #mechanics
        };
    };
    vec![item, implementation]
}

/// The page's type: the robot's name, with `Robot` behind a word of Rust's.
fn type_of(robot: &str) -> Ident {
    syn::parse_str(robot).unwrap_or_else(|_| {
        let name = format!("{robot}Robot");
        Ident::new(&name, Span::call_site())
    })
}

/// What the implementations take from the runtime's module `model`.
pub fn conversions(compiled: &Compiled) -> TokenStream {
    let of_any = compiled
        .baked
        .is_none()
        .then(|| quote!(FromParameters as _, RobotModel as _, in_scalar,));
    quote!(use ::robot_model::model::{self, #of_any as_array, from_rows};)
}

/// `impl model::RobotModel<..> for name`, with the runtime's module `model` and its conversions in scope.
pub fn implementation(
    compiled: &Compiled,
    functions: &[Function],
    name: &Ident,
    parameters: &Parameters,
    nominal_shapes: &[f64],
) -> TokenStream {
    let arguments = Sizes::of(compiled).arguments();
    let constants = constants(compiled, nominal_shapes);
    let methods = [
        holding(compiled, functions, parameters),
        values(compiled, functions),
        regressors(compiled, functions),
    ];
    let methods = methods.iter().flatten();
    let from = parameters
        .from
        .as_ref()
        .map(|from| from_parameters::implementation(compiled, name, from));
    let memory = memory::implementation(compiled, functions, name);
    quote! {
        impl model::RobotModel #arguments for #name {
            #constants
            #(__blank!(); #methods)*
        }
        #from
        #memory
    }
}

fn constants(compiled: &Compiled, nominal_shapes: &[f64]) -> TokenStream {
    let sizes = Sizes::of(compiled);
    let Sizes {
        dof,
        standard,
        base,
        shapes,
        inputs,
        ..
    } = &sizes;
    let robot = &compiled.model.name;
    let table = Table::new(compiled, nominal_shapes);
    let Table {
        joints,
        standard: standard_names,
        base: base_names,
        shapes: shape_names,
        inputs: input_names,
        ..
    } = &table;
    let nominal = table.nominal.iter().map(|&value| number(value));
    let shape_values = table.nominal_shapes.iter().map(|&value| number(value));
    quote! {
        const NAME: &'static str = #robot;
        const JOINTS: [&'static str; #dof] = [#(#joints),*];
        const STANDARD_PARAMETERS: [&'static str; #standard] = [#(#standard_names),*];
        const BASE_PARAMETERS: [&'static str; #base] = [#(#base_names),*];
        const SHAPE_PARAMETERS: [&'static str; #shapes] = [#(#shape_names),*];
        const INPUTS: [&'static str; #inputs] = [#(#input_names),*];
        const NOMINAL: [f64; #standard] = [#(#nominal),*];
        const NOMINAL_SHAPES: [f64; #shapes] = [#(#shape_values),*];
    }
}

/// `base_parameters` and what the value holds.
fn holding(
    compiled: &Compiled,
    functions: &[Function],
    parameters: &Parameters,
) -> Vec<TokenStream> {
    let sizes = Sizes::of(compiled);
    let Sizes {
        standard: standard_count,
        base,
        shapes: shape_count,
        ..
    } = &sizes;
    let call = call(functions, "base_parameters", &Reads::default());
    let Parameters {
        standard,
        beta,
        shapes,
        ..
    } = parameters;
    let mut methods = vec![
        quote! {
            fn base_parameters(standard: &model::Vector<#standard_count>) -> model::Vector<#base> {
                #call.into()
            }
        },
        quote! {
            fn standard(&self) -> model::Vector<#standard_count> {
                #standard
            }
        },
        quote! {
            fn shapes(&self) -> model::Vector<#shape_count> {
                #shapes
            }
        },
    ];
    if let Some(beta) = beta {
        methods.push(quote! {
            fn beta(&self) -> model::Vector<#base> {
                #beta
            }
        });
    }
    methods
}

/// Equations that need values for the parameters.
fn values(compiled: &Compiled, functions: &[Function]) -> Vec<TokenStream> {
    let sizes = Sizes::of(compiled);
    let (dof, state) = (&sizes.dof, sizes.state());
    let plain = [
        ("mass_matrix", &["q"] as &[&str], true),
        ("coriolis_matrix", &["q", "dq"], true),
        ("gravity", &["q"], false),
        ("bias", &["q", "dq"], false),
    ];
    let mut methods: Vec<TokenStream> = plain
        .into_iter()
        .map(|(wanted, motion, is_matrix)| {
            let call = call(functions, wanted, &Reads::value(quote!()));
            let name = Ident::new(wanted, Span::call_site());
            let function = find(functions, wanted);
            let motion = motion.iter().map(|argument| {
                let ident = Ident::new(argument, Span::call_site());
                // The free function has every argument of its motion, read or not.
                debug_assert!(function.takes(argument));
                quote!(#ident: &model::SVector<S, #dof>)
            });
            if is_matrix {
                quote! {
                    fn #name<S: ::robot_model::Scalar>(&self, #(#motion),*) -> model::SMatrix<S, #dof, #dof> {
                        from_rows(&#call)
                    }
                }
            } else {
                quote! {
                    fn #name<S: ::robot_model::Scalar>(&self, #(#motion),*) -> model::SVector<S, #dof> {
                        #call.into()
                    }
                }
            }
        })
        .collect();
    let call = call(functions, "inverse_dynamics", &Reads::value(quote!(state.)));
    methods.push(quote! {
        fn inverse_dynamics_at<S: ::robot_model::Scalar>(&self, state: &#state) -> model::SVector<S, #dof> {
            #call.into()
        }
    });
    if compiled.has_motors_in_loads() {
        let call = self::call(functions, "load", &Reads::value(quote!(state.)));
        methods.push(quote! {
            fn loaded<S: ::robot_model::Scalar>(&self, state: &#state) -> #state {
                ::robot_model::State { rigid_torque: #call.into(), ..*state }
            }
        });
    }
    methods
}

/// Equations that need none.
fn regressors(compiled: &Compiled, functions: &[Function]) -> Vec<TokenStream> {
    let sizes = Sizes::of(compiled);
    let (dof, state, shape_count) = (&sizes.dof, sizes.state(), &sizes.shapes);
    let columns = [
        ("regressor", compiled.standard.len()),
        ("base_regressor", compiled.base.kept.len()),
    ];
    columns
        .into_iter()
        .map(|(wanted, columns)| {
            let call = call(functions, wanted, &Reads::state());
            let name = Ident::new(&format!("{wanted}_at"), Span::call_site());
            let columns = Literal::usize_unsuffixed(columns);
            let reads_shapes = find(functions, wanted).takes("shapes");
            let shapes = Ident::new(if reads_shapes { "shapes" } else { "_shapes" }, Span::call_site());
            quote! {
                fn #name<S: ::robot_model::Scalar>(state: &#state, #shapes: &model::Vector<#shape_count>) -> model::SMatrix<S, #dof, #columns> {
                    from_rows(&#call)
                }
            }
        })
        .collect()
}

/// Where the arguments of a free function come from in a method.
#[derive(Default)]
pub struct Reads {
    /// In front of `q`, `dq`, `ddq`: nothing, or `state.`
    state: TokenStream,
    /// Parameters come from `self`.
    of_self: bool,
}

impl Reads {
    /// Parameters from the value.
    pub fn value(state: TokenStream) -> Self {
        Self {
            state,
            of_self: true,
        }
    }

    /// Everything from a state, shapes beside it.
    pub fn state() -> Self {
        Self {
            state: quote!(state.),
            of_self: false,
        }
    }

    fn argument(&self, argument: &str) -> TokenStream {
        let state = &self.state;
        match argument {
            "time" => quote!(state.time),
            "seconds" => quote!(seconds),
            "states" => quote!(as_array(&state.memory)),
            "tau" => quote!(as_array(tau)),
            "beta" => quote!(&in_scalar(&self.beta())),
            "shapes" if self.of_self => quote!(&in_scalar(&self.shapes())),
            "shapes" => quote!(&in_scalar(shapes)),
            "standard" => quote!(as_array(standard)),
            _ => {
                let name = Ident::new(argument, Span::call_site());
                if state.is_empty() {
                    quote!(as_array(#name))
                } else {
                    quote!(as_array(&#state #name))
                }
            }
        }
    }
}

/// The function of that name.
pub fn find<'a>(functions: &'a [Function], wanted: &str) -> &'a Function {
    functions
        .iter()
        .find(|function| function.name == wanted)
        .expect("the page has this function")
}

/// A call of the function of that name.
pub fn call(functions: &[Function], wanted: &str, reads: &Reads) -> TokenStream {
    let function = find(functions, wanted);
    let name = Ident::new(function.name, Span::call_site());
    let arguments = function
        .arguments
        .iter()
        .map(|argument| reads.argument(argument.name));
    quote!(#name(#(#arguments),*))
}
