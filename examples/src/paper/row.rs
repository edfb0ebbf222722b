//! Items of the list of what a reproduction has to show, and what became of each.

use std::fmt;

use super::Table;
use super::table::wrapped;
use super::wanted::wanted;

/// What became of an item.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Status {
    /// It came out.
    Reached,
    /// It did not come out, and why.
    NotReached(String),
    /// It cannot come out as it is printed, and why: a check of the tool says so.
    Impossible(String),
    /// It is no item that has to come out, but something to know that no check of the tool says: the program compares numbers.
    Remark(String),
}

impl Status {
    /// In two or three words.
    #[must_use]
    pub fn short(&self) -> &'static str {
        match self {
            Self::Reached => "reached",
            Self::NotReached(_) => "not reached",
            Self::Impossible(_) => "impossible as printed",
            Self::Remark(_) => "a remark",
        }
    }
}

impl fmt::Display for Status {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.short())?;
        match self {
            Self::Reached => Ok(()),
            Self::NotReached(why) | Self::Impossible(why) | Self::Remark(why) => {
                write!(f, ": {why}")
            }
        }
    }
}

/// One item: what is printed and what came out here.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// Its number, that of the paper before the point.
    pub item: &'static str,
    /// What is compared.
    pub what: String,
    /// As the paper has it.
    pub printed: String,
    /// As it came out here.
    pub ours: String,
    /// Whether that is what was to come out.
    pub status: Status,
}

impl Row {
    /// An item that is reached where `holds`; `otherwise` says what keeps it from that.
    pub fn holds(
        item: &'static str,
        what: impl Into<String>,
        printed: impl Into<String>,
        ours: impl Into<String>,
        holds: bool,
        otherwise: &str,
    ) -> Self {
        Self::judged(
            item,
            what,
            printed,
            ours,
            (holds, Status::Reached),
            otherwise,
        )
    }

    /// An item that the paper has wrong: a check of the tool found `found`, which shows it; where it did not, the item is not reached.
    pub fn wrong_in_print(
        item: &'static str,
        what: impl Into<String>,
        printed: impl Into<String>,
        found: impl Into<String>,
        is_found: bool,
        why: &str,
    ) -> Self {
        let wrong = Status::Impossible(why.to_owned());
        let otherwise = "the checks do not show what is wrong";
        Self::judged(item, what, printed, found, (is_found, wrong), otherwise)
    }

    /// Something to know, where the program's own numbers show it; where they do not, it is not reached.
    pub fn remark(
        item: &'static str,
        what: impl Into<String>,
        printed: impl Into<String>,
        found: impl Into<String>,
        is_found: bool,
        why: &str,
    ) -> Self {
        let remark = Status::Remark(why.to_owned());
        let otherwise = "the numbers do not show it";
        Self::judged(item, what, printed, found, (is_found, remark), otherwise)
    }

    /// An item with an outcome where that holds, else not reached.
    fn judged(
        item: &'static str,
        what: impl Into<String>,
        printed: impl Into<String>,
        ours: impl Into<String>,
        (holds, outcome): (bool, Status),
        otherwise: &str,
    ) -> Self {
        let status = if holds {
            outcome
        } else {
            Status::NotReached(otherwise.to_owned())
        };
        Self {
            item,
            what: what.into(),
            printed: printed.into(),
            ours: ours.into(),
            status,
        }
    }

    /// What is told of it, each under a word.
    fn parts(&self) -> Vec<(&'static str, String)> {
        let wanted = wanted(self.item).map(|wanted| ("wanted", wanted.to_owned()));
        let printed = ("printed", self.printed.clone());
        let rest = [
            ("here", self.ours.clone()),
            ("outcome", self.status.to_string()),
        ];
        [printed].into_iter().chain(wanted).chain(rest).collect()
    }

    /// As an entry of a list in Markdown.
    pub(super) fn markdown(&self) -> String {
        let start = format!("- **{}**, {}", self.item, escaped(&self.what));
        let start = wrapped(&start, LINE).join("\n  ") + "\n";
        let parts = self.parts().into_iter().map(|(word, part)| {
            let lines = wrapped(&format!("{word}: {}", escaped(&part)), LINE);
            format!("  - {}\n", lines.join("\n    "))
        });
        start + &parts.collect::<String>()
    }

    /// As a block for a terminal.
    pub(super) fn block(&self) -> String {
        let width = super::table::WIDTH - INDENT.len();
        let what = format!("{}  {}", self.item, self.what);
        let what = wrapped(&what, width).join(&format!("\n{INDENT}"));
        let parts = self.parts().into_iter().map(|(word, part)| {
            let lines = wrapped(&format!("{word}: {part}"), width);
            format!("{INDENT}{}\n", lines.join(&format!("\n{INDENT}  ")))
        });
        format!("  {what}\n{}", parts.collect::<String>())
    }
}

/// Letters of a line in Markdown, and what comes before a line of a block.
const LINE: usize = 120;
const INDENT: &str = "    ";

/// What Markdown would take for emphasis.
fn escaped(text: &str) -> String {
    text.replace('*', "\\*")
}

/// All items and their outcomes as a table.
pub(super) fn table(rows: &[Row]) -> Table {
    let mut table = Table::new("Item by item", ["item", "what", "outcome"]);
    for row in rows {
        table.push([row.item, &row.what, row.status.short()]);
    }
    table
}
