//! Values that no arm has. An identification may miss zero by its error, so they are told and not refused.

use robot_model_spec::model::Inertial;
use robot_model_spec::parameter::InertialElement;

use crate::compiled::Compiled;

/// Sentences about standard parameters; `None` where nothing is known, as no torque depends on it.
pub(super) fn of_standard(compiled: &Compiled, values: &[Option<f64>]) -> Vec<String> {
    let parameters = compiled.standard.iter().zip(values);
    let mut doubts: Vec<String> = parameters
        .filter(|(parameter, _)| compiled.model.is_nonnegative(parameter))
        .filter_map(|(parameter, value)| negative(&parameter.name, (*value)?))
        .collect();
    let links = compiled
        .model
        .chain()
        .into_iter()
        .flat_map(|chain| &chain.links);
    let tens = values.chunks(InertialElement::ALL.len());
    for (link, ten) in links.zip(tens) {
        let ten: Option<Vec<f64>> = ten.iter().copied().collect();
        let ten = ten.and_then(|ten| ten.try_into().ok());
        // A mass below zero was told already.
        if ten.is_some_and(|ten: [f64; 10]| ten[0] >= 0.0 && !Inertial::Nominal(ten).is_possible())
        {
            doubts.push(no_body(&link.name));
        }
    }
    doubts
}

/// Sentences about base parameters: a sum of what is not negative is not either.
pub(super) fn of_base(compiled: &Compiled, beta: &[f64]) -> Vec<String> {
    let base = &compiled.base;
    let sums = base.names.iter().zip(&base.combinations).zip(beta);
    sums.filter(|((_, combination), _)| {
        combination.iter().all(|&(k, coefficient)| {
            coefficient > 0.0 && compiled.model.is_nonnegative(&compiled.standard[k])
        })
    })
    .filter_map(|((name, _), &value)| negative(name, value))
    .collect()
}

/// The sentence about a link, of a spec or of a file.
#[must_use]
pub fn no_body(link: &str) -> String {
    format!(
        "link `{link}` has a physically impossible inertia: about the center of mass each principal moment must be positive and at most the \
         sum of the other two"
    )
}

fn negative(name: &str, value: f64) -> Option<String> {
    // Six digits, without what rounding left behind them.
    let said = format!("{value:.5e}").parse().unwrap_or(value);
    (value < 0.0).then(|| format!("`{name}` is {said}, but cannot be negative"))
}
