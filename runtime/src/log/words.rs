//! Parts of sentences on logs.

/// Names in backticks with commas; a long list keeps its first eight.
pub(super) fn list(names: &[String]) -> String {
    first(names, 8)
}

/// The same of columns of a file, of which one is to be chosen: a long list keeps its first thirty.
pub(super) fn columns(names: &[String]) -> String {
    first(names, 30)
}

fn first(names: &[String], most: usize) -> String {
    let shown = names.iter().take(most);
    let mut text: Vec<String> = shown.map(|name| format!("`{}`", field(name))).collect();
    if names.len() > most {
        text.push(format!("and {} more", names.len() - most));
    }
    text.join(", ")
}

/// A field of a file as a message has it: the beginning of a long one, and nothing that a terminal obeys.
pub(super) fn field(text: &str) -> String {
    const SHOWN: usize = 60;
    let mut shown = String::new();
    for (k, c) in text.chars().enumerate() {
        if k == SHOWN {
            shown.push_str("..");
            break;
        }
        if c.is_control() {
            shown.extend(c.escape_default());
        } else {
            shown.push(c);
        }
    }
    shown
}

/// What is said of a row with more or fewer fields than the header; one that is cut is the last.
pub(super) fn fields(found: usize, expected: usize, is_cut: bool) -> String {
    let (last, way_out) = if is_cut {
        ("last ", "the file may be cut short: remove the row")
    } else {
        ("", "give every row one field per column, or remove the row")
    };
    format!(
        "the {last}row has {found} field{}, the header has {expected}; {way_out}",
        plural(found)
    )
}

/// What to do with a field that is no number.
pub(super) fn way_out(text: &str) -> &'static str {
    match text.replace(',', ".").parse::<f64>() {
        Ok(_) => "write decimals with a point",
        Err(_) => "repair or remove the row",
    }
}

pub(super) fn plural(count: usize) -> &'static str {
    if count == 1 { "" } else { "s" }
}

pub(super) fn joints(dof: usize) -> String {
    if dof == 1 {
        "number 1".to_owned()
    } else {
        format!("numbers 1 to {dof}")
    }
}

/// A rate, however small.
pub(super) fn hertz(rate: f64) -> String {
    if (1e-3..1e6).contains(&rate) {
        format!("{rate:.4}")
    } else {
        format!("{rate:.1e}")
    }
}

/// What may be done about a time in another unit.
pub(super) fn in_unit(unit: Option<&str>) -> String {
    unit.map_or(String::new(), |unit| {
        format!(" in {unit} it would be plausible: write `time = \"..\": {unit};` in the `log` of the spec")
    })
}

#[cfg(test)]
mod tests {
    use super::field;

    #[test]
    fn fields_are_short_and_no_orders_to_a_terminal() {
        assert_eq!(field("three"), "three");
        assert_eq!(field("\u{1b}[31mred\0"), "\\u{1b}[31mred\\u{0}");
        let long = field(&"x".repeat(300_000));
        assert!(long.len() == 62 && long.ends_with("x.."), "{long}");
    }
}
