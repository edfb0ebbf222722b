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
    let (operations, times) = (operations(report), times(report));
    Ok(format!(
        "{before}{BEGIN}\n{operations}\n{times}\n{END}{after}"
    ))
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
        "| robot | function | form | ops | trig | ns | plain | arithmetic | fastest peer | its ns | ratio | ratio of arithmetic |\n\
         |---|---|---|--:|--:|--:|--:|--:|---|--:|--:|--:|\n",
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
    use crate::report::{Report, example};

    #[test]
    fn tables_are_renewed_between_the_marks() {
        let report = Report {
            rows: vec![example()],
        };
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
            text.contains("| puma560 | `gravity` | baked | 56 | 10 | 15.0 | 25.0 | 6.0 | symforce | 60.0 | 0.25 | 0.50 |"),
            "{text}"
        );
        assert_eq!(renewed(&text, &report).ok(), Some(text));
    }

    #[test]
    fn a_page_without_marks_is_left_alone() {
        let error = renewed("nothing", &Report { rows: Vec::new() }).expect_err("no marks");
        assert!(error.to_string().contains("--docs"), "{error}");
    }
}
