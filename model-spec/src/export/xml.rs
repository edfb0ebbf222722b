//! Pieces of XML: numbers, comments, inertials of a URDF.

use super::Body;

/// The shortest text that is read back as the same number; powers of ten where they are shorter.
pub(crate) fn number(x: f64) -> String {
    let plain = format!("{}", x + 0.0);
    let scientific = format!("{x:e}");
    if plain.len() > scientific.len() + 3 {
        scientific
    } else {
        plain
    }
}

pub(super) fn numbers(list: &[f64]) -> String {
    let list: Vec<String> = list.iter().map(|x| number(*x)).collect();
    list.join(" ")
}

/// Text inside `<!-- -->`, which may hold no two hyphens side by side.
pub(crate) fn comment(text: &str) -> String {
    let mut plain = String::new();
    for letter in text.chars() {
        let letter = if letter.is_control() { ' ' } else { letter };
        if letter == '-' && plain.ends_with('-') {
            plain.push(' ');
        }
        plain.push(letter);
    }
    if plain.ends_with('-') {
        plain.push(' ');
    }
    plain
}

/// A comment of its own line; nothing where there is nothing to say.
pub(crate) fn remark_lines(remark: &str) -> Vec<String> {
    if remark.is_empty() {
        return Vec::new();
    }
    vec![format!("<!-- {} -->", comment(remark))]
}

/// `<inertial>` of a URDF, line by line.
pub(crate) fn inertial_lines(body: &Body, remark: &str) -> Vec<String> {
    let i = body.inertia;
    let named = [
        ("ixx", i[0][0]),
        ("ixy", i[0][1]),
        ("ixz", i[0][2]),
        ("iyy", i[1][1]),
        ("iyz", i[1][2]),
        ("izz", i[2][2]),
    ];
    let entries = named.map(|(name, value)| format!("{name}=\"{}\"", number(value)));
    let mut lines = vec!["<inertial>".to_owned()];
    lines.extend(remark_lines(remark).iter().map(|line| format!("  {line}")));
    lines.push(format!(
        "  <origin xyz=\"{}\" rpy=\"0 0 0\"/>",
        numbers(&body.com)
    ));
    lines.push(format!("  <mass value=\"{}\"/>", number(body.mass)));
    lines.push(format!("  <inertia {}/>", entries.join(" ")));
    lines.push("</inertial>".to_owned());
    lines
}

/// A name that is none of those that are taken.
pub(super) fn free_name(name: &str, taken: &[&str]) -> String {
    let mut free = name.to_owned();
    while taken.contains(&free.as_str()) {
        free.push('_');
    }
    free
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_hold_no_two_hyphens() {
        assert_eq!(comment("a --urdf b---"), "a - -urdf b- - - ");
        assert_eq!(comment("plain"), "plain");
    }

    #[test]
    fn numbers_are_read_back() {
        for x in [0.1, -1.0 / 3.0, 1e-17, 6.02e23, -0.0, 123_456.789] {
            let read: f64 = number(x).parse().expect("a number");
            assert!(read.to_bits() == (x + 0.0).to_bits(), "{x}");
        }
        assert_eq!(number(1e-17), "1e-17");
    }
}
