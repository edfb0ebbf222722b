//! Whether logs tell how torque goes between samples, where that changes what is found.

use robot_model::identify::output_error::{Hold, OutputEstimate};
use robot_model::identify::table_value;

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
        format!("{name} {} for {}", table_value(*other), table_value(*value))
    });
    let moved: Vec<String> = moved.collect();
    let [chosen, option] = match rival.hold {
        Hold::Sample => ["taken as its mean between samples", "sample"],
        Hold::Mean => ["held from each sample to the next", "mean"],
    };
    (!moved.is_empty()).then(|| {
        format!(
            "torque is {chosen}, as that fits best; with `--hold {option}` positions are off by {:.1} % more, and there is {}: the logs hardly tell \
             which of both it is, while these values hang on it; say with `--hold` what the drive does, or log faster",
            100.0 * rival.worse.max(0.0),
            moved.join(", ")
        )
    })
}
