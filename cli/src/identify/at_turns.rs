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
            "{} looked for with the rows where joints turn, as no others tell {}: a joint stands there longer than its law says, and values of \
             the effect may be off by many of their deviations; runs at constant speeds tell a friction curve (`friction`)",
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
            "no rows but those where joints turn tell {}: a joint stands there longer than its law says, and its encoder does not tell when, so \
             they may be off by many of their deviations: move these joints further or faster, or more of the time one way",
            names(&told)
        )
    })
}

/// Why fewer rows are fitted than there are.
pub(crate) fn left_out(arm: &dyn Arm) -> String {
    let bent = if arm.dry_shapes().is_empty() {
        "deviations are a third smaller, or more, without what they move values by: right where friction is a jump, else values are of higher speeds only"
    } else {
        "open shapes of friction would be bent after that"
    };
    format!(
        "rows where joints with dry friction turn are left out, as with `--leave-out-turns`: a joint stands longer there than its law says, and {bent}"
    )
}
