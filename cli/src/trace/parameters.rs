//! Parameters of the last model, as the page of a trace has them.

use crate::close_the_loop::{Loop, Sure};
use crate::identify::report::{Parameter, identified};

/// A parameter of a finding, by its name in the amended spec.
pub(super) struct Found {
    name: String,
    value: f64,
    sure: Sure,
}

/// Those of all findings that the amended spec declares, shapes among them: the fit has these as fixed, and gives them no row.
pub(super) fn found(closed: &Loop) -> Vec<Found> {
    let findings = closed.verdict.findings.iter().enumerate();
    let all = findings.filter_map(|(place, finding)| {
        let effect_name = closed.effect_name(place)?;
        let parameters = closed.parameters(finding, place).into_iter();
        Some(parameters.map(move |(name, value, sure)| Found {
            name: format!("{effect_name}.{name}"),
            value,
            sure,
        }))
    });
    all.flatten().collect()
}

/// All of the last model. What was found has the deviations of the verdict, which know of its shapes; those of a fit that has the shapes
/// as fixed are smaller.
pub(super) fn parameters<'a>(closed: &'a Loop, found: &'a [Found]) -> Vec<Parameter<'a>> {
    let mut all = identified(&closed.after().estimate);
    for own in found {
        let row = Parameter {
            name: &own.name,
            value: (own.sure != Sure::Traded).then_some(own.value),
            std: own.sure.std(),
            interval: None,
        };
        match all.iter_mut().find(|one| one.name == own.name) {
            // None where the logs do not tell it from others, whatever the verdict says of it.
            Some(known) if known.value.is_some() => *known = row,
            Some(_) => {}
            None => all.push(row),
        }
    }
    all
}
