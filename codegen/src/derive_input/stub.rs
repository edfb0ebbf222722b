//! What stands in for an implementation where the robot has mistakes: it satisfies rustc, so that only our words are read.
//!
//! Every trait that such an arm may have is there, with sizes as far as the fields and the files tell them.

use proc_macro2::{Literal, TokenStream, TokenTree};
use quote::{format_ident, quote};
use robot_model_spec::library::effect_definitions;
use robot_model_spec::model::EffectDefinition;
use robot_model_spec::{Model, standard_effects};
use syn::{Data, DeriveInput, Field};

use super::ReadFile;
use super::fields;
use super::holds::type_name;
use super::source::with_places;
use crate::compiled::compile_model;

/// What the traits count.
#[derive(Default)]
struct Sizes {
    dof: usize,
    standard: usize,
    base: usize,
    shapes: usize,
    states: usize,
    inputs: usize,
    /// Points of a robot of energies; none where it is a chain.
    points: Option<usize>,
}

/// The implementations.
pub fn implementation(input: &DeriveInput, read: ReadFile<'_>) -> TokenStream {
    let Data::Struct(data) = &input.data else {
        return TokenStream::new();
    };
    if !input.generics.params.is_empty() {
        return TokenStream::new();
    }
    let texts: Vec<(String, String)> = fields::files(input)
        .filter_map(|file| read(&file).ok().map(|text| (file, text)))
        .collect();
    let load =
        |(file, text): &(String, String)| with_places(|| robot_model_spec::load(file, text)).ok();
    let sizes = match texts.iter().find_map(load) {
        Some(model) => of_model(model),
        None => of_fields(data.fields.iter(), &texts),
    };
    stub(&input.ident, &sizes)
}

/// The file's robot is as it should be, and the struct is not.
fn of_model(mut model: Model) -> Sizes {
    for effect in &mut model.effects {
        effect.shapes.fill(None);
    }
    let compiled = compile_model(&model);
    Sizes {
        dof: compiled.dof(),
        standard: compiled.standard.len(),
        base: compiled.base.kept.len(),
        shapes: compiled.free_shapes().len(),
        states: model.states().len(),
        inputs: model.inputs().len(),
        points: model.energies().map(|_| compiled.points.len()),
    }
}

/// What the words in the fields' types say.
fn of_fields<'a>(fields: impl Iterator<Item = &'a Field>, texts: &[(String, String)]) -> Sizes {
    let own = texts
        .iter()
        .filter_map(|(file, text)| with_places(|| effect_definitions(file, text)).ok());
    let own: Vec<_> = own.flatten().collect();
    let find = |word: &str| -> Option<&EffectDefinition> {
        let mut own = own.iter();
        own.find(|definition| type_name(&definition.name) == word)
            .or_else(|| {
                let mut standard = standard_effects().iter().map(|definition| &**definition);
                standard.find(|definition| type_name(&definition.name) == word)
            })
    };
    let mut sizes = Sizes::default();
    for field in fields {
        let mut words = Vec::new();
        let ty = &field.ty;
        collect(quote!(#ty), &mut words);
        let is_on = field.attrs.iter().any(|one| one.path().is_ident("on"));
        if !is_on && words != ["f64"] {
            sizes.dof += 1;
        }
        for word in &words {
            if word == "Link" {
                sizes.standard += 10;
            } else if let Some(definition) = find(word) {
                sizes.standard += definition.linear.len();
                sizes.shapes += definition.shapes.len();
                sizes.states += definition.states.len();
                sizes.inputs += definition.inputs.len();
            }
        }
    }
    sizes
}

/// Every identifier.
fn collect(tokens: TokenStream, words: &mut Vec<String>) {
    for token in tokens {
        match token {
            TokenTree::Group(group) => collect(group.stream(), words),
            TokenTree::Ident(ident) => words.push(ident.to_string()),
            TokenTree::Punct(_) | TokenTree::Literal(_) => {}
        }
    }
}

fn stub(name: &syn::Ident, sizes: &Sizes) -> TokenStream {
    let n = |count: usize| Literal::usize_unsuffixed(count);
    let (dof, standard, base) = (n(sizes.dof), n(sizes.standard), n(sizes.base));
    let (shapes, states, inputs) = (n(sizes.shapes), n(sizes.states), n(sizes.inputs));
    let all = quote!(<#dof, #standard, #base, #shapes, #states, #inputs>);
    let vector = quote!(&SVector<S, #dof>);
    let state = quote!(&State<#dof, #states, #inputs, S>);
    let square = quote!(SMatrix<S, #dof, #dof>);
    let given = quote!(&Vector<#shapes>);
    let none = quote!({ ::core::unreachable!() });
    let columns = |names: &[&str], count: &Literal| -> TokenStream {
        let names = names.iter().map(|name| format_ident!("{name}"));
        quote!(#(fn #names<S: Scalar>(_: #state, _: #given) -> SMatrix<S, #dof, #count> #none)*)
    };
    let regressor = columns(&["regressor_at"], &standard);
    let base_regressor = columns(&["base_regressor_at"], &base);
    let momentum = columns(&["momentum_regressor_at", "drift_regressor_at"], &standard);
    let base_momentum = columns(
        &["base_momentum_regressor_at", "base_drift_regressor_at"],
        &base,
    );
    let memory = (sizes.states > 0).then(|| {
        quote! {
            use ::robot_model::Memory;
            #[automatically_derived]
            impl Memory #all for #name {
                const STATES: [&'static str; #states] = [""; #states];
                fn state_rates_at<S: Scalar>(_: #state, _: #given) -> SVector<S, #states> #none
                fn memory_after<S: Scalar>(&self, _: #state, _: f64) -> SVector<S, #states> #none
            }
        }
    });
    let place = match sizes.points {
        None => quote! {
            use ::robot_model::Kinematics;
            #[automatically_derived]
            impl Kinematics<#dof> for #name {
                fn forward_kinematics<S: Scalar>(&self, _: #vector) -> [SMatrix<S, 4, 4>; #dof] #none
                fn jacobian<S: Scalar>(&self, _: #vector) -> SMatrix<S, 6, #dof> #none
            }
        },
        Some(0) => TokenStream::new(),
        Some(points) => {
            let points = n(points);
            quote! {
                use ::robot_model::Points;
                #[automatically_derived]
                impl Points<#dof, #points> for #name {
                    const POINTS: [&'static str; #points] = [""; #points];
                    fn points<S: Scalar>(&self, _: #vector) -> [SVector<S, 3>; #points] #none
                    fn point_jacobians<S: Scalar>(&self, _: #vector) -> [SMatrix<S, 3, #dof>; #points] #none
                }
            }
        }
    };
    quote! {
        const _: () = {
            use ::robot_model::model::{SMatrix, SVector};
            use ::robot_model::{FromParameters, Mechanics, RobotModel, Scalar, State, Vector};
            #[automatically_derived]
            impl RobotModel #all for #name {
                const NAME: &'static str = "";
                const JOINTS: [&'static str; #dof] = [""; #dof];
                const STANDARD_PARAMETERS: [&'static str; #standard] = [""; #standard];
                const BASE_PARAMETERS: [&'static str; #base] = [""; #base];
                const SHAPE_PARAMETERS: [&'static str; #shapes] = [""; #shapes];
                const INPUTS: [&'static str; #inputs] = [""; #inputs];
                const NOMINAL: [f64; #standard] = [0.0; #standard];
                const NOMINAL_SHAPES: [f64; #shapes] = [0.0; #shapes];
                fn base_parameters(_: &Vector<#standard>) -> Vector<#base> #none
                fn standard(&self) -> Vector<#standard> #none
                fn shapes(&self) -> Vector<#shapes> #none
                fn mass_matrix<S: Scalar>(&self, _: #vector) -> #square #none
                fn coriolis_matrix<S: Scalar>(&self, _: #vector, _: #vector) -> #square #none
                fn gravity<S: Scalar>(&self, _: #vector) -> SVector<S, #dof> #none
                fn bias<S: Scalar>(&self, _: #vector, _: #vector) -> SVector<S, #dof> #none
                fn inverse_dynamics_at<S: Scalar>(&self, _: #state) -> SVector<S, #dof> #none
                #regressor
                #base_regressor
            }
            #[automatically_derived]
            impl FromParameters #all for #name {
                fn from_parameters(_: &Vector<#standard>, _: #given) -> Self #none
                fn standard_of(_: &Vector<#base>) -> Vector<#standard> #none
            }
            #[automatically_derived]
            impl Mechanics #all for #name {
                fn kinetic_energy<S: Scalar>(&self, _: #vector, _: #vector) -> S #none
                fn potential_energy<S: Scalar>(&self, _: #vector) -> S #none
                fn forward_dynamics_at<S: Scalar>(&self, _: #state, _: #vector) -> Option<SVector<S, #dof>> #none
                fn inverse_dynamics_by_position_at<S: Scalar>(&self, _: #state) -> #square #none
                fn inverse_dynamics_by_velocity_at<S: Scalar>(&self, _: #state) -> #square #none
                #momentum
                #base_momentum
            }
            #memory
            #place
        };
    }
}
