//! Comments of an effect's parameters: `/// Offset, N m (N for a prismatic joint).`

use robot_model_spec::model::JointKind;

/// What the other unit is followed by.
const FOR_A_PRISMATIC_JOINT: &str = " for a prismatic joint)";

/// Units of which others are products and ratios.
const UNITS: [&str; 17] = [
    "1", "A", "C", "Hz", "J", "K", "N", "V", "W", "deg", "kg", "m", "mm", "ms", "rad", "s", "Ohm",
];

/// Unit and meaning as a comment has them, for a joint. Where it does not end in a unit, all of it is the meaning.
pub(crate) fn unit_and_meaning(doc: &str, joint: Option<JointKind>) -> (String, String) {
    let doc = doc.split_whitespace().collect::<Vec<_>>().join(" ");
    let (first, rest) = match doc.split_once(". ") {
        Some((first, rest)) => (first, rest),
        None => (doc.trim_end_matches('.'), ""),
    };
    let (first, prismatic) = match first
        .strip_suffix(FOR_A_PRISMATIC_JOINT)
        .and_then(|text| text.rsplit_once(" ("))
    {
        Some((first, other)) => (first, Some(other)),
        None => (first, None),
    };
    let (what, unit) = match first.rsplit_once(", ") {
        Some((what, unit)) => (what, unit),
        None => ("", first),
    };
    if !is_unit(unit) {
        return (String::new(), doc);
    }
    let unit = match (joint, prismatic) {
        (Some(JointKind::Prismatic), Some(other)) => other,
        _ => unit,
    };
    let meaning = [what, rest].map(str::to_owned);
    let meaning = meaning.into_iter().filter(|text| !text.is_empty());
    (unit.to_owned(), meaning.collect::<Vec<_>>().join(". "))
}

/// Whether that is a unit: `N m s^2/rad^2`.
fn is_unit(text: &str) -> bool {
    let mut factors = text.split([' ', '/']);
    factors.all(|factor| {
        let (name, power) = factor.split_once('^').unwrap_or((factor, "1"));
        UNITS.contains(&name) && power.parse::<i8>().is_ok()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_comment_says_unit_and_meaning() {
        let told = |doc: &str, joint| {
            let (unit, meaning) = unit_and_meaning(doc, joint);
            format!("{unit} | {meaning}")
        };
        let (turns, slides) = (Some(JointKind::Revolute), Some(JointKind::Prismatic));
        let friction = "Viscous coefficient,\nN m s/rad (N s/m for a prismatic joint).";
        assert_eq!(told(friction, turns), "N m s/rad | Viscous coefficient");
        assert_eq!(told(friction, slides), "N s/m | Viscous coefficient");
        let stiffness = "N m/rad (N/m for a prismatic joint).";
        assert_eq!(told(stiffness, turns), "N m/rad | ");
        assert_eq!(
            told("Relative fall per degree, 1/K.", None),
            "1/K | Relative fall per degree"
        );
        assert_eq!(
            told("Gain of my tool, N m/A. Measured in May.", turns),
            "N m/A | Gain of my tool. Measured in May."
        );
        for without in [
            "Friction per unit of load.",
            "Seconds; negative where the torque comes early.",
            "When it begins, s since the start of the log.",
            "",
        ] {
            assert_eq!(told(without, turns), format!(" | {without}"));
        }
    }
}
