//! A page of the docs beside what the program says: nothing on it may be of an older run.

use super::table::wrapped;
use super::{Paper, Row, Status, Table, numbers, row};

/// What heads the items on a page; they are its last part.
pub(super) const ITEMS: &str = "## Item by item";

/// Places in a figure may differ by this, in pixels, as from one machine to another.
const PIXELS: f64 = 2.0;

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
    /// Every item has to stand on the page with all that the program says of it, every table under its title, and every line of a table on
    /// the page has to be one of the program's. Numbers may differ in their last digits, as from one machine to another ([`numbers::agree`]).
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
        let lines = || text.lines().filter(|line| line.starts_with('|'));
        for table in &self.tables {
            let is_titled = text
                .lines()
                .any(|line| line.strip_prefix("### ") == Some(&table.title));
            let body = table.body();
            let mut own = body.lines();
            if !is_titled || !own.all(|own| lines().any(|line| table.is_alike(line, own))) {
                found.push(format!("not on the page: {}", table.title));
            }
        }
        let unknown = lines().filter(|line| !self.tables.iter().any(|table| has(table, line)));
        let outcomes = items.lines().filter(|line| line.starts_with('|'));
        let own = row::table(&self.rows);
        let outcomes = outcomes.filter(|line| !has(&own, line));
        let unknown = unknown.chain(outcomes);
        found.extend(unknown.map(|line| format!("no line of the program: {line}")));
        found
    }

    /// Figures of a page, `figures/NAME_FIGURE.svg` beside it, that show something else than the program's, or are none of them; `read` has the
    /// text of a file.
    #[must_use]
    pub fn drawn_otherwise(
        &self,
        page: &str,
        name: &str,
        read: impl Fn(&str) -> Option<String>,
    ) -> Vec<String> {
        let start = format!("(figures/{name}_");
        let shown = page.split(&start).skip(1);
        let shown = shown.filter_map(|rest| Some(rest.split_once(".svg)")?.0));
        let is_other = |shown: &&str| {
            let own = self.figures.iter().find(|figure| figure.name == *shown);
            let file = read(&format!("figures/{name}_{shown}.svg"));
            !own.zip(file)
                .is_some_and(|(own, file)| numbers::are_within(&own.svg(), &file, PIXELS))
        };
        shown.filter(is_other).map(str::to_owned).collect()
    }

    /// What a list of papers has otherwise than the program: `| .. | .. | reached | not reached | impossible as printed | remarks |`.
    #[must_use]
    pub fn counted_otherwise(&self, list: &str, name: &str) -> Option<String> {
        let count = |wanted: &dyn Fn(&Row) -> bool| {
            let same = self.rows.iter().filter(|row| wanted(row));
            match same.count() {
                0 => String::new(),
                count => count.to_string(),
            }
        };
        let own = [
            count(&|row| matches!(row.status, Status::Reached)),
            count(&|row| matches!(row.status, Status::NotReached(_))),
            count(&|row| matches!(row.status, Status::Impossible(_))),
            count(&|row| matches!(row.status, Status::Remark(_))),
        ];
        let is_line = |line: &&str| line.starts_with(&format!("| [`{name}`]"));
        let line = list.lines().find(is_line).unwrap_or_default();
        let cells: Vec<&str> = line.split('|').map(str::trim).collect();
        let is_same = cells.get(3..7).is_some_and(|cells| cells == own);
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
    body.lines().any(|own| table.is_alike(line, own))
}

impl Table {
    /// Whether a line on a page is one of the table's own.
    fn is_alike(&self, line: &str, own: &str) -> bool {
        if self.is_rough {
            numbers::have_same_words(line, own)
        } else {
            numbers::agree(line, own)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Figure, Mark, Row};
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
        assert_eq!(other.len(), 3, "{other:?}");
        assert!(other[0].starts_with("9.1") && other[2].contains("| one | 2.134 |"));
        let bare = page.replace("| one | 2.134 |\n", "");
        assert_eq!(
            paper("2.134").differences(&bare),
            ["not on the page: Costs"]
        );
        let mended = paper("2.234").rewritten(&page);
        assert_eq!(paper("2.234").differences(&mended), [""; 0]);
        assert!(mended.starts_with("# A paper\n\nText.\n"));
    }

    #[test]
    fn figures_are_those_of_the_program() {
        let figure = |y: f64| {
            let points = [(0.0, 1.0), (1.0, y), (2.0, 3.0)];
            Figure::new("fall", "a fall", "time, s", "angle, rad").with("one", Mark::Line, points)
        };
        let paper = Paper {
            figures: vec![figure(2.0)],
            ..paper("2")
        };
        let page = "![one](figures/seed_009_fall.svg) ![two](figures/seed_009_rise.svg)";
        let beside = |y: f64| move |_: &str| Some(figure(y).svg());
        assert_eq!(
            paper.drawn_otherwise(page, "seed_009", beside(2.0)),
            ["rise"]
        );
        assert_eq!(
            paper.drawn_otherwise(page, "seed_009", beside(2.5)),
            ["fall", "rise"]
        );
        assert_eq!(
            paper.drawn_otherwise(page, "seed_009", |_| None),
            ["fall", "rise"]
        );
    }

    #[test]
    fn outcomes_are_counted() {
        let list = "| [`seed_009`](seed_009.md) | costs | 1 | 1 | |";
        assert_eq!(paper("2").counted_otherwise(list, "seed_009"), None);
        let list = list.replace("| 1 | 1 |", "| 2 | |");
        assert!(paper("2").counted_otherwise(&list, "seed_009").is_some());
    }

    #[test]
    fn remarks_are_counted_apart() {
        let of = |row| Paper {
            rows: vec![row],
            ..Paper::default()
        };
        let list = |cells: &str| format!("| [`seed_009`](seed_009.md) | costs |{cells}");
        let wrong = of(Row::wrong_in_print(
            "9.3",
            "c",
            "4",
            "5",
            true,
            "of a digit",
        ));
        let cells = list(" | | 1 | |");
        assert_eq!(wrong.counted_otherwise(&cells, "seed_009"), None);
        let remark = |is_found| of(Row::remark("9.3", "c", "4", "5", is_found, "of a digit"));
        let cells = list(" | | | 1 |");
        assert_eq!(remark(true).counted_otherwise(&cells, "seed_009"), None);
        assert!(remark(true).text().contains("a remark: of a digit"));
        // What does not show is none.
        let cells = list(" | 1 | | |");
        assert_eq!(remark(false).counted_otherwise(&cells, "seed_009"), None);
        assert!(!remark(false).text().contains("a remark"));
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
