//! What a paper says beside what came out here, on a terminal, as Markdown, and drawn.

mod audited;
mod drawing;
mod figure;
mod integrator;
mod list;
mod looks;
pub mod numbers;
mod page;
mod program;
mod row;
mod sensor;
mod spec;
mod table;
mod threads;
mod wanted;

use std::fmt;

pub use audited::Audited;
pub use figure::{Figure, Mark, Series};
pub use integrator::rk4;
pub use list::listed_otherwise;
pub use numbers::have_same_words;
pub use program::main;
pub use row::{Row, Status};
pub use sensor::{normal, rounded};
pub use spec::{compiled, interpreted, refused};
pub use table::Table;
pub use threads::{both, in_threads};
pub use wanted::{WANTED, lacking, wanted};

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
    /// The row with this number.
    #[must_use]
    pub fn row(&self, item: &str) -> Option<&Row> {
        self.rows.iter().find(|row| row.item == item)
    }

    /// Numbers of the rows that are not reached, and of those that are impossible as printed.
    #[must_use]
    pub fn failing(&self) -> [Vec<&'static str>; 2] {
        let of = |wanted: fn(&Status) -> bool| {
            let rows = self.rows.iter().filter(|row| wanted(&row.status));
            rows.map(|row| row.item).collect()
        };
        [
            of(|status| matches!(status, Status::NotReached(_))),
            of(|status| matches!(status, Status::Impossible(_))),
        ]
    }
}

impl fmt::Display for Paper {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text())
    }
}
