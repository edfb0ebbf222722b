//! A start from a fit that has a motor and its link in one sum, for a simulation in which springs part them.

use std::path::Path;

use robot_model_codegen::Compiled;

use crate::Error;
use crate::output::{self, names};
use crate::parameters;

/// Parameters of the arm whose motors and links move apart, and shapes, from a file of those of the `whole` arm: what is in a sum there is the
/// spec's own as far as that says it, and the sum's rest. Nothing where the file is no such fit.
pub(super) fn apart(
    whole: &Compiled,
    parted: &Compiled,
    file: &Path,
) -> Result<Option<(Vec<f64>, Vec<f64>)>, Error> {
    if whole.base.names == parted.base.names {
        return Ok(None);
    }
    let Ok((fit, _, source)) = parameters::values(whole, Some(file)) else {
        return Ok(None);
    };
    let known = parameters::known(parted, None, &[])?;
    let mut values = known.beta;
    let name = |place: usize| parted.base.names[place].as_str();
    let mut is_open: Vec<bool> = (0..values.len())
        .map(|place| known.missing.iter().any(|missing| missing == name(place)))
        .collect();
    let (mut sums, mut of_spec, mut of_rest) = (Vec::new(), Vec::new(), Vec::new());
    let fitted = whole.base.names.iter().zip(&whole.base.combinations);
    for ((sum, combination), value) in fitted.zip(&fit.beta) {
        let parts = combination.iter().filter_map(|(standard, factor)| {
            let place = parted.base.kept.iter().position(|kept| kept == standard)?;
            Some((place, *factor))
        });
        let parts: Vec<(usize, f64)> = parts.collect();
        let open = parts.iter().filter(|(place, _)| is_open[*place]);
        let mut open: Vec<(usize, f64)> = open.copied().collect();
        // Where the spec says all of them, the sum still holds.
        if open.is_empty() {
            open.extend(parts.first());
        }
        let is_closed = |place: usize| open.iter().all(|(other, _)| *other != place);
        let closed = || parts.iter().filter(|(place, _)| is_closed(*place));
        let taken: f64 = closed()
            .map(|(place, factor)| factor * values[*place])
            .sum();
        if parts.len() > 1 {
            sums.push(sum.as_str());
            of_spec.extend(closed().map(|(place, _)| name(*place)));
            of_rest.extend(open.iter().map(|(place, _)| name(*place)));
        }
        let share = (value - taken) / open.len() as f64;
        for (place, factor) in open {
            values[place] = share / factor;
            is_open[place] = false;
        }
    }
    // A mass is in the sums of all links before it.
    of_spec.sort_unstable();
    of_spec.dedup();
    let spec = match of_spec.as_slice() {
        [] => String::new(),
        list => format!("from the spec's values of {}, and ", names(list)),
    };
    output::say(&format!(
        "note: {source}: springs part what is one sum there ({}); the search starts {spec}from what is left of each sum for {}",
        names(&sums),
        names(&of_rest)
    ));
    Ok(Some((values, fit.shapes)))
}
