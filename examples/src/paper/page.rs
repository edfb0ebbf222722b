//! A page of the docs beside what the program says: nothing on it may be of an older run.

use super::table::wrapped;
use super::{Paper, Status, Table, numbers, row};

/// What heads the items on a page; they are its last part.
const ITEMS: &str = "## Item by item";

impl Paper {
    /// As text for `docs/papers`: all tables, then the items.
    #[must_use]
    pub fn markdown(&self) -> String {
        let tables = self.tables.iter().map(|table| table.markdown() + "\n");
        tables.collect::<String>() + &self.items()
    }

    /// Outcomes as a table, and every item with what is printed and what came out.
    fn items(&self) -> String {
        let items: String = self.rows.iter().map(row::Row::markdown).collect();
        format!("{ITEMS}\n\n{}\n{items}", row::table(&self.rows).body())
    }

    /// What a page of the docs says otherwise than the program, or does not say.
    ///
    /// Every item has to stand on the page with all that the program says of it, and every line of a table on the page has to be one of
    /// the program's. Numbers may differ in their last digits, as from one machine to another ([`numbers::agree`]).
    #[must_use]
    pub fn differences(&self, page: &str) -> Vec<String> {
        let (text, items) = page.split_once(ITEMS).unwrap_or((page, ""));
        let mut found = Vec::new();
        let entries: Vec<&str> = items.split("\n- **").skip(1).collect();
        for row in &self.rows {
            let own = row.markdown();
            let start = format!("{}**", row.item);
            let entry = entries.iter().find(|entry| entry.starts_with(&start));
            let own = own.trim_start_matches("- **");
            if entry.is_none_or(|entry| !numbers::agree(entry, own)) {
                found.push(format!("{}: the program says {}", row.item, own.trim()));
            }
        }
        for entry in &entries {
            let of_row = |row: &row::Row| entry.starts_with(&format!("{}**", row.item));
            if !self.rows.iter().any(of_row) {
                found.push(format!("no item of the program: {}", entry.trim()));
            }
        }
        let lines = text.lines().filter(|line| line.starts_with('|'));
        let unknown = lines.filter(|line| !self.tables.iter().any(|table| has(table, line)));
        let outcomes = items.lines().filter(|line| line.starts_with('|'));
        let own = row::table(&self.rows);
        let outcomes = outcomes.filter(|line| !has(&own, line));
        let unknown = unknown.chain(outcomes);
        found.extend(unknown.map(|line| format!("no line of the program: {line}")));
        found
    }

    /// What a list of papers has otherwise than the program: `| .. | .. | reached | not reached | impossible as printed |`.
    #[must_use]
    pub fn counted_otherwise(&self, list: &str, name: &str) -> Option<String> {
        let count = |wanted: &str| {
            let same = self.rows.iter().filter(|row| row.status.short() == wanted);
            match same.count() {
                0 => String::new(),
                count => count.to_string(),
            }
        };
        let own = [
            Status::Reached,
            Status::NotReached(String::new()),
            Status::Impossible(String::new()),
        ];
        let own = own.map(|status| count(status.short()));
        let is_line = |line: &&str| line.starts_with(&format!("| [`{name}`]"));
        let line = list.lines().find(is_line).unwrap_or_default();
        let cells: Vec<&str> = line.split('|').map(str::trim).collect();
        let is_same = cells.get(3..6).is_some_and(|cells| cells == own);
        (!is_same).then(|| format!("{own:?} in the program: {line}"))
    }

    /// The page with the program's own tables below their titles, and its items.
    #[must_use]
    pub fn rewritten(&self, page: &str) -> String {
        let (text, _) = page.split_once(ITEMS).unwrap_or((page, ""));
        let mut lines = text.lines().peekable();
        let mut new = String::new();
        while let Some(line) = lines.next() {
            new += line;
            new += "\n";
            let mut tables = self.tables.iter();
            let of_title = |table: &&Table| line.strip_prefix("### ") == Some(&table.title);
            let Some(table) = tables.find(of_title) else {
                continue;
            };
            while lines
                .next_if(|line| line.is_empty() || line.starts_with('|'))
                .is_some()
            {}
            new += "\n";
            new += &table.body();
            new += "\n";
        }
        new + &self.items()
    }

    /// For a terminal.
    pub(super) fn text(&self) -> String {
        let title = wrapped(&self.title, super::table::WIDTH).join("\n");
        let tables = self.tables.iter().map(|table| format!("{table}\n"));
        let items: Vec<String> = self.rows.iter().map(row::Row::block).collect();
        format!(
            "{title}\n\n{}Item by item\n\n{}",
            tables.collect::<String>(),
            items.join("\n")
        )
    }
}

/// Whether a table has this line.
fn has(table: &Table, line: &str) -> bool {
    let body = table.body();
    body.lines().any(|own| {
        if table.is_rough {
            numbers::have_same_words(line, own)
        } else {
            numbers::agree(line, own)
        }
    })
}

#[cfg(test)]
mod tests {
    use super::super::Row;
    use super::*;

    fn paper(cost: &str) -> Paper {
        let mut table = Table::new("Costs", ["law", "cost"]);
        table.push(["one", cost]);
        Paper {
            title: "a paper".to_owned(),
            tables: vec![table],
            rows: vec![
                Row::holds(
                    "9.1",
                    "a cost",
                    "2.0",
                    format!("{cost} after 6 steps"),
                    true,
                    "",
                ),
                Row::holds("9.2", "a * b", "3 | 4", "none", false, "of a reason"),
            ],
            figures: Vec::new(),
        }
    }

    #[test]
    fn a_page_agrees_with_what_it_was_written_from_and_with_no_other_run() {
        let page = format!("# A paper\n\nText.\n\n{}", paper("2.134").markdown());
        assert_eq!(paper("2.134").differences(&page), [""; 0]);
        assert_eq!(paper("2.135").differences(&page), [""; 0]);
        let other = paper("2.234").differences(&page);
        assert_eq!(other.len(), 2, "{other:?}");
        assert!(other[0].starts_with("9.1") && other[1].contains("| one | 2.134 |"));
        let mended = paper("2.234").rewritten(&page);
        assert_eq!(paper("2.234").differences(&mended), [""; 0]);
        assert!(mended.starts_with("# A paper\n\nText.\n"));
    }

    #[test]
    fn outcomes_are_counted() {
        let list = "| [`seed_009`](seed_009.md) | costs | 1 | 1 | |";
        assert_eq!(paper("2").counted_otherwise(list, "seed_009"), None);
        let list = list.replace("| 1 | 1 |", "| 2 | |");
        assert!(paper("2").counted_otherwise(&list, "seed_009").is_some());
    }

    #[test]
    fn no_line_of_the_terminal_is_wide() {
        let text = paper(&"many words ".repeat(40)).text();
        assert!(
            text.lines().all(|line| line.chars().count() <= 110),
            "{text}"
        );
    }
}
