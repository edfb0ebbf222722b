//! `Mechanics`, and `Kinematics` or `Points`, over the page's functions.

use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::{format_ident, quote};

use super::super::function::Function;
use super::implementation::{Reads, call, find};
use super::sizes::Sizes;
use crate::compiled::Compiled;

/// The implementations for a type that implements `RobotModel`, with the runtime's conversions in scope.
pub fn implementations(compiled: &Compiled, functions: &[Function], name: &Ident) -> TokenStream {
    let arguments = Sizes::of(compiled).arguments();
    let values = values(compiled, functions);
    let regressors = regressors(compiled, functions);
    let place = place(compiled, functions, name);
    quote! {
        __blank!();
        impl ::robot_model::Mechanics #arguments for #name {
            #values
            #(__blank!(); #regressors)*
        }
        #place
    }
}

/// Equations that need values for the parameters.
fn values(compiled: &Compiled, functions: &[Function]) -> TokenStream {
    let sizes = Sizes::of(compiled);
    let (dof, state) = (&sizes.dof, sizes.state());
    let plain = |wanted| call(functions, wanted, &Reads::value(quote!()));
    let at = |wanted| call(functions, wanted, &Reads::value(quote!(state.)));
    let (kinetic, potential) = (plain("kinetic_energy"), plain("potential_energy"));
    let forward = at("forward_dynamics");
    let by_position = at("inverse_dynamics_by_position");
    let by_velocity = at("inverse_dynamics_by_velocity");
    quote! {
        fn kinetic_energy<S: ::robot_model::Scalar>(&self, q: &model::SVector<S, #dof>, dq: &model::SVector<S, #dof>) -> S {
            #kinetic
        }
        __blank!();
        fn potential_energy<S: ::robot_model::Scalar>(&self, q: &model::SVector<S, #dof>) -> S {
            #potential
        }
        __blank!();
        fn forward_dynamics_at<S: ::robot_model::Scalar>(&self, state: &#state, tau: &model::SVector<S, #dof>) -> ::core::option::Option<model::SVector<S, #dof>> {
            #forward.map(Into::into)
        }
        __blank!();
        fn inverse_dynamics_by_position_at<S: ::robot_model::Scalar>(&self, state: &#state) -> model::SMatrix<S, #dof, #dof> {
            from_rows(&#by_position)
        }
        __blank!();
        fn inverse_dynamics_by_velocity_at<S: ::robot_model::Scalar>(&self, state: &#state) -> model::SMatrix<S, #dof, #dof> {
            from_rows(&#by_velocity)
        }
    }
}

/// Equations that need none.
fn regressors(compiled: &Compiled, functions: &[Function]) -> Vec<TokenStream> {
    let sizes = Sizes::of(compiled);
    let (dof, state, shape_count) = (&sizes.dof, sizes.state(), &sizes.shapes);
    let (standard, base) = (compiled.standard.len(), compiled.base.kept.len());
    let wanted = [
        ("momentum_regressor", standard),
        ("drift_regressor", standard),
        ("base_momentum_regressor", base),
        ("base_drift_regressor", base),
    ];
    wanted
        .into_iter()
        .map(|(wanted, columns)| {
            let call = call(functions, wanted, &Reads::state());
            let name = format_ident!("{wanted}_at");
            let columns = Literal::usize_unsuffixed(columns);
            let reads_shapes = find(functions, wanted).takes("shapes");
            let shapes = if reads_shapes { "shapes" } else { "_shapes" };
            let shapes = Ident::new(shapes, Span::call_site());
            quote! {
                fn #name<S: ::robot_model::Scalar>(state: &#state, #shapes: &model::Vector<#shape_count>) -> model::SMatrix<S, #dof, #columns> {
                    from_rows(&#call)
                }
            }
        })
        .collect()
}

/// Where links or points are.
fn place(compiled: &Compiled, functions: &[Function], name: &Ident) -> TokenStream {
    let dof = Literal::usize_unsuffixed(compiled.dof());
    let plain = |wanted| call(functions, wanted, &Reads::value(quote!()));
    if compiled.kinematics.is_some() {
        let (poses, jacobian) = (plain("forward_kinematics"), plain("jacobian"));
        return quote! {
            __blank!();
            impl ::robot_model::Kinematics<#dof> for #name {
                fn forward_kinematics<S: ::robot_model::Scalar>(&self, q: &model::SVector<S, #dof>) -> [model::SMatrix<S, 4, 4>; #dof] {
                    #poses.map(|pose| from_rows(&pose))
                }
                __blank!();
                fn jacobian<S: ::robot_model::Scalar>(&self, q: &model::SVector<S, #dof>) -> model::SMatrix<S, 6, #dof> {
                    from_rows(&#jacobian)
                }
            }
        };
    }
    if compiled.points.is_empty() {
        return quote!();
    }
    let points = Literal::usize_unsuffixed(compiled.points.len());
    let names = compiled.points.iter().map(|point| &point.name);
    let (positions, jacobians) = (plain("points"), plain("point_jacobians"));
    quote! {
        __blank!();
        impl ::robot_model::Points<#dof, #points> for #name {
            const POINTS: [&'static str; #points] = [#(#names),*];
            __blank!();
            fn points<S: ::robot_model::Scalar>(&self, q: &model::SVector<S, #dof>) -> [model::SVector<S, 3>; #points] {
                #positions.map(Into::into)
            }
            __blank!();
            fn point_jacobians<S: ::robot_model::Scalar>(&self, q: &model::SVector<S, #dof>) -> [model::SMatrix<S, 3, #dof>; #points] {
                #jacobians.map(|jacobian| from_rows(&jacobian))
            }
        }
    }
}
