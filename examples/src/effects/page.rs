//! The page of one effect.

use std::fmt::Write as _;

use robot_model_codegen::expr::Style;
use robot_model_codegen::show::{Equation, effect_equations};
use robot_model_spec::model::{EffectDefinition, ShapeParameter};

use super::{COMMAND, Parting, means, partings, title, traced};

pub(super) fn page(effect: &EffectDefinition) -> String {
    let mut text = format!("# {}\n\n{}\n\n", title(effect), effect.summary());
    text.push_str(&declared(effect));
    text.push_str(&equations(effect));
    text.push_str(&parameters(effect));
    if let Some(identifiable) = effect.identifiable() {
        add(&mut text, "When it is identifiable", &identifiable);
    }
    text.push_str(&confusions(effect));
    write!(
        text,
        "\nThis page is written from `model-spec/effects/{}.robot` by `{COMMAND}`.\n",
        effect.name
    )
    .expect("a string takes all");
    text
}

fn add(text: &mut String, heading: &str, paragraph: &str) {
    write!(text, "\n## {heading}\n\n{paragraph}\n").expect("a string takes all");
}

/// How a spec declares it, and what `trace` calls it.
fn declared(effect: &EffectDefinition) -> String {
    let name = &effect.name;
    let on = match effect.joints.len() {
        0 => "",
        1 => " on elbow",
        _ => " on (shoulder, elbow)",
    };
    let mut text = format!("| | |\n|---|---|\n| in a spec | `effects {{ {name}{on}; }}` |\n");
    if let Some(shape) = effect.shapes.first() {
        let with = format!("{name}({} = {}){on};", shape.name, given(shape));
        writeln!(text, "| with a shape that is known | `{with}` |").expect("a string takes all");
    }
    writeln!(
        text,
        "| acts as | {} |\n| in `trace` | {} |",
        means(effect),
        traced(effect)
    )
    .expect("a string takes all");
    for input in &effect.inputs {
        let column = match input.joint {
            Some(_) => format!("{}1, {0}2, ..", input.name),
            None => input.name.clone(),
        };
        let doc = match input.doc.as_str() {
            "" => String::new(),
            doc => format!(": {}", one_line(doc)),
        };
        writeln!(text, "| reads | `{column}`{doc} |").expect("a string takes all");
    }
    text
}

/// A value that a spec may give: the middle of the range, in the measure of its search.
fn given(shape: &ShapeParameter) -> String {
    let middle = match shape.step {
        None if shape.low > 0.0 => (shape.low * shape.high).sqrt(),
        _ => f64::midpoint(shape.low, shape.high),
    };
    let middle = if middle == 0.0 {
        shape.high / 10.0
    } else {
        middle
    };
    let rounded: f64 = format!("{middle:.0e}")
        .parse()
        .expect("a number that was written");
    rounded.to_string()
}

fn equations(effect: &EffectDefinition) -> String {
    let mut text = String::from("\n## Equation\n");
    // As the language has it, where that says something: a delay is its own name.
    let equations = effect_equations(effect, Style::Text);
    if equations.iter().any(|one| one.left != one.right) {
        text.push_str("\n```text\n");
        for Equation { left, right, .. } in equations {
            writeln!(text, "{left} = {right}").expect("a string takes all");
        }
        text.push_str("```\n");
    }
    for Equation { left, right, .. } in effect_equations(effect, Style::Latex) {
        write!(text, "\n$$ {left} = {right} $$\n").expect("a string takes all");
    }
    for remark in effect.remarks() {
        write!(text, "\n{remark}\n").expect("a string takes all");
    }
    for state in &effect.states {
        write!(
            text,
            "\nIts memory is `{}`, 0 at the start of a log. {}\n",
            state.name,
            one_line(&state.doc)
        )
        .expect("a string takes all");
    }
    text
}

fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

fn parameters(effect: &EffectDefinition) -> String {
    let mut text = String::from(
        "\n## Parameters\n\n| name | what, in which unit | found by | values |\n|---|---|---|---|\n",
    );
    for parameter in &effect.linear {
        let values = if parameter.nonnegative {
            "`>= 0`"
        } else {
            "of either sign"
        };
        writeln!(
            text,
            "| `{}` | {} | least squares | {values} |",
            parameter.name,
            one_line(&parameter.doc)
        )
        .expect("a string takes all");
    }
    for shape in &effect.shapes {
        let step = match shape.step {
            Some(step) => format!("in steps of {step} at first"),
            None => "by factors at first".to_owned(),
        };
        writeln!(
            text,
            "| `{}` | {} | a search, {step} | `{} .. {}` |",
            shape.name,
            one_line(&shape.doc),
            shape.low,
            shape.high
        )
        .expect("a string takes all");
    }
    text
}

/// Pairs that it is one of, whichever of the two says so.
fn confusions(effect: &EffectDefinition) -> String {
    let mut text = String::from("\n## What looks like it\n");
    for pair in partings() {
        let [one, other] = pair.effects;
        let other = match (one.name == effect.name, other.name == effect.name) {
            (true, _) => other,
            (_, true) => one,
            _ => continue,
        };
        let confusion = &pair.confusion;
        // A sentence that is about several effects says "it" of the one whose comment it is in.
        let why = if one.name == effect.name {
            capital(&confusion.why)
        } else {
            format!("Seen from `{}`: {}", one.name, confusion.why)
        };
        write!(
            text,
            "\n### [`{0}`]({0}.md)\n\n{why}\nDistinguished by {1}\n",
            other.name, confusion.parted_by,
        )
        .expect("a string takes all");
        text.push_str(&command(&pair));
    }
    text
}

/// The command that designs the motion, or why there is none.
fn command(pair: &Parting) -> String {
    match pair.command() {
        Err(_) if !pair.confusion.is_parted_by_motion() => String::new(),
        Err(why) => format!("\n{why}\n"),
        Ok(command) => {
            let values = if pair.needs_values() {
                "\nThe motion depends on the arm's values: give standard parameters that the spec lacks, `--parameters values.json`.\n"
            } else {
                ""
            };
            format!("\n```sh\n{command}\n```\n{values}")
        }
    }
}

/// With a capital letter in front, unless code stands there.
pub(super) fn capital(text: &str) -> String {
    let mut text = text.to_owned();
    if let Some(first) = text.get_mut(..1) {
        first.make_ascii_uppercase();
    }
    text
}
