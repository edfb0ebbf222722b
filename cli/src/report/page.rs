//! A page of HTML: headings, tables that sort, figures, and a style for screens, phones and paper, in light and dark.

use std::fmt::Write;

const STYLE: &str = include_str!("page.css");
const SCRIPT: &str = include_str!("page.js");

/// What stands in a column of numbers where there is none to compare.
const BESIDE_NUMBERS: [&str; 3] = ["", "-", "worse"];

const PUT: &str = "a string takes all";

/// A page that grows from its head to its end.
#[derive(Debug)]
pub(crate) struct Page {
    title: String,
    contents: Vec<(String, String)>,
    body: String,
    figures: usize,
}

impl Page {
    /// A page with its title and the line below it.
    pub(crate) fn new(title: &str, lead: &str) -> Self {
        Self {
            title: title.to_owned(),
            contents: Vec::new(),
            body: format!("<p class=\"lead\">{}</p>\n", escaped(lead)),
            figures: 0,
        }
    }

    /// Begins a section.
    pub(crate) fn section(&mut self, title: &str) {
        let anchor: String = title
            .chars()
            .map(|c| {
                if c.is_ascii_alphanumeric() {
                    c.to_ascii_lowercase()
                } else {
                    '-'
                }
            })
            .collect();
        let title = escaped(title);
        writeln!(self.body, "<h2 id=\"{anchor}\">{title}</h2>").expect(PUT);
        self.contents.push((anchor, title));
    }

    /// Begins a part of a section.
    pub(crate) fn part(&mut self, title: &str) {
        writeln!(self.body, "<h3>{}</h3>", escaped(title)).expect(PUT);
    }

    /// A paragraph.
    pub(crate) fn text(&mut self, text: &str) {
        writeln!(self.body, "<p>{}</p>", prose(text)).expect(PUT);
    }

    /// The outcome, set off from the rest; `class` is that of its color.
    pub(crate) fn verdict(&mut self, class: &str, word: &str, text: &str) {
        let (word, text) = (prose(word), prose(text));
        writeln!(
            self.body,
            "<div class=\"verdict {class}\"><strong>{word}</strong> {text}</div>"
        )
        .expect(PUT);
    }

    /// A list.
    pub(crate) fn list(&mut self, items: &[String]) {
        self.body.push_str("<ul>\n");
        for item in items {
            writeln!(self.body, "<li>{}</li>", prose(item)).expect(PUT);
        }
        self.body.push_str("</ul>\n");
    }

    /// Text as it is set, as that of a terminal.
    pub(crate) fn preformatted(&mut self, text: &str) {
        writeln!(
            self.body,
            "<div class=\"wide\" tabindex=\"0\"><pre>{}</pre></div>",
            escaped(text)
        )
        .expect(PUT);
    }

    /// Commands, a line each, which wrap where the page is narrow; they are copied as they were.
    pub(crate) fn commands(&mut self, commands: &str) {
        writeln!(
            self.body,
            "<pre class=\"commands\">{}</pre>",
            escaped(commands)
        )
        .expect(PUT);
    }

    /// A table; a click on a head sorts it. Cells that begin with a number stand to the right.
    pub(crate) fn table(&mut self, caption: &str, head: &[&str], rows: &[Vec<String>]) {
        self.rows(caption, head, rows, false);
    }

    /// A table whose rows are cards on a phone: their names above their cells, and the last cell, which is a sentence, below them.
    pub(crate) fn cards(&mut self, caption: &str, head: &[&str], rows: &[Vec<String>]) {
        self.rows(caption, head, rows, true);
    }

    fn rows(&mut self, caption: &str, head: &[&str], rows: &[Vec<String>], are_cards: bool) {
        let class = if are_cards { " class=\"cards\"" } else { "" };
        writeln!(
            self.body,
            "<div class=\"wide\" tabindex=\"0\"><table{class}><caption>{}</caption><thead><tr>",
            prose(caption)
        )
        .expect(PUT);
        let is_number = |column: usize| {
            let mut cells = rows.iter().filter_map(|row| row.get(column));
            column > 0
                && cells.clone().any(|cell| number(cell).is_some())
                && cells
                    .all(|cell| number(cell).is_some() || BESIDE_NUMBERS.contains(&cell.as_str()))
        };
        let are_numbers: Vec<bool> = (0..head.len()).map(is_number).collect();
        for (name, is_number) in head.iter().zip(&are_numbers) {
            let class = if *is_number { " class=\"number\"" } else { "" };
            writeln!(
                self.body,
                "<th scope=\"col\"{class}><button type=\"button\">{}</button></th>",
                prose(name)
            )
            .expect(PUT);
        }
        self.body.push_str("</tr></thead><tbody>\n");
        for row in rows {
            self.body.push_str("<tr>");
            for (column, cell) in row.iter().enumerate() {
                let text = prose(cell);
                // What a head says of the column, where a card has none.
                let named = match head.get(column).filter(|_| are_cards) {
                    Some(head) => format!(" data-head=\"{}\"", escaped(head)),
                    None => String::new(),
                };
                let cell = match (column, number(cell)) {
                    (0, _) => format!("<th scope=\"row\">{text}</th>"),
                    (_, Some(value)) => {
                        format!("<td class=\"number\"{named} data-value=\"{value}\">{text}</td>")
                    }
                    // `-` among numbers.
                    _ if are_numbers.get(column) == Some(&true) => {
                        format!("<td class=\"number\"{named}>{text}</td>")
                    }
                    _ => format!("<td{named}>{text}</td>"),
                };
                self.body.push_str(&cell);
            }
            self.body.push_str("</tr>\n");
        }
        self.body.push_str("</tbody></table></div>\n");
    }

    /// A row of figures above one caption, with the colors that they share. One alone may be wider than a phone, which then scrolls.
    pub(crate) fn figures(&mut self, drawings: &[String], legend: &[(&str, &str)], caption: &str) {
        self.figures += 1;
        let div = if drawings.len() == 1 {
            "<div class=\"drawings wide\" tabindex=\"0\">"
        } else {
            "<div class=\"drawings\">"
        };
        writeln!(self.body, "<figure>{div}").expect(PUT);
        for drawing in drawings {
            self.body.push_str(drawing);
            self.body.push('\n');
        }
        writeln!(
            self.body,
            "</div><figcaption>Figure {}. {}",
            self.figures,
            prose(caption)
        )
        .expect(PUT);
        for (color, name) in legend {
            writeln!(
                self.body,
                " <span class=\"key\"><span class=\"{color}\" aria-hidden=\"true\"></span>{}</span>",
                prose(name)
            )
            .expect(PUT);
        }
        self.body.push_str("</figcaption></figure>\n");
    }

    /// What is seen when it is opened.
    pub(crate) fn folded(&mut self, summary: &str, is_open: bool, inside: impl FnOnce(&mut Self)) {
        let open = if is_open { " open" } else { "" };
        writeln!(
            self.body,
            "<details{open}><summary>{}</summary>",
            prose(summary)
        )
        .expect(PUT);
        inside(self);
        self.body.push_str("</details>\n");
    }

    /// The whole text.
    pub(crate) fn finish(self) -> String {
        let links = self
            .contents
            .iter()
            .map(|(anchor, title)| format!("<li><a href=\"#{anchor}\">{title}</a></li>"));
        let links: String = links.collect();
        let title = escaped(&self.title);
        format!(
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
             <title>{title}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n<main>\n<h1>{title}</h1>\n\
             <nav aria-label=\"contents\"><ul>{links}</ul></nav>\n{}</main>\n<script>\n{SCRIPT}</script>\n</body>\n</html>\n",
            self.body
        )
    }
}

/// The number that a cell begins with, by which it is sorted.
fn number(cell: &str) -> Option<f64> {
    let first = cell.split_whitespace().next()?;
    first.parse::<f64>().ok().filter(|value| value.is_finite())
}

/// A sentence as a page sets it: words between backticks as code, signs and powers as in print.
fn prose(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let mut parts = text.split('`').peekable();
    let mut is_code = false;
    while let Some(part) = parts.next() {
        // A backtick without its other one stands for itself.
        match (is_code, parts.peek()) {
            (true, Some(_)) => {
                out.push_str("<code>");
                out.push_str(&escaped(part));
                out.push_str("</code>");
            }
            (true, None) => {
                out.push('`');
                out.push_str(&set(part));
            }
            (false, _) => out.push_str(&set(part)),
        }
        is_code = !is_code;
    }
    out
}

/// Plain words of it.
fn set(text: &str) -> String {
    let signs = escaped(text).replace(" +- ", " ± ");
    let mut set = String::with_capacity(signs.len());
    let mut rest = signs.as_str();
    while let Some(at) = rest.find('^') {
        let (before, power) = rest.split_at(at);
        set.push_str(before);
        let mut after = power[1..].chars();
        let (digit, next) = (after.next(), after.next());
        // A power of several digits stays.
        let is_one = !next.is_some_and(|next| next.is_ascii_digit());
        let sign = match digit.filter(|_| is_one) {
            Some('2') => "²",
            Some('3') => "³",
            _ => {
                set.push('^');
                rest = &power[1..];
                continue;
            }
        };
        set.push_str(sign);
        rest = &power[2..];
    }
    set + rest
}

/// Text that HTML shows as it is.
pub(super) fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            other => out.push(other),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_text_and_no_markup() {
        let mut page = Page::new("a <b> & \"c\"", "lead");
        page.section("one <two>");
        page.table(
            "t",
            &["a", "b"],
            &[vec!["<x>".to_owned(), "1.5 %".to_owned()]],
        );
        let html = page.finish();
        assert!(
            html.contains("<title>a &lt;b&gt; &amp; &quot;c&quot;</title>"),
            "{html}"
        );
        assert!(
            html.contains("<h2 id=\"one--two-\">one &lt;two&gt;</h2>"),
            "{html}"
        );
        assert!(html.contains("<th scope=\"row\">&lt;x&gt;</th>"), "{html}");
        assert!(html.contains("data-value=\"1.5\">1.5 %</td>"), "{html}");
        assert!(
            html.contains("<th scope=\"col\" class=\"number\">"),
            "{html}"
        );
    }

    #[test]
    fn sentences_are_set_as_in_print() {
        assert_eq!(
            prose("`a<b` is 2 +- 0.1 kg m^2, `x^2"),
            "<code>a&lt;b</code> is 2 ± 0.1 kg m², `x²"
        );
        assert_eq!(prose("2^32 at a+-b, x^3"), "2^32 at a+-b, x³");
        // What stands between backticks is what a file says.
        assert_eq!(prose("write `q^2`"), "write <code>q^2</code>");
    }
}
