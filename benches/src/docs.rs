//! The tables of `docs/benchmarks.md`, between marks in its text.

use std::fmt::Write as _;

use crate::Error;
use crate::report::{Form, Report, Row};

const BEGIN: &str =
    "<!-- What follows is written by `cargo bench --bench dynamics -- --docs`. -->\n";
const END: &str = "<!-- Until here. -->\n";

/// Counts to reach, multiplications and additions: function, form, of PUMA 560 and Panda.
const WISHED: [(&str, Form, [usize; 2]); 7] = [
    ("inverse_dynamics", Form::Runtime, [420, 520]),
    ("inverse_dynamics", Form::Baked, [280, 520]),
    ("mass_matrix", Form::Baked, [230, 450]),
    ("coriolis_matrix", Form::Baked, [1000, 1600]),
    ("gravity", Form::Baked, [80, 150]),
    ("regressor", Form::Baked, [1100, 1500]),
    ("base_regressor", Form::Baked, [900, 1050]),
];

/// The page's text with its tables renewed.
///
/// # Errors
/// The marks are not there.
pub fn renewed(page: &str, report: &Report) -> Result<String, Error> {
    let parts = page
        .split_once(BEGIN)
        .and_then(|(before, rest)| Some((before, rest.split_once(END)?.1)));
    let Some((before, after)) = parts else {
        return Err(Error::new(format!(
            "the page has no lines `{}` and `{}` to write between",
            BEGIN.trim_end(),
            END.trim_end()
        )));
    };
    let parts = [
        run(report),
        operations(report),
        times(report),
        generation(report),
        growth(report),
    ];
    let parts: Vec<String> = parts.into_iter().filter(|part| !part.is_empty()).collect();
    Ok(format!(
        "{before}{BEGIN}\n{}\n{END}{after}",
        parts.join("\n")
    ))
}

/// Where and when it was measured, and how far to trust a row.
fn run(report: &Report) -> String {
    let run = &report.run;
    let tools = run.tools.iter();
    let tools: Vec<String> = tools
        .map(|(name, version)| format!("{name}: {version}"))
        .collect();
    let mut spreads: Vec<f64> = report.rows.iter().map(|row| 100.0 * row.spread).collect();
    spreads.sort_by(f64::total_cmp);
    let middle = spreads.get(spreads.len() / 2).copied().unwrap_or_default();
    let worst = spreads.last().copied().unwrap_or_default();
    format!(
        "Measured on {}: {}, {} cores, {} passes.\n{}.\n\
         The middle half of a row's passes spans {middle:.1} % of their median in the median row, {worst:.1} % in the worst.\n",
        run.date,
        run.processor,
        run.cores,
        run.passes,
        tools.join("; ")
    )
}

fn generation(report: &Report) -> String {
    if report.generation.is_empty() {
        return String::new();
    }
    let mut text =
        String::from("| all functions of | generation, s | rustc, release, s |\n|---|--:|--:|\n");
    for row in &report.generation {
        writeln!(
            text,
            "| {} | {:.2} | {:.1} |",
            row.robot, row.seconds, row.rustc_seconds
        )
        .expect("a string takes text");
    }
    text
}

fn growth(report: &Report) -> String {
    if report.growth.is_empty() {
        return String::new();
    }
    let mut text = String::from(
        "| joints of a chain | operations of `inverse_dynamics`, runtime | a joint | generation, s |\n|--:|--:|--:|--:|\n",
    );
    for row in &report.growth {
        let a_joint = row.inverse_dynamics as f64 / row.joints as f64;
        writeln!(
            text,
            "| {} | {} | {a_joint:.0} | {:.1} |",
            row.joints, row.inverse_dynamics, row.seconds
        )
        .expect("a string takes text");
    }
    text
}

fn operations(report: &Report) -> String {
    let mut text =
        String::from("| operations, PUMA 560 / Panda | here | to reach |\n|---|---|---|\n");
    for (function, form, [puma, panda]) in WISHED {
        let here = ["puma560", "panda"].map(|robot| {
            let found = report
                .rows
                .iter()
                .find(|row| row.robot == robot && row.function == function && row.form == form);
            found.map_or_else(|| "-".to_owned(), |row| (row.mul + row.add).to_string())
        });
        let [here, there] = here;
        let form = form.name();
        writeln!(
            text,
            "| `{function}`, {form} | {here} / {there} | {puma} / {panda} |"
        )
        .expect("a string takes text");
    }
    text
}

fn times(report: &Report) -> String {
    let mut text = String::from(
        "| robot | function | form | ops | trig | ns | plain | C | arithmetic | fastest peer | its ns | ratio | ratio, plain | ratio of arithmetic |\n\
         |---|---|---|--:|--:|--:|--:|--:|--:|---|--:|--:|--:|--:|\n",
    );
    for row in &report.rows {
        line(&mut text, row);
    }
    text
}

fn line(text: &mut String, row: &Row) {
    let cells = crate::table::cells(row);
    let [robot, function, form, rest @ ..] = &cells;
    writeln!(
        text,
        "| {robot} | `{function}` | {form} | {} |",
        rest.join(" | ")
    )
    .expect("a string takes text");
}

#[cfg(test)]
mod tests {
    use super::{BEGIN, END, renewed};
    use crate::report::{Report, example_report};

    #[test]
    fn tables_are_renewed_between_the_marks() {
        let report = example_report();
        let page = format!("before\n{BEGIN}old\n{END}after\n");
        let text = renewed(&page, &report).expect("the marks are there");
        assert!(
            text.starts_with("before\n") && text.ends_with("after\n"),
            "{text}"
        );
        assert!(!text.contains("old"), "{text}");
        assert!(
            text.contains("| `gravity`, baked | 56 / - | 80 / 150 |"),
            "{text}"
        );
        assert!(
            text.contains("| puma560 | `gravity` | baked | 56 | 10 | 15.0 | 25.0 | 18.0 | 6.0 | symforce | 60.0 | 0.25 | 0.42 | 0.50 |"),
            "{text}"
        );
        for line in [
            "Measured on 2026-01-31: abacus, 2 cores, 5 passes.\ncasadi: 3.8.\n",
            "spans 3.0 % of their median in the median row, 3.0 % in the worst.",
            "| puma560 | 1.25 | 6.0 |",
            "| 5 | 400 | 80 | 0.5 |",
        ] {
            assert!(text.contains(line), "{line} in {text}");
        }
        assert_eq!(renewed(&text, &report).ok(), Some(text));
    }

    #[test]
    fn what_was_not_measured_has_no_table() {
        let report = Report {
            rows: Vec::new(),
            generation: Vec::new(),
            growth: Vec::new(),
            ..example_report()
        };
        let text = renewed(&format!("{BEGIN}{END}"), &report).expect("the marks are there");
        assert!(!text.contains("| generation"), "{text}");
        assert!(text.contains("spans 0.0 %"), "{text}");
    }

    #[test]
    fn a_page_without_marks_is_left_alone() {
        let error = renewed("nothing", &example_report()).expect_err("no marks");
        assert!(error.to_string().contains("--docs"), "{error}");
    }
}
