//! Text or tokens to [`Ast`]; accepts generously, judges nothing but the grammar.
//!
//! One `syn` front end serves files and macros. A statement that does not parse is reported and skipped, so that one run
//! shows the mistakes of all statements.

mod brackets;
mod effect;
mod energies;
mod expr;
mod log;
mod robot;

use std::str::FromStr;

use proc_macro2::{Span, TokenStream, TokenTree};
use syn::parse::{Parse, ParseStream, Parser};
use syn::spanned::Spanned;
use syn::{Attribute, Ident, Token};

use crate::ast::Ast;
#[cfg(feature = "log-settings")]
use crate::ast::Expr;
use crate::diagnostic::{Diagnostic, syn_error};

/// Brackets in brackets; a robot needs five. Keeps recursion away from the stack's end.
const MAX_NESTING: usize = 48;

/// Characters of a name. Names stand in tables, messages and file formats, and no person writes longer ones.
const LONGEST_NAME: usize = 64;

/// Parses a spec's text.
pub(crate) fn parse_text(text: &str) -> Result<Ast, Vec<Diagnostic>> {
    parse_tokens(tokens(text)?).map_err(|error| Diagnostic::from_syn(error).collect())
}

/// Parses a text that is one value, such as `360 deg/4096`.
#[cfg(feature = "log-settings")]
pub(crate) fn parse_value(text: &str) -> Result<Expr, Vec<Diagnostic>> {
    let tokens = tokens(text)?;
    let value = check_tokens(&tokens).and_then(|()| expr::alone.parse2(tokens));
    value.map_err(|error| Diagnostic::from_syn(error).collect())
}

/// The tokens of a text.
fn tokens(text: &str) -> Result<TokenStream, Vec<Diagnostic>> {
    TokenStream::from_str(text).map_err(|error| {
        let has_hash = text
            .lines()
            .any(|line| line.contains('#') && !line.trim_start().starts_with("//"));
        let comments = if has_hash {
            "; comments begin with `//`, not with `#`"
        } else {
            ""
        };
        let general = || {
            Diagnostic::new(
                error.span(),
                "the text is not made of words, numbers and brackets",
                "from here on",
            )
            .help(format!(
                "remove characters that belong to no word or number, and close every `\"`{comments}"
            ))
        };
        vec![brackets::unbalanced(text).unwrap_or_else(general)]
    })
}

/// Parses the tokens of a spec, from a file or from a macro's input.
///
/// # Errors
/// All grammar errors, combined.
pub fn parse_tokens(tokens: TokenStream) -> syn::Result<Ast> {
    check_tokens(&tokens)?;
    Ast::parse.parse2(tokens)
}

/// Refuses deep nesting and long names before anything else sees them.
fn check_tokens(tokens: &TokenStream) -> syn::Result<()> {
    let mut open = vec![tokens.clone().into_iter()];
    while let Some(level) = open.last_mut() {
        match level.next() {
            Some(TokenTree::Group(group)) => {
                if open.len() > MAX_NESTING {
                    return Err(syn_error(
                        group.span_open(),
                        &format!("brackets are nested more than {MAX_NESTING} deep"),
                        Some("remove some of them; no equation needs so many"),
                    ));
                }
                open.push(group.stream().into_iter());
            }
            Some(TokenTree::Ident(name)) if name.to_string().chars().count() > LONGEST_NAME => {
                return Err(syn_error(
                    name.span(),
                    &format!("a name of more than {LONGEST_NAME} characters"),
                    Some("write a shorter one"),
                ));
            }
            Some(_) => {}
            None => {
                open.pop();
            }
        }
    }
    Ok(())
}

impl Parse for Ast {
    fn parse(input: ParseStream) -> syn::Result<Self> {
        let mut ast = Self::default();
        with_sink(|errors| {
            statements(input, errors, |input, errors| {
                let doc = doc_comment(input)?;
                let keyword: Ident = word(input, "`robot` or `effect`")?;
                match keyword.to_string().as_str() {
                    "robot" => ast.robots.push(robot::robot(input, errors)?),
                    "effect" => ast.effects.push(effect::effect(input, doc, errors)?),
                    other => {
                        return Err(syn_error(
                            keyword.span(),
                            &format!("expected `robot` or `effect`, found `{other}`"),
                            Some("write `robot Name { .. }` or `effect name(j) { .. }`"),
                        ));
                    }
                }
                Ok(())
            });
        })?;
        Ok(ast)
    }
}

/// Errors of one parse, in the order in which they were met.
type Sink = Vec<syn::Error>;

/// Runs a parser that collects errors, and combines them.
fn with_sink<T>(parse: impl FnOnce(&mut Sink) -> T) -> syn::Result<T> {
    let mut errors = Sink::new();
    let value = parse(&mut errors);
    let mut errors = errors.into_iter();
    match errors.next() {
        None => Ok(value),
        Some(mut first) => {
            errors.for_each(|error| first.combine(error));
            Err(first)
        }
    }
}

/// Parses statements until the end of `input`; after one that fails, goes on behind its `;` or `{ .. }`.
fn statements(
    input: ParseStream,
    errors: &mut Sink,
    mut statement: impl FnMut(ParseStream, &mut Sink) -> syn::Result<()>,
) {
    while !input.is_empty() {
        if let Err(error) = statement(input, errors) {
            errors.push(error);
            skip_statement(input);
        }
    }
}

fn skip_statement(input: ParseStream) {
    while let Ok(token) = input.parse::<TokenTree>() {
        match token {
            TokenTree::Punct(punct) if punct.as_char() == ';' => return,
            // Behind the braces of a choice its statement goes on.
            TokenTree::Group(group)
                if group.delimiter() == proc_macro2::Delimiter::Brace
                    && !input.peek(Token![else]) =>
            {
                if input.peek(Token![;]) {
                    continue;
                }
                return;
            }
            _ => {}
        }
    }
}

/// An identifier; Rust's keywords are ordinary words here.
fn word(input: ParseStream, expected: &str) -> syn::Result<Ident> {
    use syn::ext::IdentExt as _;
    if input.peek(Ident::peek_any) && !input.peek(Token![_]) {
        return Ok(Ident::parse_any(input)?.unraw());
    }
    Err(syn_error(
        input.span(),
        &format!("expected {expected}{}", found(input)),
        Some(&format!("write {expected} here")),
    ))
}

/// A name, which goes on behind no hyphen.
fn name(input: ParseStream, expected: &str) -> syn::Result<Ident> {
    let name = word(input, expected)?;
    if !input.peek(Token![-]) {
        return Ok(name);
    }
    let start = name.span();
    let mut whole = name.to_string();
    while input.peek(Token![-]) {
        input.parse::<Token![-]>()?;
        whole.push('-');
        whole.push_str(&word(input, expected)?.to_string());
    }
    Err(syn_error(
        start,
        &format!("a name has no hyphens, found `{whole}`"),
        Some(&format!("write `{}`", whole.replace('-', "_"))),
    ))
}

/// ", found `x`", or that the text or bracket ends here.
fn found(input: ParseStream) -> String {
    match input.fork().parse::<TokenTree>() {
        Ok(TokenTree::Group(group)) => match group.delimiter() {
            proc_macro2::Delimiter::Parenthesis => ", found `(`".to_owned(),
            proc_macro2::Delimiter::Brace => ", found `{`".to_owned(),
            proc_macro2::Delimiter::Bracket => ", found `[`".to_owned(),
            proc_macro2::Delimiter::None => String::new(),
        },
        Ok(token) => format!(", found `{token}`"),
        Err(_) => ", found the end of this block".to_owned(),
    }
}

/// The `;` behind a statement.
fn semicolon(input: ParseStream) -> syn::Result<()> {
    if input.peek(Token![;]) {
        input.parse::<Token![;]>()?;
        return Ok(());
    }
    let is_decimal = input.peek(Token![,]) && input.peek2(syn::Lit);
    let help = if is_decimal {
        "write decimals with a point, as in `0.5`; `;` ends the statement"
    } else if goes_on_with_a_value(input) {
        "write one number, and join its units with `*` or `/`, as in `9.81 m/s^2` or `3 N*m`; `;` ends the statement"
    } else {
        "end every setting and declaration with `;`"
    };
    Err(syn_error(
        input.span(),
        &format!("expected `;`{}", found(input)),
        Some(help),
    ))
}

/// Whether a number or a word follows that begins no other statement: `9.81 m s^-2`, `1 1/s^2`.
fn goes_on_with_a_value(input: ParseStream) -> bool {
    use syn::ext::IdentExt as _;
    let ahead = input.fork();
    if ahead.peek(syn::Lit) {
        return true;
    }
    if !ahead.peek(Ident::peek_any) || Ident::parse_any(&ahead).is_err() {
        return false;
    }
    ahead.is_empty()
        || ahead.peek(Token![;])
        || ahead.peek(Token![,])
        || ahead.peek(Token![^])
        || ahead.peek(Token![*])
        || ahead.peek(Token![/])
}

/// The lines of `///` in front of an item, without their margin.
fn doc_comment(input: ParseStream) -> syn::Result<String> {
    if input.peek(Token![#]) && !input.peek2(syn::token::Bracket) {
        return Err(syn_error(
            input.span(),
            "`#` does not begin a statement",
            Some("begin comments with `//`"),
        ));
    }
    let mut lines = Vec::new();
    for attribute in input.call(Attribute::parse_outer)? {
        let text = match &attribute.meta {
            syn::Meta::NameValue(pair) if pair.path.is_ident("doc") => match &pair.value {
                syn::Expr::Lit(syn::ExprLit {
                    lit: syn::Lit::Str(text),
                    ..
                }) => Some(text.value()),
                _ => None,
            },
            _ => None,
        };
        let Some(text) = text else {
            return Err(syn_error(
                attribute.span(),
                "specs have no attributes",
                Some("write a comment: `/// ..`"),
            ));
        };
        // An empty line has none of its own for `lines`, and parts paragraphs.
        lines.extend(
            text.split('\n')
                .map(|line| line.strip_prefix(' ').unwrap_or(line).trim_end().to_owned()),
        );
    }
    Ok(lines.join("\n").trim().to_owned())
}

/// `{ .. }`: the inside, and the closing brace.
fn block<'a>(
    input: ParseStream<'a>,
    expected: &str,
) -> syn::Result<(syn::parse::ParseBuffer<'a>, Span)> {
    if !input.peek(syn::token::Brace) {
        return Err(syn_error(
            input.span(),
            &format!("expected {expected}{}", found(input)),
            Some(&format!("write {expected} here")),
        ));
    }
    let content;
    let brace = syn::braced!(content in input);
    Ok((content, brace.span.close()))
}
