//! Expressions in C. A space is where a line may break; where it may not, [`TIGHT`] stands until the line is set.

use super::super::written::{Operator, Place, Written};
use crate::expr::Function;

/// A space that stays on its line.
pub const TIGHT: char = '\u{1f}';

/// Spells an expression; `prefix` is that of the page's own functions.
pub fn text(written: &Written, prefix: &str) -> String {
    let all = |x: &Written| text(x, prefix);
    match written {
        Written::Number(value) => number(*value),
        Written::Place(place) => of_place(*place),
        Written::Name(name) => name.clone(),
        Written::Parentheses(x) => format!("({})", all(x)),
        Written::Negative(x) => format!("-{}", operand(x, prefix)),
        Written::Binary(operator, both) => {
            let [x, y] = [&both[0], &both[1]].map(|x| operand(x, prefix));
            let sign = match operator {
                Operator::Plus => '+',
                Operator::Minus => '-',
                Operator::Times => '*',
                Operator::Over => '/',
            };
            format!("{x} {sign}{TIGHT}{y}")
        }
        Written::Call(function, x) => format!("{}({})", name(*function, prefix), all(x)),
        Written::Power(both) => format!("pow({}, {})", all(&both[0]), all(&both[1])),
        Written::Choice(three) => {
            let [condition, x, y] = [&three[0], &three[1], &three[2]].map(|x| operand(x, prefix));
            format!("({condition} >{TIGHT}0.0 ?{TIGHT}{x} :{TIGHT}{y})")
        }
    }
}

/// A literal that reads back to the same bits.
pub fn number(value: f64) -> String {
    format!("{value:?}")
}

/// Two signs in a row are another operator in C.
fn operand(written: &Written, prefix: &str) -> String {
    let text = text(written, prefix);
    match written {
        Written::Number(value) if *value < 0.0 => format!("({text})"),
        Written::Negative(_) => format!("({text})"),
        _ => text,
    }
}

fn of_place(place: Place) -> String {
    match place {
        Place::Argument(name) => name.to_owned(),
        Place::Entry(name, k) => format!("{name}[{k}]"),
    }
}

fn name(function: Function, prefix: &str) -> String {
    match function {
        Function::Ln => "log".to_owned(),
        Function::Abs => "fabs".to_owned(),
        Function::Sign => format!("{prefix}_sign"),
        Function::Recip => unreachable!("written as a quotient"),
        other => other.name().to_owned(),
    }
}
