//! Where a search by simulation starts that nobody has given a start.

use robot_model::columns::{Columns, Shape};
use robot_model::identify::output_error::{
    Ending, Iterate, OutputError, OutputErrorError, OutputEstimate, Recording, Search,
};
use robot_model::identify::{Estimate, Identify};
use robot_model::log::Log;

use super::super::fit::{ByAcceleration, Fit};
use super::{Beginning, rmse};
use crate::progress::Progress;

/// Values of each shape that are tried, where there are one, two or more.
const OF_ONE: usize = 6;
const OF_TWO: usize = 3;
const OF_MANY: usize = 2;

/// A valley whose cost is less than this share of another's is a deeper one; first parts of searches end roughly.
const DEEPER: f64 = 0.95;

/// Searches to the end, from the best places of all starts, until one has found the arm.
const SEARCHES: usize = 3;

/// Shapes to start from: those of least squares, which filters blur, and others from their ranges.
fn candidates(shapes: &[Shape], found: &[f64]) -> Vec<Vec<f64>> {
    let mut all = vec![found.to_vec()];
    match shapes {
        [] => {}
        [one] => all.extend(spread(&one.grid, OF_ONE).map(|value| vec![value])),
        [one, two] => {
            for first in spread(&one.grid, OF_TWO) {
                all.extend(spread(&two.grid, OF_TWO).map(|second| vec![first, second]));
            }
        }
        many => {
            for (k, shape) in many.iter().enumerate() {
                all.extend(spread(&shape.grid, OF_MANY).map(|value| {
                    let mut values = found.to_vec();
                    values[k] = value;
                    values
                }));
            }
        }
    }
    all
}

/// So many values of a grid, away from its ends.
fn spread(grid: &[f64], count: usize) -> impl Iterator<Item = f64> {
    (0..count).map(move |k| grid[(2 * k + 1) * (grid.len() - 1) / (2 * count)])
}

/// Linear parameters and open shapes to start from, the first of them those of least squares. Others are of least squares with given
/// shapes.
pub(super) fn starts(
    form: &ByAcceleration,
    estimate: &Estimate,
    logs: &[Log],
) -> Vec<(Vec<f64>, Vec<f64>)> {
    let found: Vec<f64> = estimate.shapes.iter().map(|(_, value)| *value).collect();
    let candidates = candidates(form.0.shapes(), &found).into_iter();
    let others = candidates.skip(1).filter_map(|shapes| {
        let identify = Identify {
            bands: Some(estimate.bands),
            shapes: Some(shapes.clone()),
            ..Identify::default()
        };
        let other = form.fit(&identify, logs).ok()?;
        other.unexcited.is_empty().then(|| (other.values(), shapes))
    });
    std::iter::once((estimate.values(), found.clone()))
        .chain(others)
        .collect()
}

/// The same within bounds: nobody has chosen them.
pub(super) fn within(starts: &[Vec<f64>], bounds: &[[f64; 2]]) -> Vec<Vec<f64>> {
    let start = |start: &Vec<f64>| -> Vec<f64> {
        let values = start.iter().zip(bounds);
        values
            .map(|(value, [low, high])| value.clamp(*low, *high))
            .collect()
    };
    starts.iter().map(start).collect()
}

/// What is found from the starts: of several searches the first that is there, or the one whose errors are least. Where none is, the best
/// start is tried with the `other` search, too, which comes out of other valleys.
pub(super) fn search(
    settings: &OutputError,
    beginning: &Beginning,
    starts: &[Vec<f64>],
    recordings: &[Recording],
    other: Option<Search>,
    is_there: &dyn Fn(&OutputEstimate) -> bool,
    progress: &Progress,
) -> Result<OutputEstimate, OutputErrorError> {
    let (plant, names) = (&beginning.plant, &beginning.names);
    let (mut part, mut searches) = (0, 0);
    let mut tell = |iterate: &Iterate| {
        // Costs of different parts cannot be compared.
        let begins = iterate.stage > part;
        part = iterate.stage;
        searches += u32::from(iterate.simulations == 1);
        let of_which = if begins {
            format!(
                " of part {} of the search, with other windows or joints weighted by the errors so far",
                iterate.stage + 1
            )
        } else if iterate.simulations == 1 && searches > 1 {
            format!(" of search {searches}, as the one before did not reach the noise")
        } else {
            String::new()
        };
        let what = format!(
            "simulation {}: cost {:.6e}{of_which}",
            iterate.simulations, iterate.cost
        );
        if !of_which.is_empty() || progress.is_due() {
            progress.guess(&what, iterate.done);
        }
    };
    let mut begun = 0_u32;
    let mut compare = |iterate: &Iterate| {
        // The first one of each start.
        let begins = iterate.simulations == 1;
        begun += u32::from(begins);
        if begins || progress.is_live() {
            let what = format!("searching from start {begun} of {}", starts.len());
            let done = f64::from(begun) - 1.0 + iterate.done;
            progress.part(&what, done / starts.len() as f64);
        }
    };
    let places = settings.nearest(plant, names, starts, recordings, &mut compare)?;
    let error = |found: &OutputEstimate| -> f64 {
        let errors = rmse(found).into_iter();
        errors.map(|rmse| rmse.max(f64::MIN_POSITIVE).ln()).sum()
    };
    let mut best: Option<OutputEstimate> = None;
    let mut refusal = None;
    for place in places.iter().take(SEARCHES) {
        match settings.fit(plant, names, place, recordings, &mut tell) {
            Ok(found) => {
                let is_better = best.as_ref().is_none_or(|best| error(&found) < error(best));
                if is_better {
                    best = Some(found);
                }
            }
            Err(error) => refusal = refusal.or(Some(error)),
        }
        if best.as_ref().is_some_and(is_there) {
            break;
        }
    }
    let is_there = best.as_ref().is_some_and(is_there);
    if let (Some(search), Some(place), false) = (other, places.first(), is_there) {
        let again = OutputError {
            search,
            below: best.as_ref().and_then(|best| to_beat(settings, best)),
            ..settings.clone()
        };
        match again.fit(plant, names, place, recordings, &mut tell) {
            Ok(found) if best.as_ref().is_none_or(|best| error(&found) < error(best)) => {
                best = Some(found);
            }
            Ok(_) | Err(OutputErrorError::NotDeeper { .. }) => {}
            Err(error) => refusal = refusal.or(Some(error)),
        }
    }
    match (best, refusal) {
        (Some(best), _) => Ok(best),
        (None, Some(error)) => Err(error),
        (None, None) => unreachable!("there is at least one place"),
    }
}

/// The cost of the first part of another search in a deeper valley than that of the best; none where this has not come to its end, so that
/// nothing is known of its valley.
fn to_beat(settings: &OutputError, best: &OutputEstimate) -> Option<f64> {
    let has_ended = best.ending == Ending::Converged && best.window == settings.window;
    let first = best.iterates.iter().rfind(|iterate| iterate.stage == 0);
    first
        .filter(|_| has_ended)
        .map(|iterate| DEEPER * iterate.cost)
}
