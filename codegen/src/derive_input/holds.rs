//! What a field holds, by the tokens of its type.

use proc_macro2::{Ident, Span, TokenStream};
use syn::spanned::Spanned;
use syn::{GenericArgument, Path, PathArguments, Type};

use super::mistake::mistake;

/// What a field holds.
pub enum Holds {
    /// `Link<..>`: ten inertial parameters, and effects.
    Link(Effects),
    /// `(A, B)`, `A` or `()`: parameters of effects.
    Effects(Effects),
    /// `f64`: an unknown constant.
    Number,
}

impl Holds {
    /// The effects, where the type may hold some.
    pub fn effects(&self) -> &[EffectType] {
        match self {
            Self::Link(effects) | Self::Effects(effects) => &effects.types,
            Self::Number => &[],
        }
    }
}

/// A type that holds parameters of effects.
#[derive(Default)]
pub struct Effects {
    /// One entry per effect.
    pub types: Vec<EffectType>,
    /// `(A, B)`, not `A`.
    pub is_tuple: bool,
}

/// The type of one effect's parameters, such as `ViscousFriction`.
pub struct EffectType {
    /// The type as written.
    pub path: Path,
    /// The effect, such as `viscous_friction`, at the span of the type.
    pub effect: Ident,
    /// `#[effects(stribeck(vs = 0.1))]`: what stands in the parentheses.
    pub shapes: Option<TokenStream>,
}

/// Numbers that hold no parameter.
const PRIMITIVE: [&str; 13] = [
    "f32", "i8", "i16", "i32", "i64", "i128", "isize", "u8", "u16", "u32", "u64", "u128", "usize",
];

/// What the type of a field says that it holds.
pub fn holds(ty: &Type) -> syn::Result<Holds> {
    let Type::Path(path) = ty else {
        return Ok(Holds::Effects(effects(ty)?));
    };
    let last = path.path.segments.last().expect("a path has segments");
    if last.ident == "f64" {
        return Ok(Holds::Number);
    }
    if PRIMITIVE.iter().any(|number| last.ident == number) {
        return Err(mistake(
            ty.span(),
            format!("an unknown constant is an `f64`, not `{}`", last.ident),
        ));
    }
    if last.ident != "Link" {
        return Ok(Holds::Effects(effects(ty)?));
    }
    let PathArguments::AngleBracketed(arguments) = &last.arguments else {
        return Ok(Holds::Link(Effects::default()));
    };
    match arguments.args.first() {
        Some(GenericArgument::Type(ty)) if arguments.args.len() == 1 => {
            Ok(Holds::Link(effects(ty)?))
        }
        _ => Err(mistake(
            arguments.span(),
            "a link holds effects: write `Link`, `Link<ViscousFriction>` or `Link<(ViscousFriction, CoulombFriction)>`",
        )),
    }
}

fn effects(ty: &Type) -> syn::Result<Effects> {
    match ty {
        Type::Tuple(tuple) => Ok(Effects {
            types: tuple
                .elems
                .iter()
                .map(effect_type)
                .collect::<syn::Result<_>>()?,
            is_tuple: true,
        }),
        Type::Paren(inner) => effects(&inner.elem),
        single => Ok(Effects {
            types: vec![effect_type(single)?],
            is_tuple: false,
        }),
    }
}

fn effect_type(ty: &Type) -> syn::Result<EffectType> {
    if let Type::Path(path) = ty
        && path.qself.is_none()
        && let Some(last) = path.path.segments.last()
        && last.arguments.is_none()
    {
        let effect = identifier(&snake_case(&last.ident.to_string()), last.ident.span());
        return Ok(EffectType {
            path: path.path.clone(),
            effect,
            shapes: None,
        });
    }
    Err(mistake(
        ty.span(),
        "a field holds `Link<..>`, effects such as `ViscousFriction` or `(ViscousFriction, Stribeck)`, or `f64`",
    ))
}

/// `ViscousFriction` is `viscous_friction`.
pub fn snake_case(name: &str) -> String {
    let mut snake = String::new();
    for (k, c) in name.chars().enumerate() {
        if c.is_ascii_uppercase() && k > 0 {
            snake.push('_');
        }
        snake.push(c.to_ascii_lowercase());
    }
    snake
}

/// `viscous_friction` is `ViscousFriction`.
pub fn type_name(effect: &str) -> String {
    let words = effect.split('_').filter(|word| !word.is_empty());
    let camel = words.flat_map(|word| {
        let mut letters = word.chars();
        let first = letters.next().map(|first| first.to_ascii_uppercase());
        first.into_iter().chain(letters)
    });
    camel.collect()
}

/// An identifier, raw where the word is one of Rust's.
pub fn identifier(text: &str, span: Span) -> Ident {
    if syn::parse_str::<Ident>(text).is_ok() {
        return Ident::new(text, span);
    }
    match text {
        "self" | "super" | "crate" | "Self" | "_" => Ident::new(&format!("{text}_"), span),
        _ => Ident::new_raw(text, span),
    }
}
