//! What is said of rows where joints with dry friction turn.

use robot_model::columns::Arm;
use robot_model::identify::Estimate;

use crate::output::names;

/// What is said of open curves of dry friction that rows at turns alone tell.
pub(super) fn bent_shapes(arm: &dyn Arm, estimate: &Estimate) -> Option<String> {
    let open = arm.dry_shapes().iter();
    let open: Vec<&str> = open
        .filter_map(|&k| Some(estimate.shapes.get(k)?.0.as_str()))
        .collect();
    (!open.is_empty() && !estimate.is_without_turns).then(|| {
        format!(
            "{} fitted on rows near velocity reversals, as no other rows determine {}: there a joint sticks longer than its friction law \
             says, so values of the effect may be wrong by many standard deviations; measure friction at constant speeds instead \
             (`friction`)",
            match open.as_slice() {
                [one] => format!("`{one}` is"),
                _ => format!("{} are", names(&open)),
            },
            if open.len() == 1 { "it" } else { "them" }
        )
    })
}

/// What rows at turns alone tell.
pub(super) fn told_there_alone(estimate: &Estimate) -> Option<String> {
    let told: Vec<&str> = estimate.told_at_turns.iter().map(String::as_str).collect();
    (!told.is_empty()).then(|| {
        format!(
            "only rows near velocity reversals determine {}: there a joint sticks longer than its friction law says, and its encoder does \
             not show when, so these values may be wrong by many standard deviations; move these joints further or faster, or longer in one \
             direction",
            names(&told)
        )
    })
}

/// Why fewer rows are fitted than there are.
pub(crate) fn left_out(arm: &dyn Arm) -> String {
    let bent = if arm.dry_shapes().is_empty() {
        "without them standard deviations are at least a third smaller; right if friction is a pure jump, else values hold for higher speeds only"
    } else {
        "friction shapes without a value would be biased by that"
    };
    format!(
        "rows near velocity reversals of joints with dry friction are left out, as with `--leave-out-turns`: there a joint sticks longer \
         than its friction law says; {bent}"
    )
}
