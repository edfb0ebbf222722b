//! What a paper says beside what came out here, on a terminal, as Markdown, and drawn.

mod figure;
mod integrator;
mod program;
mod row;
mod table;

use std::fmt;

pub use figure::{Figure, Mark, Series};
pub use integrator::rk4;
pub use program::main;
pub use row::{Row, Status};
pub use table::Table;

/// An error of any of the libraries.
pub type Error = Box<dyn std::error::Error + Send + Sync>;

/// A paper, reproduced.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Paper {
    /// Whose arm it is and what is done with it.
    pub title: String,
    /// Its tables beside ours.
    pub tables: Vec<Table>,
    /// Every item of the list of what a reproduction has to show.
    pub rows: Vec<Row>,
    /// What its figures show.
    pub figures: Vec<Figure>,
}

impl Paper {
    /// As text for `docs/papers`.
    #[must_use]
    pub fn markdown(&self) -> String {
        let tables: Vec<String> = self.tables.iter().map(Table::markdown).collect();
        format!(
            "{}\n{}",
            tables.join("\n"),
            row::table(&self.rows).markdown()
        )
    }

    /// What a page of the docs says otherwise than the program: items with another outcome, or without a line of the table.
    ///
    /// A line is `| item | what | printed | here | outcome |`; numbers may differ in their last digits from one machine to
    /// another, outcomes may not.
    #[must_use]
    pub fn differences(&self, page: &str) -> Vec<String> {
        let lines = || page.lines().filter(|line| line.starts_with('|'));
        let says = |row: &&Row| {
            let outcome = format!("| {} |", row.status);
            let item = format!("| {} |", row.item);
            lines().any(|line| line.starts_with(&item) && line.ends_with(&outcome))
        };
        let otherwise = self.rows.iter().filter(|row| !says(row));
        otherwise
            .map(|row| format!("{}: {}", row.item, row.status))
            .collect()
    }

    /// The row with this number.
    #[must_use]
    pub fn row(&self, item: &str) -> Option<&Row> {
        self.rows.iter().find(|row| row.item == item)
    }
}

impl fmt::Display for Paper {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}\n", self.title)?;
        for table in &self.tables {
            writeln!(f, "{table}")?;
        }
        write!(f, "{}", row::table(&self.rows))
    }
}
