//! `effect name(j, k) { linear ..; shape ..; input ..; state ..; let ..; dot(z) = ..; torque(j) = ..; }`, and the acts that
//! are no torques.

use proc_macro2::{Span, TokenTree};
use syn::parse::{Parse, ParseStream};
use syn::{Ident, Token};

use super::{Sink, block, doc_comment, found, semicolon, statements, with_sink, word};
use crate::ast::{Act, ActKind, Effect, Equation, Expr, Input, Let, Linear, Shape, State};
use crate::diagnostic::syn_error;

/// Behind the word `effect`.
pub(super) fn effect(input: ParseStream, doc: String, errors: &mut Sink) -> syn::Result<Effect> {
    let name = word(input, "the effect's name")?;
    if !input.peek(syn::token::Paren) {
        return Err(syn_error(
            input.span(),
            &format!("effect `{name}` does not name the joints it acts on"),
            Some(&format!(
                "write `effect {name}(j) {{ .. }}`, `effect {name}(j, k) {{ .. }}` for two joints, or `effect {name}() {{ .. }}` \
                 for the arm as a whole"
            )),
        ));
    }
    let content;
    syn::parenthesized!(content in input);
    let joints = content.parse_terminated(|input| word(input, "a name for a joint"), Token![,])?;
    let (content, _) = block(input, "`{` and the effect's equations")?;

    let joints = joints.into_iter().collect();
    let mut effect = Effect {
        doc,
        name,
        joints,
        kind: None,
        linear: vec![],
        shapes: vec![],
        inputs: vec![],
        states: vec![],
        lets: vec![],
        rates: vec![],
        torques: vec![],
        acts: vec![],
    };
    statements(&content, errors, |input, _| statement(input, &mut effect));
    Ok(effect)
}

fn statement(input: ParseStream, effect: &mut Effect) -> syn::Result<()> {
    let doc = doc_comment(input)?;
    let keyword = word(input, "`linear`, `shape` or `torque`")?;
    match keyword.to_string().as_str() {
        "kind" => kind(input, keyword.span(), &mut effect.kind)?,
        "linear" => linear(input, &doc, &mut effect.linear)?,
        "shape" => effect.shapes.push(shape(input, doc)?),
        "input" => effect.inputs.push(read_input(input, doc)?),
        "state" => states(input, &doc, &mut effect.states)?,
        "let" => effect.lets.push(binding(input)?),
        "dot" => effect
            .rates
            .push(equation(input, "one of the effect's states")?),
        "torque" => effect
            .torques
            .push(equation(input, "one of the effect's joints")?),
        word => match ActKind::ALL.into_iter().find(|(name, _)| *name == word) {
            Some((_, kind)) => effect.acts.push(act(input, kind, keyword)?),
            None => {
                return Err(syn_error(
                    keyword.span(),
                    &format!("an effect has no `{keyword}`"),
                    Some(
                        "write `kind name;`, `linear name;`, `shape name in low .. high;`, `input name;`, `state z;`, `let name = ..;`, \
                         `dot(z) = ..;`, `torque(j) = ..;`, `force(j) = [..];`, `position(j) = ..;`, `body(j) = [..];`, \
                         `tilt = [..];` or `delay = ..;`",
                    ),
                ));
            }
        },
    }
    semicolon(input)
}

/// `name`, once.
fn kind(input: ParseStream, keyword: Span, kind: &mut Option<Ident>) -> syn::Result<()> {
    let name = word(input, "the effect that it is a case of")?;
    if kind.is_some() {
        return Err(syn_error(
            keyword,
            "an effect is of one kind",
            Some("keep one `kind`, the effect's name in reports and JSON"),
        ));
    }
    *kind = Some(name);
    Ok(())
}

/// `a, b >= 0, c`
fn linear(input: ParseStream, doc: &str, parameters: &mut Vec<Linear>) -> syn::Result<()> {
    loop {
        let name = word(input, "the name of a linear parameter")?;
        let nonnegative = input.peek(Token![>=]);
        if nonnegative {
            input.parse::<Token![>=]>()?;
            let bound: TokenTree = input.parse()?;
            if bound.to_string() != "0" {
                return Err(syn_error(
                    bound.span(),
                    "the only bound of a linear parameter is `>= 0`",
                    Some("choose the parameter's sign so that it is not negative"),
                ));
            }
        }
        parameters.push(Linear {
            doc: doc.to_owned(),
            name,
            nonnegative,
        });
        if !input.peek(Token![,]) {
            return Ok(());
        }
        input.parse::<Token![,]>()?;
    }
}

/// `name in low .. high step s`
fn shape(input: ParseStream, doc: String) -> syn::Result<Shape> {
    let name = word(input, "the name of a shape parameter")?;
    if !input.peek(Token![in]) {
        return Err(syn_error(
            input.span(),
            &format!("shape parameter `{name}` has no range{}", found(input)),
            Some(&format!("write `shape {name} in low .. high;`")),
        ));
    }
    input.parse::<Token![in]>()?;
    let low: Expr = input.parse()?;
    input.parse::<Token![..]>()?;
    let high: Expr = input.parse()?;
    let step = if input.peek(Ident) && word(&input.fork(), "`step`")? == "step" {
        word(input, "`step`")?;
        Some(input.parse()?)
    } else {
        None
    };
    Ok(Shape {
        doc,
        name,
        low,
        high,
        step,
    })
}

/// `temperature`, `current(j)`
fn read_input(input: ParseStream, doc: String) -> syn::Result<Input> {
    let name = word(input, "the name of a column of the log")?;
    let joint = if input.peek(syn::token::Paren) {
        let content;
        syn::parenthesized!(content in input);
        Some(word(&content, "one of the effect's joints")?)
    } else {
        None
    };
    Ok(Input { doc, name, joint })
}

/// `z, w`
fn states(input: ParseStream, doc: &str, states: &mut Vec<State>) -> syn::Result<()> {
    loop {
        let name = word(input, "the name of a state")?;
        if input.peek(Token![=]) {
            return Err(syn_error(
                input.span(),
                &format!("state `{name}` is given a value"),
                Some(&format!(
                    "write `state {name};`: a state is 0 when a log starts"
                )),
            ));
        }
        states.push(State {
            doc: doc.to_owned(),
            name,
        });
        if !input.peek(Token![,]) {
            return Ok(());
        }
        input.parse::<Token![,]>()?;
    }
}

/// `name = ..`
fn binding(input: ParseStream) -> syn::Result<Let> {
    let name = word(input, "a name")?;
    input.parse::<Token![=]>()?;
    Ok(Let {
        name,
        value: input.parse()?,
    })
}

/// `(j) = ..`
fn equation(input: ParseStream, of: &str) -> syn::Result<Equation> {
    let of = in_parentheses(input, of)?;
    input.parse::<Token![=]>()?;
    Ok(Equation {
        of,
        value: input.parse()?,
    })
}

/// `(j) = ..` or `= ..`, with one expression or a list of them.
fn act(input: ParseStream, kind: ActKind, keyword: Ident) -> syn::Result<Act> {
    let of = if kind.has_joint() {
        Some(in_parentheses(input, "one of the effect's joints")?)
    } else {
        None
    };
    input.parse::<Token![=]>()?;
    let values = if input.peek(syn::token::Bracket) {
        let content;
        syn::bracketed!(content in input);
        let values = content.parse_terminated(Expr::parse, Token![,])?;
        values.into_iter().collect()
    } else {
        vec![input.parse()?]
    };
    Ok(Act {
        kind,
        keyword,
        of,
        values,
    })
}

fn in_parentheses(input: ParseStream, wanted: &str) -> syn::Result<Ident> {
    let content;
    syn::parenthesized!(content in input);
    word(&content, wanted)
}

impl Parse for Effect {
    /// Behind the word `effect`.
    fn parse(input: ParseStream) -> syn::Result<Self> {
        with_sink(|errors| effect(input, String::new(), errors))?
    }
}
