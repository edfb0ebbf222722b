//! A struct as the derive sees it: what is held by which field, judged by the tokens of its type.

use std::path::Path as FilePath;

use proc_macro2::{Ident, Span, TokenStream, TokenTree};
use syn::spanned::Spanned;
use syn::{Attribute, Data, DeriveInput, Field, Fields, Meta};

use super::holds::{EffectType, Holds, holds, snake_case, type_name};
use super::mistake::{Errors, mistake};

/// The struct.
pub struct Robot<'a> {
    /// Its name.
    pub name: &'a Ident,
    /// `#[robot(..)]`, entry by entry; without `file` and `effects`.
    pub settings: Vec<TokenStream>,
    /// `file = ".."`: the spec.
    pub file: Option<FileName>,
    /// `effects = ".."`: own effects.
    pub effects: Option<FileName>,
    /// Its fields.
    pub fields: Vec<RobotField<'a>>,
}

/// A file that an attribute names, relative to the crate's folder.
pub struct FileName {
    /// As written.
    pub name: String,
    /// Where.
    pub span: Span,
}

/// A field.
pub struct RobotField<'a> {
    /// Its name.
    pub name: &'a Ident,
    /// What its type says that it holds.
    pub holds: Holds,
    /// `#[joint(..)]`, entry by entry.
    pub joint: Option<Vec<TokenStream>>,
    /// `#[inertial(..)]`, entry by entry.
    pub inertial: Option<Vec<TokenStream>>,
    /// `#[on(a, b)]`: the joints of the field's effects.
    pub on: Option<Vec<Ident>>,
    /// Where the type stands.
    pub span: Span,
}

impl<'a> Robot<'a> {
    /// Reads the struct; all of its mistakes at once.
    pub fn new(input: &'a DeriveInput) -> syn::Result<Self> {
        let name = &input.ident;
        let Data::Struct(data) = &input.data else {
            return Err(mistake(
                name.span(),
                "a robot is a struct: its fields hold its unknowns",
            ));
        };
        if !input.generics.params.is_empty() {
            return Err(mistake(
                input.generics.span(),
                "a robot's struct has no generic parameters: write the types themselves",
            ));
        }
        let fields: Vec<&Field> = match &data.fields {
            Fields::Named(fields) => fields.named.iter().collect(),
            Fields::Unit => Vec::new(),
            Fields::Unnamed(_) => {
                return Err(mistake(
                    name.span(),
                    "a robot's fields have names: write a struct with named fields",
                ));
            }
        };
        let mut errors = Errors::default();
        let (mut file, mut effects, mut settings) = (None, None, Vec::new());
        let described = errors.keep(entries(&input.attrs, "robot")).flatten();
        for entry in described.into_iter().flatten() {
            match file_name(&entry, "file").or_else(|| file_name(&entry, "effects")) {
                None => match names_no_file(&entry) {
                    Some(mistake) => {
                        errors.keep::<()>(Err(mistake));
                    }
                    None => settings.push(entry),
                },
                Some((name, "file")) if file.is_none() => file = Some(name),
                Some((name, "effects")) if effects.is_none() => effects = Some(name),
                Some((name, key)) => errors.mistake(
                    name.span,
                    format!("`{key}` is given twice: remove one of them"),
                ),
            }
        }
        for name in ["joint", "inertial", "effects", "on"] {
            for attribute in named(&input.attrs, name) {
                errors.mistake(
                    attribute.path().span(),
                    format!("`#[{name}(..)]` belongs on a field: move it to its field"),
                );
            }
        }
        let fields = fields
            .into_iter()
            .filter_map(|field| errors.keep(RobotField::new(field)))
            .collect();
        errors.finish(Self {
            name,
            settings,
            file,
            effects,
            fields,
        })
    }
}

impl<'a> RobotField<'a> {
    fn new(field: &'a Field) -> syn::Result<Self> {
        let name = field.ident.as_ref().expect("fields are named");
        let mut holds = holds(&field.ty)?;
        let mut errors = Errors::default();
        let joint = errors.keep(entries(&field.attrs, "joint")).flatten();
        let inertial = errors.keep(entries(&field.attrs, "inertial")).flatten();
        let shapes = errors.keep(entries(&field.attrs, "effects")).flatten();
        let on = errors.keep(entries(&field.attrs, "on")).flatten();
        let on = on.map(|joints| {
            joints
                .into_iter()
                .filter_map(|joint| errors.keep(syn::parse2::<Ident>(joint)))
                .collect()
        });
        if let (None, Some(attribute)) = (&joint, named(&field.attrs, "inertial").next()) {
            errors.mistake(
                attribute.path().span(),
                format!("`{name}` has an inertial but no joint that moves it: write `#[joint(..)]`, or remove `#[inertial(..)]`"),
            );
        }
        if let (Some(_), Some(attribute)) = (&joint, named(&field.attrs, "on").next()) {
            errors.mistake(
                attribute.path().span(),
                format!(
                    "the effects of joint `{name}` act on `{name}`: give `#[on(..)]` its own field"
                ),
            );
        }
        for attribute in named(&field.attrs, "robot") {
            errors.mistake(
                attribute.path().span(),
                "`#[robot(..)]` belongs on the struct: move it there",
            );
        }
        let effects = match &mut holds {
            Holds::Link(effects) | Holds::Effects(effects) => effects.types.as_mut_slice(),
            Holds::Number => &mut [],
        };
        for entry in shapes.into_iter().flatten() {
            errors.keep(give_shapes(effects, &entry));
        }
        errors.finish(Self {
            name,
            holds,
            joint,
            inertial,
            on,
            span: field.ty.span(),
        })
    }
}

/// `stribeck(vs = 0.1)`: to the first effect of this name that has none yet.
fn give_shapes(effects: &mut [EffectType], entry: &TokenStream) -> syn::Result<()> {
    let mut tokens = entry.clone().into_iter();
    let (Some(TokenTree::Ident(name)), Some(TokenTree::Group(given)), None) =
        (tokens.next(), tokens.next(), tokens.next())
    else {
        return Err(mistake(
            entry.span(),
            "the field's type declares effects; this attribute sets their shape parameters: write `#[effects(stribeck(vs = 0.1))]`",
        ));
    };
    let wanted = effects
        .iter_mut()
        .find(|effect| effect.effect == name && effect.shapes.is_none());
    if let Some(effect) = wanted {
        effect.shapes = Some(given.stream());
        return Ok(());
    }
    let effect = snake_case(&name.to_string());
    let is_there = effects.iter().any(|one| one.effect == effect);
    let remedy = if is_there && name != effect {
        format!("write `{effect}`, the name of the effect")
    } else {
        format!("write `{}` in it", type_name(&effect))
    };
    Err(mistake(
        name.span(),
        format!("the field's type declares no effect `{name}`: {remedy}"),
    ))
}

/// Files that the struct names, also where it has mistakes.
pub fn files(input: &DeriveInput) -> impl Iterator<Item = String> {
    let entries = entries(&input.attrs, "robot").ok().flatten();
    entries
        .into_iter()
        .flatten()
        .filter_map(|entry| {
            let found = file_name(&entry, "file").or_else(|| file_name(&entry, "effects"));
            found.map(|(file, _)| file.name)
        })
        // Refused where they are read.
        .filter(|file| !FilePath::new(file).is_absolute())
}

/// `key = "name"`
fn file_name(entry: &TokenStream, key: &'static str) -> Option<(FileName, &'static str)> {
    let pair: syn::MetaNameValue = syn::parse2(entry.clone()).ok()?;
    let syn::Expr::Lit(syn::ExprLit {
        lit: syn::Lit::Str(name),
        ..
    }) = &pair.value
    else {
        return None;
    };
    pair.path.is_ident(key).then(|| {
        let file = FileName {
            name: name.value(),
            span: name.span(),
        };
        (file, key)
    })
}

/// `file = 12`
fn names_no_file(entry: &TokenStream) -> Option<syn::Error> {
    let mut tokens = entry.clone().into_iter();
    let key = match tokens.next() {
        Some(TokenTree::Ident(key)) if key == "file" || key == "effects" => key,
        _ => return None,
    };
    Some(mistake(
        entry.span(),
        format!("`{key}` is the name of a file: write `{key} = \"arm.robot\"`"),
    ))
}

fn named<'a>(attributes: &'a [Attribute], name: &str) -> impl Iterator<Item = &'a Attribute> {
    attributes
        .iter()
        .filter(move |attribute| attribute.path().is_ident(name))
}

/// What stands between the commas of `#[name(..)]`; `None` where the attribute is not there.
fn entries(attributes: &[Attribute], name: &str) -> syn::Result<Option<Vec<TokenStream>>> {
    let mut found = named(attributes, name);
    let Some(attribute) = found.next() else {
        return Ok(None);
    };
    if let Some(second) = found.next() {
        return Err(mistake(
            second.path().span(),
            format!("`#[{name}(..)]` appears twice: write its entries into the first"),
        ));
    }
    let Meta::List(list) = &attribute.meta else {
        return Err(mistake(
            attribute.path().span(),
            format!("the entries of `{name}` need parentheses: write `#[{name}(..)]`"),
        ));
    };
    let (mut entries, mut entry) = (Vec::new(), TokenStream::new());
    for token in list.tokens.clone() {
        if matches!(&token, TokenTree::Punct(punct) if punct.as_char() == ',') {
            entries.push(std::mem::take(&mut entry));
        } else {
            entry.extend([token]);
        }
    }
    if !entry.is_empty() {
        entries.push(entry);
    }
    Ok(Some(entries))
}
