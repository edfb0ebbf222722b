//! Tables of text, for a terminal and as Markdown.

use std::fmt;

/// Letters of a line of the terminal, at most.
pub(super) const WIDTH: usize = 108;

/// A table with a title and a head.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Table {
    /// What it shows.
    pub title: String,
    head: Vec<String>,
    rows: Vec<Vec<String>>,
    /// Its numbers follow rounding, which differs from machine to machine: a page may have others.
    pub(super) is_rough: bool,
}

impl Table {
    /// A table without rows.
    pub fn new<const N: usize>(title: impl Into<String>, head: [&str; N]) -> Self {
        Self {
            title: title.into(),
            head: head.map(str::to_owned).to_vec(),
            rows: Vec::new(),
            is_rough: false,
        }
    }

    /// The same, of numbers that follow rounding, as those of unstable motions do.
    #[must_use]
    pub fn rough(mut self) -> Self {
        self.is_rough = true;
        self
    }

    /// One more row, with as many cells as the head has; missing ones are empty.
    pub fn push(&mut self, cells: impl IntoIterator<Item = impl Into<String>>) {
        let mut cells: Vec<String> = cells.into_iter().map(Into::into).collect();
        cells.resize(self.head.len(), String::new());
        self.rows.push(cells);
    }

    /// As Markdown, with the title as a heading.
    #[must_use]
    pub fn markdown(&self) -> String {
        format!("### {}\n\n{}", self.title, self.body())
    }

    /// As Markdown, without the title.
    #[must_use]
    pub fn body(&self) -> String {
        let line = |cells: &[String]| {
            let cells: Vec<String> = cells.iter().map(|cell| cell.replace('|', "\\|")).collect();
            format!("| {} |\n", cells.join(" | "))
        };
        let rule = format!("|{}\n", "---|".repeat(self.head.len()));
        let rows: String = self.rows.iter().map(|row| line(row)).collect();
        format!("{}{rule}{rows}", line(&self.head))
    }

    /// Letters that each column gets: what it needs, where all do not need too much; the widest ones share what is left.
    fn widths(&self) -> Vec<usize> {
        let all = || std::iter::once(&self.head).chain(&self.rows);
        let needed = |column: usize| all().map(|row| row[column].chars().count()).max();
        let mut widths: Vec<usize> = (0..self.head.len()).filter_map(needed).collect();
        let mut order: Vec<usize> = (0..widths.len()).collect();
        order.sort_by_key(|&column| widths[column]);
        // Two letters before each.
        let mut left = WIDTH - 2 * widths.len();
        for (place, &column) in order.iter().enumerate() {
            widths[column] = widths[column].min(left / (order.len() - place));
            left -= widths[column];
        }
        widths
    }
}

impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let widths = self.widths();
        for line in wrapped(&self.title, WIDTH) {
            writeln!(f, "{line}")?;
        }
        for row in std::iter::once(&self.head).chain(&self.rows) {
            let cells = row.iter().zip(&widths);
            let cells: Vec<Vec<String>> =
                cells.map(|(cell, &width)| wrapped(cell, width)).collect();
            for line in 0..cells.iter().map(Vec::len).max().unwrap_or(0) {
                let parts = cells.iter().zip(&widths).map(|(cell, &width)| {
                    let part = cell.get(line).map_or("", String::as_str);
                    format!("{part:width$}")
                });
                let parts: Vec<String> = parts.collect();
                writeln!(f, "  {}", parts.join("  ").trim_end())?;
            }
        }
        Ok(())
    }
}

/// Lines of so many letters at most, broken between words where these are not longer; at least one.
pub(super) fn wrapped(text: &str, width: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in text.split_whitespace() {
        let mut letters: Vec<char> = word.chars().collect();
        while !letters.is_empty() {
            let line = lines.last_mut().expect("there is one");
            let used = line.chars().count();
            let space = usize::from(used > 0);
            if used + space + letters.len() <= width {
                line.extend(std::iter::repeat_n(' ', space).chain(letters.drain(..)));
            } else if used > 0 {
                lines.push(String::new());
            } else {
                line.extend(letters.drain(..width.max(1)));
            }
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_as_wide_as_their_widest_cell() {
        let mut table = Table::new("Costs", ["law", "cost"]);
        table.push(["one side", "8.23"]);
        table.push(["x|x|"]);
        assert_eq!(
            table.to_string(),
            "Costs\n  law       cost\n  one side  8.23\n  x|x|\n"
        );
        assert!(table.markdown().contains("| x\\|x\\| |  |\n"));
    }

    #[test]
    fn no_line_of_a_wide_table_is_wide() {
        let mut table = Table::new("Wide", ["name", "first", "second"]);
        table.push(["a", &"some words ".repeat(30), &"others ".repeat(40)]);
        table.push(["b", &"x".repeat(300), "short"]);
        let text = table.to_string();
        assert!(
            text.lines().all(|line| line.chars().count() <= 110),
            "{text}"
        );
        let letters = |text: &str| text.matches('x').count();
        assert_eq!(letters(&text), 300);
    }
}
