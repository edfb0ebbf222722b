//! What is printed of errors.

use std::fmt::Write;

use robot_model::identify::{Errors, Estimate, Form};

use crate::output;

/// A relative error; none of a joint without a row that counts, as there is no share of nothing.
pub(crate) fn share(percent: f64) -> Option<f64> {
    Some(percent).filter(|percent| *percent > 0.0)
}

/// Errors per joint, of several logs side by side.
///
/// ```text
/// joint                                 identification                                       validation
///               RMSE         MAE        RMS%   NRMSE fit         RMSE         MAE        RMS%   NRMSE fit
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
        Form::Acceleration => output::errors("raw samples"),
        Form::Filtered { corner } => output::errors(&format!(
            "torque through L(s) = w/(s + w) with w = {corner:.1} rad/s"
        )),
    };
    let rests = if estimate.held.iter().any(|rows| *rows > 0) {
        ", without rows at rest held by dry friction"
    } else {
        ""
    };
    let mut text = format!("{domain}{rests}\n{:width$}", "joint");
    for (name, _) in columns {
        write!(text, "  {name:>46}").expect("a string takes all");
    }
    write!(text, "\n{:width$}", "").expect("a string takes all");
    for _ in columns {
        for name in ["RMSE", "MAE", "RMS%", "NRMSE fit"] {
            write!(text, "  {name:>10}").expect("a string takes all");
        }
    }
    text.push('\n');
    for (joint, name) in estimate.joints.iter().enumerate() {
        write!(text, "{name:width$}").expect("a string takes all");
        for (_, errors) in columns {
            let fit = errors.nrmse_fit()[joint];
            let fit = fit.map_or("-".to_owned(), |fit| format!("{fit:.2} %"));
            let share = share(errors.relative_percent[joint]);
            let share = share.map_or("-".to_owned(), |percent| format!("{percent:.2} %"));
            let counts = errors.samples[joint] > 0;
            let error = |error: f64| {
                if counts {
                    format!("{error:.4}")
                } else {
                    "-".to_owned()
                }
            };
            let [rmse, mae] = [errors.rmse[joint], errors.mae[joint]].map(error);
            write!(text, "  {rmse:>10}  {mae:>10}  {share:>10}  {fit:>10}")
                .expect("a string takes all");
        }
        text.push('\n');
    }
    text
}
