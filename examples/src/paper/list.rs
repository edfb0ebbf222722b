//! The items of all papers in one table, as their pages have them.

use super::Table;
use super::page::ITEMS;

/// What heads the table in the list of papers; it is the last part.
const EVERY: &str = "## Every item";

/// Where nothing else is wanted of an item.
const FINDING: &str = "that it is found";

/// An item of a page, under the words of its parts.
struct Entry<'a> {
    item: &'a str,
    what: String,
    parts: Vec<(&'a str, String)>,
}

impl<'a> Entry<'a> {
    fn new(text: &'a str) -> Option<Self> {
        let (item, rest) = text.split_once("**, ")?;
        let mut parts = rest.split("\n  - ");
        let what = in_a_line(parts.next()?);
        let parts = parts.filter_map(|part| {
            let (word, told) = part.split_once(": ")?;
            Some((word, in_a_line(told)))
        });
        Some(Self {
            item,
            what,
            parts: parts.collect(),
        })
    }

    fn part(&self, word: &str) -> Option<&str> {
        let mut parts = self.parts.iter();
        let (_, told) = parts.find(|(own, _)| *own == word)?;
        Some(told)
    }
}

fn in_a_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<&str>>().join(" ")
}

fn entries(page: &str) -> impl Iterator<Item = Entry<'_>> {
    let (_, items) = page.split_once(ITEMS).unwrap_or_default();
    items.split("\n- **").skip(1).filter_map(Entry::new)
}

/// Every item of pages by their names, with what is wanted of it, what came out and the outcome.
fn table<'a>(pages: impl IntoIterator<Item = (&'a str, &'a str)>) -> Table {
    let head = ["item", "what", "wanted", "here", "outcome"];
    let mut table = Table::new(EVERY, head);
    for (name, page) in pages {
        for entry in entries(page) {
            let told = |word| entry.part(word).unwrap_or_default().to_owned();
            let wanted = entry.part("wanted").unwrap_or(FINDING);
            table.push([
                format!("[{}]({name}.md)", entry.item),
                entry.what.clone(),
                wanted.to_owned(),
                told("here"),
                told("outcome"),
            ]);
        }
    }
    table
}

/// The list of papers with the items of these pages; none where it has no such part.
#[must_use]
pub fn with_every_item<'a>(
    list: &str,
    pages: impl IntoIterator<Item = (&'a str, &'a str)>,
) -> Option<String> {
    let (text, _) = list.split_once(EVERY)?;
    Some(format!("{text}{EVERY}\n\n{}", table(pages).body()))
}

/// Lines of the list of papers that are no items of this page, and items of it that are not in the list.
#[must_use]
pub fn listed_otherwise(list: &str, name: &str, page: &str) -> Vec<String> {
    let (_, every) = list.split_once(EVERY).unwrap_or_default();
    let link = format!("]({name}.md) |");
    let listed: Vec<&str> = every.lines().filter(|line| line.contains(&link)).collect();
    let body = table([(name, page)]).body();
    let own: Vec<&str> = body.lines().skip(2).collect();
    let missing = own.iter().filter(|line| !listed.contains(line));
    let unknown = listed.iter().filter(|line| !own.contains(line));
    missing
        .chain(unknown)
        .map(|line| (*line).to_owned())
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const PAGE: &str = "# A paper\n\n## Item by item\n\n| item |\n|---|\n| 9.1 |\n\n- **9.1**, a cost\n  of much\n  - printed: 2\n  - \
                        wanted: a | b\n  - here: 3\n    and 4\n  - outcome: reached\n- **9.2**, a sum\n  - printed: 5\n  - here: 6\n  - \
                        outcome: impossible as printed: of a\n    digit\n";

    #[test]
    fn a_list_has_every_item_of_its_pages() {
        let list = "# Papers\n\n## Every item\n\nold";
        let list = with_every_item(list, [("seed_009", PAGE)]).expect("it has the part");
        let wanted = "# Papers\n\n## Every item\n\n| item | what | wanted | here | outcome |\n|---|---|---|---|---|\n\
                      | [9.1](seed_009.md) | a cost of much | a \\| b | 3 and 4 | reached |\n\
                      | [9.2](seed_009.md) | a sum | that it is found | 6 | impossible as printed: of a digit |\n";
        assert_eq!(list, wanted);
        assert_eq!(listed_otherwise(&list, "seed_009", PAGE), [""; 0]);
        let other = PAGE.replace("here: 6", "here: 7");
        let said = listed_otherwise(&list, "seed_009", &other);
        assert_eq!(said.len(), 2, "{said:?}");
        assert!(said[0].contains("| 7 |") && said[1].contains("| 6 |"));
        assert_eq!(with_every_item("# Papers", [("seed_009", PAGE)]), None);
    }
}
