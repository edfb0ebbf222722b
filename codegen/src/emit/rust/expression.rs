//! Expressions as Rust tokens.

use std::cell::Cell;

use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::quote;

use super::super::written::{Operator, Place, Written};

/// Spells expressions in the scalar `S` of the function, or in `f64`.
pub struct Printer {
    number: fn(f64) -> TokenStream,
    is_fused: bool,
    has_famous_numbers: Cell<bool>,
}

impl Printer {
    /// For a function that is generic over its scalar.
    pub fn of_scalars() -> Self {
        let number = |value| {
            let number = number(value);
            quote!(S::of(#number))
        };
        Self::new(number, true)
    }

    /// For `f64`, without calls.
    pub fn of_numbers() -> Self {
        Self::new(number, false)
    }

    fn new(number: fn(f64) -> TokenStream, is_fused: bool) -> Self {
        Self {
            number,
            is_fused,
            has_famous_numbers: Cell::new(false),
        }
    }

    /// Whether a number was written that clippy takes for an approximation of pi, of a root of 2 or the like.
    pub fn has_famous_numbers(&self) -> bool {
        self.has_famous_numbers.get()
    }

    pub fn tokens(&self, written: &Written) -> TokenStream {
        match written {
            Written::Number(value) => {
                if is_famous(value.abs()) {
                    self.has_famous_numbers.set(true);
                }
                (self.number)(*value)
            }
            Written::Place(place) => of_place(*place),
            Written::Name(name) => {
                let name = Ident::new(name, Span::call_site());
                quote!(#name)
            }
            // What a function returns needs none.
            Written::Parentheses(x) if self.is_call(x) => self.tokens(x),
            Written::Parentheses(x) => {
                let x = self.tokens(x);
                quote!((#x))
            }
            Written::Negative(x) => {
                let x = self.tokens(x);
                quote!(-#x)
            }
            Written::Binary(operator, both) => {
                if let Some(tokens) = self.fused(*operator, both) {
                    return tokens;
                }
                let [x, y] = [&both[0], &both[1]].map(|x| self.tokens(x));
                match operator {
                    Operator::Plus => quote!(#x + #y),
                    Operator::Minus => quote!(#x - #y),
                    Operator::Times => quote!(#x * #y),
                    Operator::Over => quote!(#x / #y),
                }
            }
            Written::Call(function, x) => {
                let name = Ident::new(function.name(), Span::call_site());
                let x = self.tokens(x);
                quote!(S::#name(#x))
            }
            Written::Power(both) => {
                let [x, y] = [&both[0], &both[1]].map(|x| self.tokens(x));
                quote!(S::pow(#x, #y))
            }
            Written::Choice(all) => {
                let [condition, x, y] = [&all[0], &all[1], &all[2]].map(|x| self.tokens(x));
                quote!(S::choose(#condition, #x, #y))
            }
        }
    }
}

impl Printer {
    /// A sum with a product in it, `S::mul_add(x, y, z)` for `x * y + z`: of two products the second, which as a rule is known
    /// later, and then has one operation to go instead of two.
    fn fused(&self, operator: Operator, [left, right]: &[Written; 2]) -> Option<TokenStream> {
        let is_minus = match operator {
            Operator::Plus => false,
            Operator::Minus => true,
            Operator::Times | Operator::Over => return None,
        };
        if !self.is_fused {
            return None;
        }
        if let Some([x, y]) = factors(right) {
            let x = if is_minus {
                self.negative(x)
            } else {
                self.tokens(x)
            };
            let (y, z) = (self.tokens(y), self.tokens(bare(left)));
            return Some(quote!(S::mul_add(#x, #y, #z)));
        }
        let [x, y] = factors(left)?;
        let z = if is_minus {
            self.negative(right)
        } else {
            self.tokens(bare(right))
        };
        let (x, y) = (self.tokens(x), self.tokens(y));
        Some(quote!(S::mul_add(#x, #y, #z)))
    }

    fn negative(&self, x: &Written) -> TokenStream {
        match x {
            Written::Number(value) => self.tokens(&Written::Number(-value)),
            Written::Negative(x) => self.tokens(x),
            Written::Binary(..) if !self.is_call(x) => {
                let x = self.tokens(x);
                quote!(-(#x))
            }
            _ => {
                let x = self.tokens(x);
                quote!(-#x)
            }
        }
    }

    /// Whether the expression is spelled as a call of `mul_add`.
    fn is_call(&self, x: &Written) -> bool {
        let Written::Binary(operator, both) = x else {
            return false;
        };
        let is_sum = matches!(operator, Operator::Plus | Operator::Minus);
        self.is_fused && is_sum && both.iter().any(|x| factors(x).is_some())
    }
}

/// Both factors of a product.
fn factors(x: &Written) -> Option<[&Written; 2]> {
    match x {
        Written::Binary(Operator::Times, both) => Some([&both[0], &both[1]].map(bare)),
        _ => None,
    }
}

/// An argument of a function needs no parentheses.
fn bare(x: &Written) -> &Written {
    match x {
        Written::Parentheses(inner) => inner,
        other => other,
    }
}

fn of_place(place: Place) -> TokenStream {
    let name = Ident::new(place.argument(), Span::call_site());
    match place {
        Place::Argument(_) => quote!(#name),
        Place::Entry(_, k) => {
            let k = Literal::usize_unsuffixed(k);
            quote!(#name[#k])
        }
    }
}

/// A number as a literal that reads back to the same bits.
#[must_use]
pub fn number(value: f64) -> TokenStream {
    let literal = Literal::f64_unsuffixed(value.abs());
    if value < 0.0 {
        quote!(-#literal)
    } else {
        quote!(#literal)
    }
}

/// Near a constant of the standard library. Clippy compares as many digits as there are, three at least.
fn is_famous(value: f64) -> bool {
    use std::f64::consts as c;
    let famous = [
        c::E,
        c::FRAC_1_PI,
        c::FRAC_1_SQRT_2,
        c::FRAC_2_PI,
        c::FRAC_2_SQRT_PI,
        c::FRAC_PI_2,
        c::FRAC_PI_3,
        c::FRAC_PI_4,
        c::FRAC_PI_6,
        c::FRAC_PI_8,
        c::LN_2,
        c::LN_10,
        c::LOG10_2,
        c::LOG10_E,
        c::LOG2_10,
        c::LOG2_E,
        c::PI,
        c::SQRT_2,
        c::TAU,
    ];
    famous
        .iter()
        .any(|constant| (value / constant - 1.0).abs() < 1e-2)
}
