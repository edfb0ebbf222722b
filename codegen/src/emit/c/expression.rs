//! Expressions in C. A space is where a line may break; where it may not, [`TIGHT`] stands until the line is set.

use std::collections::BTreeSet;

use super::super::header::TIGHT;
use super::super::written::{Operator, Place, Written};
use super::helpers::Helper;
use crate::expr::Function;

/// Spells what a function computes, and knows which helpers that calls.
pub struct Speller<'a> {
    prefix: &'a str,
    called: BTreeSet<Helper>,
}

impl<'a> Speller<'a> {
    /// `prefix` is that of the page.
    pub fn new(prefix: &'a str) -> Self {
        Self {
            prefix,
            called: BTreeSet::new(),
        }
    }

    /// What was called.
    pub fn called(self) -> BTreeSet<Helper> {
        self.called
    }

    /// The name of a helper that is called now.
    pub fn helper(&mut self, helper: Helper) -> String {
        self.called.insert(helper);
        helper.name(self.prefix)
    }

    /// An expression.
    pub fn text(&mut self, written: &Written) -> String {
        match written {
            Written::Number(value) => number(*value),
            Written::Place(place) => of_place(*place),
            Written::Name(name) => name.clone(),
            Written::Parentheses(x) => format!("({})", self.text(x)),
            Written::Negative(x) => format!("-{}", self.operand(x)),
            Written::Binary(operator, both) => {
                let [x, y] = both.each_ref().map(|x| self.operand(x));
                let sign = match operator {
                    Operator::Plus => '+',
                    Operator::Minus => '-',
                    Operator::Times => '*',
                    Operator::Over => '/',
                };
                format!("{x} {sign}{TIGHT}{y}")
            }
            Written::Call(function, x) => format!("{}({})", self.name(*function), self.text(x)),
            Written::Power(both) => {
                format!("pow({}, {})", self.text(&both[0]), self.text(&both[1]))
            }
            Written::Choice(three) => {
                let [condition, x, y] = three.each_ref().map(|x| self.operand(x));
                format!("({condition} >{TIGHT}0.0 ?{TIGHT}{x} :{TIGHT}{y})")
            }
        }
    }

    /// Two signs in a row are another operator in C.
    fn operand(&mut self, written: &Written) -> String {
        let text = self.text(written);
        match written {
            Written::Number(value) if *value < 0.0 => format!("({text})"),
            Written::Negative(_) => format!("({text})"),
            _ => text,
        }
    }

    fn name(&mut self, function: Function) -> String {
        match function {
            Function::Ln => "log".to_owned(),
            Function::Abs => "fabs".to_owned(),
            Function::Sign => self.helper(Helper::Sign),
            Function::Recip => unreachable!("written as a quotient"),
            other => other.name().to_owned(),
        }
    }
}

/// A literal that reads back to the same bits.
pub fn number(value: f64) -> String {
    format!("{value:?}")
}

fn of_place(place: Place) -> String {
    match place {
        Place::Argument(name) => name.to_owned(),
        Place::Entry(name, k) => format!("{name}[{k}]"),
    }
}
