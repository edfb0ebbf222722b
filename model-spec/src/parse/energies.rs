//! `coordinates ..;`, `parameters ..;`, `constants ..;`, `let ..;`, `point ..;` of a robot that says its energies.

use syn::Token;
use syn::parse::ParseStream;

use super::word;
use crate::ast::{Binding, Constant, Coordinate, Energies, Expr, Parameter};

/// Behind the word that begins the statement, up to its semicolon.
pub(super) fn statement(
    input: ParseStream,
    keyword: &str,
    doc: &str,
    energies: &mut Energies,
) -> syn::Result<()> {
    match keyword {
        "coordinates" => list(input, coordinate, &mut energies.coordinates),
        "parameters" => list(
            input,
            |input| parameter(input, doc),
            &mut energies.parameters,
        ),
        "constants" => list(input, constant, &mut energies.constants),
        _ => {
            energies.points.push(point(input)?);
            Ok(())
        }
    }
}

/// `item, item, ..`
fn list<T>(
    input: ParseStream,
    item: impl Fn(ParseStream) -> syn::Result<T>,
    items: &mut Vec<T>,
) -> syn::Result<()> {
    loop {
        items.push(item(input)?);
        if !input.peek(Token![,]) {
            return Ok(());
        }
        input.parse::<Token![,]>()?;
    }
}

fn coordinate(input: ParseStream) -> syn::Result<Coordinate> {
    Ok(Coordinate {
        name: word(input, "the name of a coordinate")?,
        unit: unit(input)?,
    })
}

fn parameter(input: ParseStream, doc: &str) -> syn::Result<Parameter> {
    let name = word(input, "the name of a parameter")?;
    let unit = unit(input)?;
    let nominal = if input.peek(Token![=]) {
        input.parse::<Token![=]>()?;
        Some(input.parse()?)
    } else {
        None
    };
    Ok(Parameter {
        doc: doc.to_owned(),
        name,
        unit,
        nominal,
    })
}

fn constant(input: ParseStream) -> syn::Result<Constant> {
    let name = word(input, "the name of a constant")?;
    equals(input, &name)?;
    Ok(Constant {
        name,
        value: input.parse()?,
    })
}

/// Behind the word `let`.
pub(super) fn binding(input: ParseStream) -> syn::Result<Binding> {
    let name = word(input, "a name for the value")?;
    equals(input, &name)?;
    Ok(Binding {
        name,
        value: input.parse()?,
    })
}

fn point(input: ParseStream) -> syn::Result<Binding<Vec<Expr>>> {
    let name = word(input, "a name for the point")?;
    equals(input, &name)?;
    let content;
    syn::bracketed!(content in input);
    let position = content.parse_terminated(<Expr as syn::parse::Parse>::parse, Token![,])?;
    Ok(Binding {
        name,
        value: position.into_iter().collect(),
    })
}

fn equals(input: ParseStream, name: &syn::Ident) -> syn::Result<()> {
    if input.peek(Token![=]) {
        return input.parse::<Token![=]>().map(drop);
    }
    Err(crate::diagnostic::syn_error(
        input.span(),
        &format!("expected `=` after `{name}`{}", super::found(input)),
        Some(&format!("write `{name} = ..`")),
    ))
}

/// `: kg*m^2`
fn unit(input: ParseStream) -> syn::Result<Option<Expr>> {
    if !input.peek(Token![:]) {
        return Ok(None);
    }
    input.parse::<Token![:]>()?;
    input.parse().map(Some)
}
