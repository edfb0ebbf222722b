//! Whether logs tell how torque goes between samples, where that changes what is found.

use robot_model::identify::output_error::{Ending, Hold, OutputError, OutputEstimate, Recording};
use robot_model::identify::table_value;

use super::{Beginning, rmse};
use crate::progress::Progress;

/// By which share errors are larger in the other way, at most, where logs do not settle it.
const UNSETTLED: f64 = 0.1;

/// Deviations by which a parameter is another in the other way.
const APART: f64 = 3.0;

/// Parameters that are others where torque goes between samples in the way that fits a little worse.
pub(super) fn doubt(names: &[String], found: &OutputEstimate) -> Option<String> {
    let rival = found.rival_hold.as_ref()?;
    if rival.worse > UNSETTLED {
        return None;
    }
    let pairs = found.values.iter().zip(&rival.values);
    let all = names.iter().zip(pairs).zip(&found.std);
    let moved = all.filter(|((_, (value, other)), std)| {
        std.is_some_and(|std| (*value - *other).abs() > APART * std)
    });
    let moved = moved.map(|((name, (value, other)), _)| {
        format!(
            "{name} {} instead of {}",
            table_value(*other),
            table_value(*value)
        )
    });
    let moved: Vec<String> = moved.collect();
    let chosen = said(other(rival.hold));
    let option = option(rival.hold);
    (!moved.is_empty()).then(|| {
        format!(
            "torque is {chosen}, which fits best; with `--hold {option}` position errors are {:.1} % larger, with {}: the logs hardly \
             distinguish the two, but these values depend on it; say with `--hold` what the drive does, or log faster",
            100.0 * rival.worse.max(0.0),
            moved.join(", ")
        )
    })
}

/// By which share errors have to be less in the other way for what a user asked for to be doubted.
const FAR_BETTER: f64 = 0.1;

/// Iterations of each part of a search that tell whether the other way leads further down.
const A_FEW: usize = 10;

/// That errors which are no noise are far less in the other way than in the one that was asked for.
pub(super) fn asked(
    settings: &OutputError,
    beginning: &Beginning,
    recordings: &[Recording],
    found: &OutputEstimate,
    progress: &Progress,
) -> Option<String> {
    let hold = other(settings.hold?);
    // A search that has not come to its end would only be given more time.
    if found.ending != Ending::Converged {
        return None;
    }
    let settings = OutputError {
        hold: Some(hold),
        window: found.window,
        iterations: Some(A_FEW),
        ..settings.clone()
    };
    progress.step("trying the other interpolation of torque between samples");
    let (plant, names) = (&beginning.plant, &beginning.names);
    // An arm that runs away was not driven so.
    let rival = settings.fit(plant, names, &found.values, recordings, &mut |_| ());
    let rival = rival.ok()?;
    let pairs = rmse(&rival).into_iter().zip(rmse(found));
    let ratios: Vec<f64> = pairs.map(|(rival, own)| (rival / own).ln()).collect();
    let ratio = (ratios.iter().sum::<f64>() / ratios.len() as f64).exp();
    (ratio < 1.0 - FAR_BETTER).then(|| {
        format!(
            "torque is {}, as `--hold` says; with `--hold {}` position errors are {:.0} % smaller, so the drive does that, or the values \
             compensate for half a sample of delay",
            said(other(hold)),
            option(hold),
            100.0 * (1.0 - ratio)
        )
    })
}

const fn other(hold: Hold) -> Hold {
    match hold {
        Hold::Sample => Hold::Mean,
        Hold::Mean => Hold::Sample,
    }
}

const fn said(hold: Hold) -> &'static str {
    match hold {
        Hold::Mean => "taken as its mean between samples",
        Hold::Sample => "held from each sample to the next",
    }
}

const fn option(hold: Hold) -> &'static str {
    match hold {
        Hold::Mean => "mean",
        Hold::Sample => "sample",
    }
}
