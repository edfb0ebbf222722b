//! Which channel a name is, or is nearly that of.

use super::units;

/// Families of one channel a joint.
pub(super) const FAMILIES: [&str; 3] = ["q", "dq", "tau"];

/// What a name may be.
#[derive(Debug, PartialEq)]
pub(super) enum Kind {
    Known,
    Extra,
    NoSuchJoint,
    /// With the name that may be meant.
    NearMiss(String),
}

/// `families`, and `time` where it is true, have their standard names.
pub(super) fn classify(name: &str, dof: usize, families: &[&str], time: bool) -> Kind {
    if time && name == "time" {
        return Kind::Known;
    }
    let (stem, digits) = split(name);
    if families.contains(&stem) && !digits.is_empty() {
        return match digits.parse::<usize>() {
            Ok(joint) if (1..=dof).contains(&joint) && !digits.starts_with('0') => Kind::Known,
            _ => Kind::NoSuchJoint,
        };
    }
    match Meant::of(name) {
        Some(Meant::Time) if time => Kind::NearMiss("time".to_owned()),
        Some(Meant::Joint(family, joint)) if families.contains(&family) => {
            if (1..=dof).contains(&joint) {
                Kind::NearMiss(format!("{family}{joint}"))
            } else {
                Kind::NoSuchJoint
            }
        }
        _ => Kind::Extra,
    }
}

/// The channel that a name is nearly that of.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Meant {
    Time,
    /// A family, and the number of a joint.
    Joint(&'static str, usize),
}

impl Meant {
    /// `Q1`, `q_1`, `q[1]` and `q1 [deg]` are spellings of `q1`.
    pub fn of(name: &str) -> Option<Self> {
        let (name, _) = units::split(name);
        let plain: String = name
            .chars()
            .filter(char::is_ascii_alphanumeric)
            .collect::<String>()
            .to_ascii_lowercase();
        let (stem, digits) = split(&plain);
        // Measured accelerations are a channel of their own right.
        if digits.is_empty() {
            return nearly(stem, "time").then_some(Self::Time);
        }
        if name == format!("ddq{digits}") {
            return None;
        }
        let family = FAMILIES.into_iter().find(|family| nearly(stem, family))?;
        Some(Self::Joint(family, digits.parse().ok()?))
    }
}

/// Letters in front and digits at the end.
fn split(name: &str) -> (&str, &str) {
    let stem = name.trim_end_matches(|c: char| c.is_ascii_digit());
    (stem, &name[stem.len()..])
}

/// Equal, or one slip away: a letter typed twice, two letters swapped, and in the longer names one letter wrong or left out.
/// One letter more is no slip: `qm1` and `taum1` are channels of the motor side.
fn nearly(stem: &str, family: &str) -> bool {
    let (stem, family) = (stem.as_bytes(), family.as_bytes());
    let without = |bytes: &[u8], k: usize| [&bytes[..k], &bytes[k + 1..]].concat();
    let typed_twice = (1..stem.len()).any(|k| stem[k] == stem[k - 1] && without(stem, k) == family);
    let swapped = (1..stem.len()).any(|k| {
        let mut other = stem.to_vec();
        other.swap(k - 1, k);
        other == family
    });
    let long = family.len() > 2;
    let wrong =
        stem.len() == family.len() && stem.iter().zip(family).filter(|(a, b)| a != b).count() == 1;
    let left_out = (0..family.len()).any(|k| without(family, k) == stem);
    stem == family || typed_twice || swapped || (long && (wrong || left_out))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_other_families_are_extra_channels() {
        for name in [
            "temperature",
            "qref1",
            "vir1",
            "pulse1",
            "qm1",
            "taum1",
            "ddq1",
            "current2",
            "t",
            "torque1",
            "x",
            "q1 (ref)",
            "tau1 (filtered)",
            "dq1 [est]",
            "q7 (lift)",
            "time (host)",
        ] {
            assert_eq!(classify(name, 2, &FAMILIES, true), Kind::Extra, "{name}");
        }
    }

    #[test]
    fn slips_are_told() {
        for (name, meant) in [
            ("qq1", "q1"),
            ("Q1", "q1"),
            ("q_2", "q2"),
            ("qd1", "dq1"),
            ("tua1", "tau1"),
            ("ta2", "tau2"),
            ("tao2", "tau2"),
            ("Tau1", "tau1"),
            ("tim", "time"),
            ("Time", "time"),
            ("time [s]", "time"),
            ("q1 [deg]", "q1"),
            ("q[2]", "q2"),
            ("q[2] (deg)", "q2"),
            ("tau_1 (Nm)", "tau1"),
        ] {
            assert_eq!(
                classify(name, 2, &FAMILIES, true),
                Kind::NearMiss(meant.to_owned()),
                "{name}"
            );
        }
    }

    #[test]
    fn joints_count_from_one() {
        for name in ["q0", "q3", "dq7", "tau01", "q99999999999999999999999"] {
            assert_eq!(
                classify(name, 2, &FAMILIES, true),
                Kind::NoSuchJoint,
                "{name}"
            );
        }
    }
}
