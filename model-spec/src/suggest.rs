//! "Did you mean": the nearest of the names that would have been right.

/// The known name nearest to `wrong`, if it is near enough to be what was meant.
#[must_use]
pub fn nearest<'a>(wrong: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let reach = match wrong.chars().count() {
        0 | 1 => 0,
        letters => (letters / 3).max(1),
    };
    known
        .into_iter()
        .map(|name| {
            (
                strsim::damerau_levenshtein(&wrong.to_lowercase(), &name.to_lowercase()),
                name,
            )
        })
        .filter(|(distance, name)| *distance <= reach || is_abbreviation(wrong, name))
        .min_by_key(|(distance, name)| (*distance, !is_subsequence(wrong, name)))
        .map(|(_, name)| name)
}

/// Letters left out, as in `sgn` for `sign`: likelier than a letter exchanged, as in `sgn` for `sin`.
fn is_subsequence(short: &str, long: &str) -> bool {
    let mut letters = long.chars();
    short
        .chars()
        .all(|wanted| letters.any(|letter| letter == wanted))
}

/// `viscous` for `viscous_friction`, `degrees` for `deg`.
fn is_abbreviation(wrong: &str, name: &str) -> bool {
    let (short, long) = if wrong.len() < name.len() {
        (wrong, name)
    } else {
        (name, wrong)
    };
    short.len() >= 3 && long.starts_with(short)
}

/// `write X` where a near name exists, else a list of what there is, which may be nothing.
pub(crate) fn help<'a>(wrong: &str, known: impl IntoIterator<Item = &'a str> + Clone) -> String {
    match nearest(wrong, known.clone()) {
        Some(name) => format!("write `{name}`"),
        None if known.clone().into_iter().next().is_none() => "declare one first".to_owned(),
        None if known.clone().into_iter().count() == 1 => format!("write {}", list(known)),
        None => format!("write one of {}", list(known)),
    }
}

/// "`a`, `b`, `c`"
pub(crate) fn list<'a>(names: impl IntoIterator<Item = &'a str>) -> String {
    names
        .into_iter()
        .map(|name| format!("`{name}`"))
        .collect::<Vec<_>>()
        .join(", ")
}

#[cfg(test)]
mod tests {
    use super::nearest;

    #[test]
    fn a_slip_is_recognized_and_another_word_is_not() {
        let known = ["waist", "shoulder", "elbow"];
        assert_eq!(nearest("elbwo", known), Some("elbow"));
        assert_eq!(nearest("Waist", known), Some("waist"));
        assert_eq!(nearest("gripper", known), None);
        assert_eq!(nearest("sgn", ["sin", "sign"]), Some("sign"));
        assert_eq!(
            nearest("viscous", ["viscous_friction"]),
            Some("viscous_friction")
        );
    }
}
