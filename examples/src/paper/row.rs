//! Items of the list of what a reproduction has to show, and what became of each.

use std::fmt;

use super::Table;

/// What became of an item.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Status {
    /// It came out.
    Reached,
    /// It did not come out, and why.
    NotReached(String),
    /// It cannot come out as it is printed, and why.
    Impossible(String),
}

impl fmt::Display for Status {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Reached => f.write_str("reached"),
            Self::NotReached(why) => write!(f, "not reached: {why}"),
            Self::Impossible(why) => write!(f, "impossible as printed: {why}"),
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
        let status = if holds {
            Status::Reached
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

    /// An item that the paper has wrong: the program found `found`, which shows it; where it did not, the item is not reached.
    pub fn wrong_in_print(
        item: &'static str,
        what: impl Into<String>,
        printed: impl Into<String>,
        found: impl Into<String>,
        is_found: bool,
        why: &str,
    ) -> Self {
        let status = if is_found {
            Status::Impossible(why.to_owned())
        } else {
            Status::NotReached("the checks do not show what is wrong".to_owned())
        };
        Self {
            item,
            what: what.into(),
            printed: printed.into(),
            ours: found.into(),
            status,
        }
    }
}

/// All items as a table.
pub(super) fn table(rows: &[Row]) -> Table {
    let mut table = Table::new(
        "Item by item",
        ["item", "what", "printed", "here", "outcome"],
    );
    for row in rows {
        table.push([
            row.item.to_owned(),
            row.what.clone(),
            row.printed.clone(),
            row.ours.clone(),
            row.status.to_string(),
        ]);
    }
    table
}
