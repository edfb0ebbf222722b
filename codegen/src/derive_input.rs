//! `#[derive(RobotModel)]`: the attributes of a struct are put together to the text of a spec, token by token.
//!
//! In: a struct whose fields are the joints. Out: `impl RobotModel` for it. The tokens keep their spans, so a mistake is
//! told where it was written, in the words of the language.
//!
//! ```text
//! #[robot(convention = standard_dh, gravity = [0, -9.81, 0])]
//! #[effects(gear_coupling on (shoulder, elbow))]              // effects on several joints
//! struct Arm {
//!     #[joint(revolute, a = 0.5, alpha = 0, d = 0)]
//!     #[inertial(fixed, mass = 1.2, com = [0, 0, 0], inertia = [..])]
//!     #[effects(viscous_friction, stribeck(vs = 0.1))]
//!     shoulder: (),
//!     ..
//! }
//! ```

use proc_macro2::{Ident, TokenStream, TokenTree};
use quote::{quote, quote_spanned};
use syn::spanned::Spanned;
use syn::{Attribute, Data, DeriveInput, Field, Fields, Meta};

use crate::base::RankStatus;
use crate::compiled::compile_model;
use crate::emit;

/// What the derive writes; mistakes become `compile_error!` where they were made.
#[must_use]
pub fn derive(input: TokenStream) -> TokenStream {
    implementation(input).unwrap_or_else(|error| error.to_compile_error())
}

fn implementation(input: TokenStream) -> syn::Result<TokenStream> {
    let input: DeriveInput = syn::parse2(input)?;
    let ast = robot_model_spec::parse_tokens(spec(&input)?)?;
    let name = &input.ident;
    let model = robot_model_spec::check(&ast, &name.to_string()).map_err(|mistakes| {
        let errors = mistakes
            .iter()
            .map(robot_model_spec::Diagnostic::to_syn_error);
        errors
            .reduce(|mut all, error| {
                all.combine(error);
                all
            })
            .unwrap_or_else(|| syn::Error::new(name.span(), "the spec has mistakes"))
    })?;
    let compiled = compile_model(&model);
    if let RankStatus::Unclear(_) = compiled.base.rank {
        return Err(syn::Error::new(
            name.span(),
            format!("base parameters are not certain: {}", compiled.base.rank),
        ));
    }
    let implementation = emit::rust::implementation_for(&compiled, name);
    let reads = reads_of_joints(&input);
    Ok(quote!(#implementation #reads))
}

/// The fields carry attributes only, and nobody reads them; rustc need not warn of that.
fn reads_of_joints(input: &DeriveInput) -> TokenStream {
    let name = &input.ident;
    let joints: Vec<_> = match &input.data {
        Data::Struct(data) => data.fields.iter().map(|field| &field.ident).collect(),
        _ => Vec::new(),
    };
    quote! {
        const _: () = {
            #[allow(dead_code, reason = "reads the joints once")]
            fn joints(robot: &#name) {
                #(let _ = &robot.#joints;)*
            }
        };
    }
}

/// The struct as a spec: `robot Name { .. }`.
fn spec(input: &DeriveInput) -> syn::Result<TokenStream> {
    let Data::Struct(data) = &input.data else {
        return Err(syn::Error::new(
            input.ident.span(),
            "a robot is a struct: its fields are the joints",
        ));
    };
    let Fields::Named(fields) = &data.fields else {
        return Err(syn::Error::new(
            input.ident.span(),
            "joints have names: write a struct with named fields",
        ));
    };
    if !input.generics.params.is_empty() {
        return Err(syn::Error::new(
            input.generics.span(),
            "a robot's struct has no generic parameters",
        ));
    }
    let name = &input.ident;
    let settings = statements(segments(&input.attrs, "robot")?);
    let mut effects = statements(segments(&input.attrs, "effects")?);
    let mut joints = TokenStream::new();
    for field in &fields.named {
        joints.extend(joint(field)?);
        let joint = &field.ident;
        for effect in segments(&field.attrs, "effects")? {
            effects.extend(quote!(#effect on #joint;));
        }
    }
    let effects = if effects.is_empty() {
        quote!()
    } else {
        quote!(effects { #effects })
    };
    Ok(quote_spanned!(name.span()=> robot #name { #settings #joints #effects }))
}

/// `joint name: kind { .. }` and its link.
fn joint(field: &Field) -> syn::Result<TokenStream> {
    let name = field.ident.as_ref().expect("fields are named");
    let mut settings = segments(&field.attrs, "joint")?.into_iter();
    let Some(kind) = settings.next() else {
        let message = format!(
            "joint `{name}` has no frame: write `#[joint(revolute, a = .., alpha = .., d = ..)]`"
        );
        return Err(syn::Error::new(name.span(), message));
    };
    let settings = statements(settings);
    let mut tokens = quote!(joint #name: #kind { #settings });
    let mut link = segments(&field.attrs, "inertial")?.into_iter().peekable();
    if link.peek().is_some() {
        let status = link.next_if(is_one_word).map(|status| quote!(: #status));
        let settings = statements(link);
        tokens.extend(quote!(link #name #status { #settings }));
    }
    Ok(tokens)
}

fn is_one_word(tokens: &TokenStream) -> bool {
    syn::parse2::<Ident>(tokens.clone()).is_ok()
}

/// `a; b; c;`
fn statements(segments: impl IntoIterator<Item = TokenStream>) -> TokenStream {
    segments
        .into_iter()
        .map(|segment| quote!(#segment;))
        .collect()
}

/// What stands between the commas of all attributes `#[name(..)]`.
fn segments(attributes: &[Attribute], name: &str) -> syn::Result<Vec<TokenStream>> {
    let mut segments = Vec::new();
    for attribute in attributes
        .iter()
        .filter(|attribute| attribute.path().is_ident(name))
    {
        let Meta::List(list) = &attribute.meta else {
            return Err(syn::Error::new(
                attribute.span(),
                format!("write `#[{name}(..)]`"),
            ));
        };
        let mut segment = TokenStream::new();
        for token in list.tokens.clone() {
            if matches!(&token, TokenTree::Punct(punct) if punct.as_char() == ',') {
                segments.push(std::mem::take(&mut segment));
            } else {
                segment.extend([token]);
            }
        }
        if !segment.is_empty() {
            segments.push(segment);
        }
    }
    Ok(segments)
}

#[cfg(test)]
mod tests {
    use super::*;

    const ARM: &str = "
        #[robot(convention = modified_dh, gravity = [0, -9.81, 0])]
        #[effects(gear_coupling on (shoulder, elbow))]
        struct Arm {
            #[joint(revolute, a = 0, alpha = 0, d = 0)]
            #[effects(viscous_friction, stribeck(vs = 0.1))]
            shoulder: (),
            #[joint(revolute, a = 0.5, alpha = 0 deg, d = 0)]
            #[inertial(nominal, mass = 1, com = [0.2, 0, 0], inertia = [0, 0, 0, 0, 0, 0.01])]
            elbow: (),
        }";

    fn derived(text: &str) -> String {
        derive(text.parse().expect("tokens")).to_string()
    }

    #[test]
    fn a_struct_of_joints_becomes_an_implementation() {
        let tokens = derived(ARM);
        assert!(
            tokens.contains("RobotModel <") && tokens.contains("for Arm"),
            "{tokens}"
        );
        assert!(tokens.contains("\"shoulder.stribeck.fs\""), "{tokens}");
        assert!(
            !tokens.contains("__comment") && !tokens.contains("compile_error"),
            "{tokens}"
        );
        syn::parse_str::<syn::File>(&tokens).expect("items");
    }

    #[test]
    fn mistakes_are_told_in_the_words_of_the_language() {
        for (from, to, expected) in [
            ("a = 0.5,", "b = 0.5,", "`b`"),
            ("viscous_friction,", "viscose_friction,", "viscose_friction"),
            (
                "#[joint(revolute, a = 0, alpha = 0, d = 0)]",
                "",
                "has no frame",
            ),
            ("struct Arm {", "struct Arm<T> {", "generic"),
        ] {
            let tokens = derived(&ARM.replace(from, to));
            assert!(
                tokens.contains("compile_error") && tokens.contains(expected),
                "{to}: {tokens}"
            );
        }
    }
}
