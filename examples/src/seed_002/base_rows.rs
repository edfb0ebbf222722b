//! Items on base parameters.

use robot_model_cli::audit::Check;

use super::results::Results;
use crate::paper::Row;

/// What a check finds first, as far as its first number.
fn shortened(check: &Check) -> String {
    let first = check.findings.first().map_or("", String::as_str);
    let first = first.trim_start_matches("torques do not determine ");
    let parts: Vec<&str> = first.split(", ").collect();
    let more = if parts.len() > 1 { ", .." } else { "" };
    format!("{}{more}", parts[0])
}

/// Which there are, and how the paper regroups.
pub(super) fn rows(results: &Results) -> Vec<Row> {
    let base = &results.base;
    let ranks = [base.symbolic, base.identified, base.numeric];
    let (asked, sums) = (&base.regrouping, base.symbolic);
    vec![
        Row::holds(
            "2.2",
            "base parameters of 96",
            "70 and 26",
            format!(
                "{} by the compiler ({} of friction, rotors of {}), {} by identification of all, {} by QR; {} standard",
                base.symbolic,
                base.friction,
                base.rotors.join(", "),
                base.identified,
                base.numeric,
                base.standard
            ),
            ranks == [70; 3]
                && base.standard == 96
                && base.friction == 30
                && base.rotors == ["j3", "j4", "j5", "j6"],
            "the ranks differ",
        ),
        Row::holds(
            "2.3",
            "numeric QR on random six-sine data and the compiler's set",
            "QR of normalized columns",
            format!(
                "kept columns at least {:.0e} apart, dropped ones at most {:.0e}; `R1^-1 R2` is the compiler's within {:.0e}",
                base.kept_apart, base.dropped_apart, base.k
            ),
            base.kept_apart > 1e-6 && base.dropped_apart < 1e-12 && base.k < 1e-8,
            "the sets differ",
        ),
        Row::wrong_in_print(
            "2.3.k",
            "the matrix that regroups (15): base parameters that are made with it, asked by `audit`",
            "k = R2 R1^-1, W2 = k W1",
            format!(
                "R2 has {} columns and R1^-1 {} rows; in that order there is R2^T R1^-1 alone, with which torques do not determine {} of {sums} \
                 sums: {}; with R1^-1 R2 {}, and with W2 = W1 k {:.0e} of W2 is left",
                base.printed[0],
                base.printed[1],
                asked.printed.findings.len(),
                shortened(&asked.printed),
                asked.of_measured.findings.len(),
                base.regrouped[0]
            ),
            asked.printed.passed == Some(false)
                && asked.of_measured.passed == Some(true)
                && base.printed[0] != base.printed[1]
                && base.regrouped[0] < 1e-10,
            "the product does not exist: it is R1^-1 R2, and W2 = W1 k",
        ),
        Row::wrong_in_print(
            "2.3.lengths",
            "k of normalized columns, used on measured ones (15): base parameters that are made with it, asked by `audit`",
            "the same k",
            format!(
                "torques do not determine {} of {sums} sums: {}; with lengths put back {}; {:.2} of W2 is left, and {:.0e} with lengths",
                asked.of_unit.findings.len(),
                shortened(&asked.of_unit),
                asked.of_measured.findings.len(),
                base.regrouped[1],
                base.regrouped[0]
            ),
            asked.of_unit.passed == Some(false)
                && asked.of_measured.passed == Some(true)
                && base.regrouped[1] > 0.1
                && base.regrouped[0] < 1e-10,
            "R is of columns of unit length: k has to get the lengths back",
        ),
    ]
}
