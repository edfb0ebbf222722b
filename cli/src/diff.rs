//! What an edit changed, line by line.

use std::fmt::Write;

/// Lines shown around a change.
const CONTEXT: usize = 2;

/// The changed lines between two texts with a little around them; empty where nothing changed. Everything between the first
/// and the last difference counts as changed: an edit is in one place.
pub(crate) fn diff(before: &str, after: &str) -> String {
    let (old, new): (Vec<&str>, Vec<&str>) = (before.lines().collect(), after.lines().collect());
    let shortest = old.len().min(new.len());
    let head = (0..shortest).take_while(|&k| old[k] == new[k]).count();
    let tail = (0..shortest - head)
        .take_while(|&k| old[old.len() - 1 - k] == new[new.len() - 1 - k])
        .count();
    let (old_end, new_end) = (old.len() - tail, new.len() - tail);
    if head == old_end && head == new_end {
        return String::new();
    }
    let mut text = String::new();
    let mut show = |mark: char, number: usize, line: &str| {
        writeln!(text, "{}", format!("{number:4} {mark} {line}").trim_end())
            .expect("a string takes all");
    };
    (head.saturating_sub(CONTEXT)..head).for_each(|k| show(' ', k + 1, new[k]));
    (head..old_end).for_each(|k| show('-', k + 1, old[k]));
    (head..new_end).for_each(|k| show('+', k + 1, new[k]));
    (new_end..new.len().min(new_end + CONTEXT)).for_each(|k| show(' ', k + 1, new[k]));
    text
}

#[cfg(test)]
mod tests {
    use super::diff;

    #[test]
    fn an_insertion_is_shown_with_its_surroundings() {
        let after = "a\nb\nc\nnew\nd\ne\nf\n";
        assert_eq!(
            diff("a\nb\nc\nd\ne\nf\n", after),
            "   2   b\n   3   c\n   4 + new\n   5   d\n   6   e\n"
        );
        assert_eq!(diff(after, after), "");
    }

    #[test]
    fn a_repeated_line_is_one_insertion() {
        assert_eq!(
            diff("a\na\n", "a\na\na\n"),
            "   1   a\n   2   a\n   3 + a\n"
        );
    }

    #[test]
    fn a_changed_line_is_shown_twice() {
        assert_eq!(
            diff("effects {}", "effects { x; }"),
            "   1 - effects {}\n   1 + effects { x; }\n"
        );
    }
}
