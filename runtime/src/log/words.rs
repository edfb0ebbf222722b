//! Parts of sentences on logs.

/// Names in backticks with commas; a long list keeps its first eight.
pub(super) fn list(names: &[String]) -> String {
    const SHOWN: usize = 8;
    let mut text: Vec<String> = names
        .iter()
        .take(SHOWN)
        .map(|name| format!("`{name}`"))
        .collect();
    if names.len() > SHOWN {
        text.push(format!("and {} more", names.len() - SHOWN));
    }
    text.join(", ")
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
        format!(" in {unit} it would be one of an arm: `time = \"..\": {unit};` in the `log` of the spec says so")
    })
}
