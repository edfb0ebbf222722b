//! Expressions: our own precedence over tokens, because in Rust `^` is exclusive-or and binds looser than `+`.
//!
//! From loose to tight: `+ -`, `* /`, unary `-`, `^` (to the right). A number may carry a unit, whose power is the unit's
//! and not the number's: `90 deg`, `2 m^2`. A choice, `if a < b { x } else { y }`, is a value like a number.

use proc_macro2::Span;
use syn::ext::IdentExt as _;
use syn::parse::{Parse, ParseStream};
use syn::{Ident, Lit, Token};

use super::{block, found, word};
use crate::ast::{BinaryOp, Condition, Expr, ExprKind, Unit, join};
use crate::diagnostic::syn_error;

/// More operators than an equation of physics has; keeps trees shallow enough for recursion.
const MAX_OPERATORS: usize = 400;

impl Parse for Expr {
    fn parse(input: ParseStream) -> syn::Result<Self> {
        Climber { operators: 0 }.sum(input)
    }
}

/// A value and nothing behind it.
#[cfg(feature = "log-settings")]
pub(super) fn alone(input: ParseStream) -> syn::Result<Expr> {
    let value = input.parse()?;
    if input.is_empty() {
        return Ok(value);
    }
    Err(syn_error(
        input.span(),
        &format!("expected nothing after this value{}", found(input)),
        Some("write one number, and join units with `*` or `/`, as in `360 deg/4096` or `N*m`"),
    ))
}

/// No quantity of mechanics has a unit of a higher power.
const LARGEST_POWER_OF_UNIT: i32 = 6;

struct Climber {
    operators: usize,
}

impl Climber {
    fn sum(&mut self, input: ParseStream) -> syn::Result<Expr> {
        let mut left = self.product(input)?;
        loop {
            let op = if input.peek(Token![+]) {
                input.parse::<Token![+]>()?;
                BinaryOp::Add
            } else if input.peek(Token![-]) {
                input.parse::<Token![-]>()?;
                BinaryOp::Sub
            } else {
                return Ok(left);
            };
            self.count(input)?;
            left = binary(op, left, self.product(input)?);
        }
    }

    fn product(&mut self, input: ParseStream) -> syn::Result<Expr> {
        let mut left = self.unary(input)?;
        loop {
            let op = if input.peek(Token![*]) {
                input.parse::<Token![*]>()?;
                if input.peek(Token![*]) {
                    return Err(syn_error(
                        input.span(),
                        "`**` is not an operator",
                        Some("write powers with `^`, as in `l^2`"),
                    ));
                }
                BinaryOp::Mul
            } else if input.peek(Token![/]) {
                input.parse::<Token![/]>()?;
                BinaryOp::Div
            } else {
                return Ok(left);
            };
            self.count(input)?;
            left = binary(op, left, self.unary(input)?);
        }
    }

    fn unary(&mut self, input: ParseStream) -> syn::Result<Expr> {
        if !input.peek(Token![-]) {
            return self.power(input);
        }
        let minus: Token![-] = input.parse()?;
        self.count(input)?;
        let value = self.unary(input)?;
        Ok(Expr {
            span: join(minus.span, value.span),
            kind: ExprKind::Neg(Box::new(value)),
        })
    }

    fn power(&mut self, input: ParseStream) -> syn::Result<Expr> {
        let base = self.atom(input)?;
        if !input.peek(Token![^]) {
            return Ok(base);
        }
        input.parse::<Token![^]>()?;
        self.count(input)?;
        Ok(binary(BinaryOp::Pow, base, self.unary(input)?))
    }

    fn atom(&mut self, input: ParseStream) -> syn::Result<Expr> {
        if input.peek(syn::token::Paren) {
            self.count(input)?;
            let content;
            let paren = syn::parenthesized!(content in input);
            let inner = self.sum(&content)?;
            expect_end(&content)?;
            return Ok(Expr {
                span: paren.span.join(),
                ..inner
            });
        }
        if input.peek(Lit) && !input.peek(syn::LitBool) {
            return number(input);
        }
        if input.peek(Token![if]) {
            return self.choice(input);
        }
        let name = word(input, "a value such as `0.3`, `90 deg` or `pi/2`")?;
        if !input.peek(syn::token::Paren) {
            return Ok(Expr {
                span: name.span(),
                kind: ExprKind::Name(name),
            });
        }
        self.count(input)?;
        let content;
        let paren = syn::parenthesized!(content in input);
        let mut arguments = Vec::new();
        while !content.is_empty() {
            arguments.push(self.sum(&content)?);
            if content.is_empty() {
                break;
            }
            content
                .parse::<Token![,]>()
                .map_err(|_| unexpected(&content))?;
        }
        Ok(Expr {
            span: join(name.span(), paren.span.close()),
            kind: ExprKind::Call(name, arguments),
        })
    }

    /// `if a < b { x } else if c >= d { y } else { z }`
    fn choice(&mut self, input: ParseStream) -> syn::Result<Expr> {
        self.count(input)?;
        let keyword: Token![if] = input.parse()?;
        let condition = self.condition(input)?;
        let (then, _) = self.branch(input)?;
        if !input.peek(Token![else]) {
            return Err(syn_error(
                input.span(),
                &format!("an `if` without `else` has no value{}", found(input)),
                Some("write `if a < b { x } else { y }`"),
            ));
        }
        input.parse::<Token![else]>()?;
        let (otherwise, end) = if input.peek(Token![if]) {
            let choice = self.choice(input)?;
            let end = choice.span;
            (choice, end)
        } else {
            self.branch(input)?
        };
        Ok(Expr {
            span: join(keyword.span, end),
            kind: ExprKind::Choice(Box::new(condition), Box::new(then), Box::new(otherwise)),
        })
    }

    /// `a < b`
    fn condition(&mut self, input: ParseStream) -> syn::Result<Condition> {
        let left = self.sum(input)?;
        let (or_equal, left_is_greater) = if input.peek(Token![>=]) {
            input.parse::<Token![>=]>()?;
            (true, true)
        } else if input.peek(Token![<=]) {
            input.parse::<Token![<=]>()?;
            (true, false)
        } else if input.peek(Token![>]) {
            input.parse::<Token![>]>()?;
            (false, true)
        } else if input.peek(Token![<]) {
            input.parse::<Token![<]>()?;
            (false, false)
        } else {
            return Err(syn_error(
                input.span(),
                &format!("expected `<`, `<=`, `>` or `>=`{}", found(input)),
                Some("compare two values: `if dq(j) > 0 { .. } else { .. }`"),
            ));
        };
        let right = self.sum(input)?;
        let (greater, smaller) = if left_is_greater {
            (left, right)
        } else {
            (right, left)
        };
        Ok(Condition {
            or_equal,
            greater,
            smaller,
        })
    }

    /// `{ x }`
    fn branch(&mut self, input: ParseStream) -> syn::Result<(Expr, Span)> {
        let (content, close) = block(input, "`{` and a value")?;
        let value = self.sum(&content)?;
        expect_end(&content)?;
        Ok((value, close))
    }

    fn count(&mut self, input: ParseStream) -> syn::Result<()> {
        self.operators += 1;
        if self.operators > MAX_OPERATORS {
            return Err(syn_error(
                input.span(),
                &format!("an expression of more than {MAX_OPERATORS} operators"),
                Some("name parts of it with `let name = ..;`, or simplify it"),
            ));
        }
        Ok(())
    }
}

fn binary(op: BinaryOp, left: Expr, right: Expr) -> Expr {
    Expr {
        span: join(left.span, right.span),
        kind: ExprKind::Binary(op, Box::new(left), Box::new(right)),
    }
}

fn expect_end(content: ParseStream) -> syn::Result<()> {
    if content.is_empty() {
        Ok(())
    } else {
        Err(unexpected(content))
    }
}

fn unexpected(content: ParseStream) -> syn::Error {
    syn_error(
        content.span(),
        &format!("expected an operator or `)`{}", found(content)),
        Some("write `+`, `-`, `*`, `/` or `^` between values, and close the bracket"),
    )
}

/// A literal and its unit: `90 deg`, `90deg`, `3 m^2`, `0.3`.
fn number(input: ParseStream) -> syn::Result<Expr> {
    let literal: Lit = input.parse()?;
    let (digits, suffix, span) = match &literal {
        Lit::Int(int) => (
            int.base10_digits().to_owned(),
            int.suffix().to_owned(),
            int.span(),
        ),
        Lit::Float(float) => (
            float.base10_digits().to_owned(),
            float.suffix().to_owned(),
            float.span(),
        ),
        other => {
            let unquoted = match other {
                Lit::Str(text) => text.parse::<Ident>().ok(),
                _ => None,
            };
            let help = match unquoted {
                Some(word) => format!("write `{word}`, without quotes, if that word is meant"),
                None => "text is not allowed here".to_owned(),
            };
            return Err(syn_error(
                syn::spanned::Spanned::span(other),
                "expected a number",
                Some(&help),
            ));
        }
    };
    let value: f64 = digits
        .parse()
        .map_err(|_| syn_error(span, "this is not a number", Some("write a decimal number")))?;
    if !crate::transform::is_in_range(value) {
        return Err(syn_error(
            span,
            "this number is too large or too small to compute with",
            Some("write zero, or a number between 1e-30 and 1e30"),
        ));
    }
    let name = if suffix.is_empty() {
        unit(input)?
    } else {
        Some(Ident::new(&suffix, span))
    };
    let Some(name) = name else {
        return Ok(Expr {
            kind: ExprKind::Number(value, None),
            span,
        });
    };
    let whole = join(span, name.span());
    let (exponent, whole) = if input.peek(Token![^]) {
        let (exponent, end) = power_of_unit(input)?;
        (exponent, join(whole, end))
    } else {
        (1, whole)
    };
    Ok(Expr {
        kind: ExprKind::Number(value, Some(Unit { name, exponent })),
        span: whole,
    })
}

/// `^2`, `^-3`: the power of the unit alone, so `2 m^2` are two square meters.
fn power_of_unit(input: ParseStream) -> syn::Result<(i32, Span)> {
    let hat: Token![^] = input.parse()?;
    let minus: Option<Token![-]> = input.parse()?;
    let digit: Option<syn::LitInt> = input.parse().ok();
    let exponent = digit
        .as_ref()
        .filter(|digit| digit.suffix().is_empty())
        .and_then(|digit| digit.base10_parse::<i32>().ok())
        .filter(|exponent| (1..=LARGEST_POWER_OF_UNIT).contains(exponent));
    match (exponent, digit) {
        (Some(exponent), Some(digit)) if !input.peek(Token![^]) => {
            let sign = if minus.is_some() { -1 } else { 1 };
            Ok((sign * exponent, digit.span()))
        }
        (_, digit) => Err(syn_error(
            digit.map_or(hat.span, |digit| digit.span()),
            "the power of a unit is a whole number from 1 to 6, or its negative",
            Some("write `2 m^2` or `2 m^-3`; a power of number and unit together is `(2 m)^2`"),
        )),
    }
}

/// The word behind a number, unless it is `step` or begins the next setting (a `;` is missing then).
fn unit(input: ParseStream) -> syn::Result<Option<Ident>> {
    if !input.peek(Ident::peek_any) || input.peek2(Token![=]) || input.peek2(Token![:]) {
        return Ok(None);
    }
    let next = word(&input.fork(), "a unit")?;
    if next == "step" || next == "on" {
        Ok(None)
    } else {
        word(input, "a unit").map(Some)
    }
}
