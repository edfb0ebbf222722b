//! Expressions as Rust tokens.

use std::cell::Cell;

use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::quote;

use super::super::written::{Operator, Place, Written};

/// Spells expressions in the scalar `S` of the function, or in `f64`.
pub struct Printer {
    number: fn(f64) -> TokenStream,
    has_famous_numbers: Cell<bool>,
}

impl Printer {
    /// For a function that is generic over its scalar.
    pub fn of_scalars() -> Self {
        Self::new(|value| {
            let number = number(value);
            quote!(S::of(#number))
        })
    }

    /// For `f64`, without calls.
    pub fn of_numbers() -> Self {
        Self::new(number)
    }

    fn new(number: fn(f64) -> TokenStream) -> Self {
        Self {
            number,
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
            Written::Parentheses(x) => {
                let x = self.tokens(x);
                quote!((#x))
            }
            Written::Negative(x) => {
                let x = self.tokens(x);
                quote!(-#x)
            }
            Written::Binary(operator, both) => {
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
