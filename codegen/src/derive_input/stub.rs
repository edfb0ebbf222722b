//! What stands in for an implementation where the robot has mistakes: it satisfies rustc, so that only our words are read.

use proc_macro2::{Literal, TokenStream};
use quote::quote;
use syn::{Data, DeriveInput};

/// An implementation of the right number of joints, as far as the fields tell.
pub fn implementation(input: &DeriveInput) -> TokenStream {
    let Data::Struct(data) = &input.data else {
        return TokenStream::new();
    };
    if !input.generics.params.is_empty() {
        return TokenStream::new();
    }
    let is_joint = |field: &&syn::Field| {
        let has = |name: &str| {
            field
                .attrs
                .iter()
                .any(|attribute| attribute.path().is_ident(name))
        };
        let ty = &field.ty;
        !has("on") && quote!(#ty).to_string() != "f64"
    };
    let name = &input.ident;
    let dof = Literal::usize_unsuffixed(data.fields.iter().filter(is_joint).count());
    quote! {
        const _: () = {
            use ::robot_model::model::{SMatrix, SVector};
            use ::robot_model::{FromParameters, RobotModel, Scalar, State, Vector};
            #[automatically_derived]
            impl RobotModel<#dof, 0, 0, 0> for #name {
                const NAME: &'static str = "";
                const JOINTS: [&'static str; #dof] = [""; #dof];
                const STANDARD_PARAMETERS: [&'static str; 0] = [];
                const BASE_PARAMETERS: [&'static str; 0] = [];
                const SHAPE_PARAMETERS: [&'static str; 0] = [];
                const INPUTS: [&'static str; 0] = [];
                const NOMINAL: [f64; 0] = [];
                const NOMINAL_SHAPES: [f64; 0] = [];
                fn base_parameters(_: &Vector<0>) -> Vector<0> { ::core::unreachable!() }
                fn standard(&self) -> Vector<0> { ::core::unreachable!() }
                fn shapes(&self) -> Vector<0> { ::core::unreachable!() }
                fn mass_matrix<S: Scalar>(&self, _: &SVector<S, #dof>) -> SMatrix<S, #dof, #dof> { ::core::unreachable!() }
                fn coriolis_matrix<S: Scalar>(&self, _: &SVector<S, #dof>, _: &SVector<S, #dof>) -> SMatrix<S, #dof, #dof> { ::core::unreachable!() }
                fn gravity<S: Scalar>(&self, _: &SVector<S, #dof>) -> SVector<S, #dof> { ::core::unreachable!() }
                fn bias<S: Scalar>(&self, _: &SVector<S, #dof>, _: &SVector<S, #dof>) -> SVector<S, #dof> { ::core::unreachable!() }
                fn inverse_dynamics_at<S: Scalar>(&self, _: &State<#dof, 0, 0, S>) -> SVector<S, #dof> { ::core::unreachable!() }
                fn regressor_at<S: Scalar>(_: &State<#dof, 0, 0, S>, _: &Vector<0>) -> SMatrix<S, #dof, 0> { ::core::unreachable!() }
                fn base_regressor_at<S: Scalar>(_: &State<#dof, 0, 0, S>, _: &Vector<0>) -> SMatrix<S, #dof, 0> { ::core::unreachable!() }
            }
            #[automatically_derived]
            impl FromParameters<#dof, 0, 0, 0> for #name {
                fn from_parameters(_: &Vector<0>, _: &Vector<0>) -> Self { ::core::unreachable!() }
                fn standard_of(_: &Vector<0>) -> Vector<0> { ::core::unreachable!() }
            }
        };
    }
}
