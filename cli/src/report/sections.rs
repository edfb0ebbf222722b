//! Sections that the reports of several verbs have.

use std::fmt::Write;

use robot_model::identify::Z_95;
use robot_model_codegen::Compiled;
use robot_model_spec::model::Model;
use robot_model_spec::parameter::{InertialElement, Owner};

use super::series::WINDOW_S;
use super::{Drawn, Map, Page, comment};
use crate::identify::report::Parameter;
use crate::output::{decimals, significant};

/// What was assumed where files were read, seen when it is opened.
pub(crate) fn as_read(page: &mut Page, notes: &[String]) {
    let summary = match notes.len() {
        0 => return,
        1 => "How the files were read: one note".to_owned(),
        count => format!("How the files were read: {count} notes"),
    };
    page.folded(&summary, false, |page| page.list(notes));
}

/// Every parameter with its deviation, its interval and what it is.
pub(crate) fn parameters(page: &mut Page, compiled: &Compiled, parameters: &[Parameter]) {
    let told = |value: Option<f64>, digits| {
        value.map_or("-".to_owned(), |value| significant(value, digits))
    };
    let rows = parameters.iter().map(|one| {
        let around = |value: f64, std: f64| [value - Z_95 * std, value + Z_95 * std];
        let interval = one
            .interval
            .or_else(|| Some(around(one.value?, one.std.filter(|std| *std > 0.0)?)));
        // As many decimals as the width of the interval has.
        let ends = match interval {
            Some(ends) => {
                let decimals = decimals(ends[1] - ends[0], 3);
                ends.map(|end| format!("{end:.decimals$}"))
            }
            None => ["-".to_owned(), "-".to_owned()],
        };
        let (unit, meaning) = meaning(compiled, one.name);
        vec![
            one.name.to_owned(),
            told(one.value, 5),
            told(one.std.filter(|std| *std > 0.0), 3),
            ends[0].clone(),
            ends[1].clone(),
            unit,
            meaning,
        ]
    });
    let are_drawn = parameters.iter().any(|one| one.interval.is_some());
    let intervals = if are_drawn {
        "95 % confidence intervals: `from` and `to` are from the draws of `--bootstrap`, or 1.96 standard deviations to either side if \
         there are none; the standard deviation is from the formula. `-`: not identified."
    } else {
        "95 % confidence intervals: 1.96 standard deviations to either side. `-`: not identified."
    };
    page.cards(
        intervals,
        &[
            "parameter",
            "value",
            "deviation",
            "from",
            "to",
            "unit",
            "what it is",
        ],
        &rows.collect::<Vec<_>>(),
    );
}

/// Unit and meaning: of an effect's parameter as the comment in its definition has them, whoever wrote it; of a base parameter which moment
/// of which link it is, with the others that it is a sum of.
fn meaning(compiled: &Compiled, name: &str) -> (String, String) {
    if let Some(told) = of_effect(&compiled.model, name) {
        return told;
    }
    let base = &compiled.base;
    let place = base.names.iter().position(|one| one == name);
    let Some(place) = place else {
        return (String::new(), String::new());
    };
    let (unit, moment) = moment(&compiled.standard[base.kept[place]].name);
    let is_sum = base.combinations[place].len() > 1;
    let sum = is_sum.then(|| combination(compiled, name)).flatten();
    let meaning = match (moment.is_empty(), sum) {
        (false, Some(sum)) => format!("{moment}, in a sum: {sum}"),
        (false, None) => moment,
        (true, sum) => sum.unwrap_or_default(),
    };
    (unit.to_owned(), meaning)
}

/// Unit and meaning of a parameter of a declared effect.
fn of_effect(model: &Model, name: &str) -> Option<(String, String)> {
    let mut effects = model.effects.iter().enumerate();
    effects.find_map(|(number, effect)| {
        let prefix = format!("{}.", model.effect_name(number));
        let own = name.strip_prefix(&prefix)?;
        let definition = &effect.definition;
        let linear = definition.linear.iter().map(|one| (&one.name, &one.doc));
        let shapes = definition.shapes.iter().map(|one| (&one.name, &one.doc));
        let (_, doc) = linear.chain(shapes).find(|(one, _)| *one == own)?;
        let joint = effect.joints.first().map(|joint| model.joints[*joint].kind);
        Some(comment::unit_and_meaning(doc, joint))
    })
}

/// Unit and meaning of a link's standard parameter.
fn moment(name: &str) -> (&'static str, String) {
    let Some((link, own)) = name.rsplit_once('.') else {
        return ("", String::new());
    };
    let axes: String = own.chars().skip(1).collect();
    let (unit, what) = match (own.chars().next(), axes.as_str()) {
        (Some('m'), "") => ("kg", format!("mass of {link}")),
        (Some('m'), "x" | "y" | "z") => {
            let what = format!("first moment of {link} along {axes} of its frame");
            ("kg m", what)
        }
        (Some('i'), "xx" | "yy" | "zz") => {
            let axis = &axes[..1];
            let what = format!("moment of inertia of {link} about {axis} of its frame");
            ("kg m^2", what)
        }
        (Some('i'), "xy" | "xz" | "yz") => {
            let what = format!("product of inertia of {link}, {axes} of its frame");
            ("kg m^2", what)
        }
        _ => ("", String::new()),
    };
    (unit, what)
}

/// What a base parameter is made of.
fn combination(compiled: &Compiled, name: &str) -> Option<String> {
    let place = compiled.base.names.iter().position(|one| one == name)?;
    let mut text = String::new();
    for (standard, factor) in &compiled.base.combinations[place] {
        let sign = match (text.is_empty(), *factor < 0.0) {
            (true, false) => "",
            (true, true) => "-",
            (false, false) => " + ",
            (false, true) => " - ",
        };
        text.push_str(sign);
        let size = factor.abs();
        if (size - 1.0).abs() > 1e-12 {
            write!(text, "{} ", significant(size, 4)).expect("a string takes all");
        }
        text.push_str(&compiled.standard[*standard].name);
    }
    Some(text)
}

/// Which standard parameters each base parameter of the body is made of.
pub(crate) fn base_parameters(page: &mut Page, compiled: &Compiled) {
    let base = compiled.base.names.iter().zip(&compiled.base.kept);
    let of_body = base.filter(|(_, kept)| {
        matches!(
            compiled.standard[**kept].owner,
            Owner::Link { .. } | Owner::Monomial(_)
        )
    });
    let rows = of_body.map(|(name, _)| {
        vec![
            name.clone(),
            combination(compiled, name).unwrap_or_default(),
        ]
    });
    let rows: Vec<Vec<String>> = rows.collect();
    if rows.is_empty() {
        page.text("All inertial parameters are fixed by the spec.");
        return;
    }
    if let Some(map) = map(compiled) {
        let legend = [
            ("after", "filled: added"),
            ("before open", "open: subtracted"),
        ];
        let elements = InertialElement::ALL.map(InertialElement::name).join(", ");
        page.figures(
            &[map],
            &legend,
            &format!(
                "Link parameters in each base parameter: a row is a base parameter, the columns of a link are {elements}, from left to \
                 right; a larger square is a larger factor."
            ),
        );
    }
    page.table(
        "Torques determine only these sums of the links' parameters.",
        &["base parameter", "sum"],
        &rows,
    );
    let silent = compiled.base.unidentifiable.iter();
    let silent: Vec<&str> = silent
        .map(|&k| compiled.standard[k].name.as_str())
        .collect();
    if !silent.is_empty() {
        page.text(&format!("No torque depends on: {}.", silent.join(", ")));
    }
}

/// The same drawn, of a chain.
fn map(compiled: &Compiled) -> Option<String> {
    let links = &compiled.model.chain()?.links;
    let columns = InertialElement::ALL.len();
    let column = |standard: usize| match compiled.standard[standard].owner {
        Owner::Link { link, element } => {
            let place = InertialElement::ALL.iter().position(|one| *one == element);
            place.map(|place| columns * link + place)
        }
        _ => None,
    };
    let base = compiled.base.names.iter().zip(&compiled.base.combinations);
    let rows = base.filter_map(|(name, sum)| {
        let squares = sum
            .iter()
            .filter_map(|&(k, factor)| Some((column(k)?, factor)));
        let squares: Vec<(usize, f64)> = squares.collect();
        (!squares.is_empty()).then_some((name.as_str(), squares))
    });
    let map = Map {
        label: "link parameters summed in each base parameter; the table below has the numbers",
        links: links.iter().map(|link| link.name.as_str()).collect(),
        columns,
        rows: rows.collect(),
    };
    Some(map.svg())
}

/// Figures of every joint, those of some open; the last of the legend is the model whose torque is drawn.
pub(crate) fn figures(
    page: &mut Page,
    joints: &[String],
    drawn: &Drawn,
    models: &[(&str, &str)],
    is_open: &dyn Fn(usize) -> bool,
) {
    let mut legend = vec![("measured", "measured")];
    legend.extend(models);
    let last = models.last().map_or("model", |(_, name)| *name);
    let window = if drawn.is_long() {
        format!(" (of the {WINDOW_S:.0} s with the largest residual)")
    } else {
        String::new()
    };
    for (joint, name) in joints.iter().enumerate() {
        page.folded(name, is_open(joint), |page| {
            page.figures(
                &drawn.of_joint(joint, name),
                &legend,
                &format!(
                    "{name}: (a) measured torque and that of the {last} over time{window}, raw samples; residual (measured minus predicted torque) over \
                     (b) velocity, (c) position, (d) load and (e) time, in the band of the fit; (f) square root of its spectral density, raw samples."
                ),
            );
        });
    }
}
