//! What is printed of errors.

use std::fmt::Write;

use robot_model::identify::{Errors, Estimate, Form};

use crate::output;

/// Errors per joint, of several logs side by side.
///
/// ```text
/// joint   identification          validation
///             RMSE    relative        RMSE    relative
/// ```
pub(crate) fn table(estimate: &Estimate, columns: &[(&str, &Errors)]) -> String {
    let width = estimate
        .joints
        .iter()
        .map(String::len)
        .max()
        .unwrap_or(0)
        .max("joint".len());
    let domain = match estimate.form {
        Form::Acceleration => output::ERRORS.to_owned(),
        Form::Filtered { corner } => output::filtered_errors(corner),
    };
    let mut text = format!("{domain}\n{:width$}", "joint");
    for (name, _) in columns {
        write!(text, "  {name:>22}").expect("a string takes all");
    }
    write!(text, "\n{:width$}", "").expect("a string takes all");
    for _ in columns {
        write!(text, "  {:>10}  {:>10}", "RMSE", "relative").expect("a string takes all");
    }
    text.push('\n');
    for (joint, name) in estimate.joints.iter().enumerate() {
        write!(text, "{name:width$}").expect("a string takes all");
        for (_, errors) in columns {
            write!(
                text,
                "  {:>10.4}  {:>8.2} %",
                errors.rmse[joint], errors.relative_percent[joint]
            )
            .expect("a string takes all");
        }
        text.push('\n');
    }
    text
}
