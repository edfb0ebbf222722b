//! Header names to channels.
//!
//! A name outside the families `time`, `q`, `dq`, `tau` is an extra channel. A name that is nearly of a family is an error:
//! a misspelled torque that is silently set aside costs an afternoon.

use super::LogError;

/// Families of one channel a joint.
const FAMILIES: [&str; 3] = ["q", "dq", "tau"];

/// Column indices of each channel.
#[derive(Debug, PartialEq)]
pub(super) struct Header {
    pub time: usize,
    pub q: Vec<usize>,
    /// Empty where the log has no velocities.
    pub dq: Vec<usize>,
    pub tau: Vec<usize>,
    /// Neither of the above.
    pub extra: Vec<usize>,
}

impl Header {
    /// Finds the channels of an arm with `dof` joints.
    pub(super) fn resolve(source: &str, names: &[String], dof: usize) -> Result<Self, LogError> {
        let source_name = || source.to_owned();
        let mut extra = Vec::new();
        for (column, name) in names.iter().enumerate() {
            if name.is_empty() {
                return Err(LogError::UnnamedColumn {
                    source_name: source_name(),
                    column: column + 1,
                });
            }
            if names[..column].contains(name) {
                return Err(LogError::DuplicateColumn {
                    source_name: source_name(),
                    name: name.clone(),
                });
            }
            match classify(name, dof) {
                Kind::Known => {}
                Kind::Extra => extra.push(column),
                Kind::NoSuchJoint => {
                    return Err(LogError::NoSuchJoint {
                        source_name: source_name(),
                        name: name.clone(),
                        dof,
                    });
                }
                Kind::NearMiss(suggestion) => {
                    return Err(LogError::Misspelled {
                        source_name: source_name(),
                        name: name.clone(),
                        suggestion,
                    });
                }
            }
        }
        let mut missing = Vec::new();
        let mut find = |name: String| {
            let place = names.iter().position(|other| *other == name);
            place.unwrap_or_else(|| {
                missing.push(name);
                0
            })
        };
        let time = find("time".to_owned());
        let mut family = |family: &str| {
            (1..=dof)
                .map(|joint| find(format!("{family}{joint}")))
                .collect::<Vec<_>>()
        };
        let q = family("q");
        // Velocities are optional, but not for some joints only.
        let has_dq = (1..=dof).any(|joint| names.contains(&format!("dq{joint}")));
        let dq = if has_dq { family("dq") } else { Vec::new() };
        let tau = family("tau");
        if missing.is_empty() {
            Ok(Self {
                time,
                q,
                dq,
                tau,
                extra,
            })
        } else {
            Err(LogError::MissingColumns {
                source_name: source_name(),
                missing,
                present: names.to_vec(),
            })
        }
    }
}

/// What a name may be.
#[derive(Debug, PartialEq)]
enum Kind {
    Known,
    Extra,
    NoSuchJoint,
    /// With the name that may be meant.
    NearMiss(String),
}

fn classify(name: &str, dof: usize) -> Kind {
    if name == "time" {
        return Kind::Known;
    }
    let (stem, digits) = split(name);
    if FAMILIES.contains(&stem) && !digits.is_empty() {
        return match digits.parse::<usize>() {
            Ok(joint) if (1..=dof).contains(&joint) && !digits.starts_with('0') => Kind::Known,
            _ => Kind::NoSuchJoint,
        };
    }
    // `Q1`, `q_1` and `q[1]` are spellings of `q1`.
    let plain: String = name
        .chars()
        .filter(char::is_ascii_alphanumeric)
        .collect::<String>()
        .to_ascii_lowercase();
    let (stem, digits) = split(&plain);
    let meant = if digits.is_empty() {
        ["time"].into_iter().find(|family| nearly(stem, family))
    } else {
        FAMILIES.into_iter().find(|family| nearly(stem, family))
    };
    // Measured accelerations are a channel of their own right.
    match meant {
        Some(family) if name != format!("ddq{digits}") => {
            Kind::NearMiss(format!("{family}{digits}"))
        }
        _ => Kind::Extra,
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
        ] {
            assert_eq!(classify(name, 2), Kind::Extra, "{name}");
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
        ] {
            assert_eq!(
                classify(name, 2),
                Kind::NearMiss(meant.to_owned()),
                "{name}"
            );
        }
    }

    #[test]
    fn joints_count_from_one() {
        for name in ["q0", "q3", "dq7", "tau01", "q99999999999999999999999"] {
            assert_eq!(classify(name, 2), Kind::NoSuchJoint, "{name}");
        }
    }
}
