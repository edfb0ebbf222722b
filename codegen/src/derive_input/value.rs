//! The struct's value as vectors of parameters, and back.

use proc_macro2::{Literal, Span, TokenStream};
use quote::quote;
use robot_model_spec::model::{Energies, Monomial};
use robot_model_spec::parameter::{Owner, Status};

use super::bind::Held;
use super::fields::Robot;
use super::holds::{Effects, Holds, identifier};
use crate::compiled::Compiled;
use crate::emit::rust::{From, Parameters, number};

/// How the struct holds the parameters of the compiled model.
pub fn parameters(robot: &Robot, compiled: &Compiled, held: &[Held]) -> Parameters {
    let standard =
        compiled
            .standard
            .iter()
            .map(|parameter| match (parameter.status, parameter.owner) {
                (Status::Fixed(value), _) => number(value),
                (_, Owner::Link { link, element }) => {
                    let field = robot.fields[at(held, |held| held.link == Some(link))].name;
                    let element = element_place(element as usize);
                    quote!(self.#field.inertial.#element)
                }
                (_, Owner::Monomial(k)) => product(robot, compiled, held, k),
                (_, Owner::Effect { effect, parameter }) => {
                    let name = &compiled.model.effects[effect].definition.linear[parameter].name;
                    let (place, name) = (effect_place(robot, held, effect), word(name));
                    quote!(#place.#name)
                }
            });
    let standard = quote!([#(#standard),*].into());
    let shapes = compiled
        .model
        .effects
        .iter()
        .enumerate()
        .flat_map(|(effect, declared)| {
            let place = effect_place(robot, held, effect);
            declared.definition.shapes.iter().map(move |shape| {
                let name = word(&shape.name);
                quote!(#place.#name)
            })
        });
    let shapes = quote!([#(#shapes),*].into());
    Parameters {
        standard,
        beta: None,
        shapes,
        from: from_vector(robot, compiled, held).map(From::Standard),
    }
}

fn word(name: &str) -> proc_macro2::Ident {
    identifier(name, Span::call_site())
}

fn at(held: &[Held], is_it: impl Fn(&Held) -> bool) -> usize {
    held.iter()
        .position(is_it)
        .expect("checked in bind: every unknown is held")
}

/// Places of the ten inertial parameters, in their order.
fn element_place(element: usize) -> TokenStream {
    let index = |k: usize| Literal::usize_unsuffixed(k);
    match element {
        0 => quote!(mass),
        1..=3 => {
            let k = index(element - 1);
            quote!(first_moments[#k])
        }
        _ => {
            let k = index(element - 4);
            quote!(inertia[#k])
        }
    }
}

/// `self.shoulder.effects.1`
fn effect_place(robot: &Robot, held: &[Held], effect: usize) -> TokenStream {
    let k = at(held, |held| held.effects.contains(&Some(effect)));
    let slot = held[k].effects.iter().position(|&one| one == Some(effect));
    let slot = Literal::usize_unsuffixed(slot.expect("found in this field"));
    let field = robot.fields[k].name;
    let (inside, effects) = match &robot.fields[k].holds {
        Holds::Link(effects) => (quote!(self.#field.effects), effects),
        Holds::Effects(effects) => (quote!(self.#field), effects),
        Holds::Number => unreachable!("a number holds no effects"),
    };
    if effects.is_tuple {
        quote!(#inside.#slot)
    } else {
        inside
    }
}

fn energies(compiled: &Compiled) -> &Energies {
    let energies = compiled.model.energies();
    energies.expect("only robots of energies have monomials and unknown constants")
}

/// `self.m2 * self.l1 * self.c2`
fn product(robot: &Robot, compiled: &Compiled, held: &[Held], monomial: usize) -> TokenStream {
    let mut tokens = TokenStream::new();
    for &(k, exponent) in &energies(compiled).monomials[monomial].factors {
        let field = robot.fields[at(held, |held| held.parameter == Some(k))].name;
        for _ in 0..exponent.unsigned_abs() {
            tokens = match (tokens.is_empty(), exponent > 0) {
                (true, true) => quote!(self.#field),
                (true, false) => quote!(1.0 / self.#field),
                (false, true) => quote!(#tokens * self.#field),
                (false, false) => quote!(#tokens / self.#field),
            };
        }
    }
    tokens
}

/// `Self { .. }` from `standard` and `shapes`; `None` where the unknowns are factors of products.
fn from_vector(robot: &Robot, compiled: &Compiled, held: &[Held]) -> Option<TokenStream> {
    let mut fields = Vec::new();
    for (field, held) in robot.fields.iter().zip(held) {
        let name = field.name;
        let value = match &field.holds {
            Holds::Link(effects) => {
                let link = held.link.expect("checked in bind: a link is held");
                let ten = (10 * link..10 * link + 10).map(|k| entry(&quote!(standard), k));
                let effects = effect_values(compiled, effects, &held.effects);
                quote! {
                    ::robot_model::Link {
                        inertial: <::robot_model::Inertial as ::core::convert::From<[f64; 10]>>::from([#(#ten),*]),
                        effects: #effects,
                    }
                }
            }
            Holds::Effects(effects) => effect_values(compiled, effects, &held.effects),
            Holds::Number => {
                let parameter = held
                    .parameter
                    .expect("checked in bind: a number is a constant");
                let alone = |monomial: &Monomial| monomial.factors == [(parameter, 1)];
                let monomials = &energies(compiled).monomials;
                entry(&quote!(standard), monomials.iter().position(alone)?)
            }
        };
        fields.push(quote!(#name: #value));
    }
    // A constant that stands alone in one term and in a product in another is not free in the vector.
    let is_linear = compiled.model.energies().is_none_or(|energies| {
        energies
            .monomials
            .iter()
            .all(|monomial| matches!(monomial.factors.as_slice(), [] | [(_, 1)]))
    });
    is_linear.then(|| quote!(Self { #(#fields),* }))
}

fn entry(vector: &TokenStream, k: usize) -> TokenStream {
    let k = Literal::usize_unsuffixed(k);
    quote!(#vector[#k])
}

/// `(ViscousFriction { fv: standard[20] }, ..)`
fn effect_values(compiled: &Compiled, effects: &Effects, held: &[Option<usize>]) -> TokenStream {
    let values = effects.types.iter().zip(held).map(|(one, effect)| {
        let effect = effect.expect("checked in bind: every type is an effect");
        let definition = &compiled.model.effects[effect].definition;
        let first_standard = compiled.standard.iter().position(
            |parameter| matches!(parameter.owner, Owner::Effect { effect: own, .. } if own == effect),
        );
        let first_standard = first_standard.unwrap_or_default();
        let first_shape: usize = compiled.model.effects[..effect]
            .iter()
            .map(|effect| effect.shapes.len())
            .sum();
        let linear = definition.linear.iter().enumerate().map(|(k, linear)| {
            let (name, value) = (word(&linear.name), entry(&quote!(standard), first_standard + k));
            quote!(#name: #value)
        });
        let shapes = definition.shapes.iter().enumerate().map(|(k, shape)| {
            let (name, value) = (word(&shape.name), entry(&quote!(shapes), first_shape + k));
            quote!(#name: #value)
        });
        let path = &one.path;
        quote!(#path { #(#linear,)* #(#shapes,)* })
    });
    if effects.is_tuple || effects.types.is_empty() {
        quote!((#(#values,)*))
    } else {
        quote!(#(#values)*)
    }
}
