//! Header names to channels.
//!
//! A name outside the families `time`, `q`, `dq`, `tau` is an extra channel. A name that is nearly of a family is an error:
//! a misspelled torque that is silently set aside costs an afternoon.

use std::collections::BTreeSet;

use super::note::Note;
use super::place::Place;
use super::rows::Rows;
use super::units::Channels;
use super::{Column, Columns, LogError, limits, mapping};

/// Families of one channel a joint.
pub(super) const FAMILIES: [&str; 3] = ["q", "dq", "tau"];

/// Places of each channel.
#[derive(Debug, PartialEq)]
pub(super) struct Header {
    pub time: Place,
    pub q: Vec<Place>,
    /// Empty where the log has no velocities.
    pub dq: Vec<Place>,
    pub tau: Vec<Place>,
    /// Neither of the above, with their names; those that the arm has names for come first.
    pub extra: Vec<(String, Place)>,
    /// So many of them the arm has names for.
    declared: usize,
    /// The file has the standard columns in place of the arm's own.
    pub is_standard_instead: bool,
    /// What was assumed of the columns.
    pub notes: Vec<Note>,
}

impl Header {
    /// Finds the channels of a file that may say units below its names.
    pub(super) fn of(source: &str, rows: &dyn Rows, columns: &Columns) -> Result<Self, LogError> {
        let names = rows.names();
        let mut header = Self::resolve(source, names, &rows.columns(columns))?;
        if let Some(units) = rows.units() {
            let mut channels = Channels {
                time: &mut header.time,
                q: &mut header.q,
                dq: &mut header.dq,
                tau: &mut header.tau,
                signals: &columns.signals,
            };
            let note = units.apply(source, names, &mut channels)?;
            header.notes.push(note);
        }
        Ok(header)
    }

    /// Finds the channels. A log that has none of the arm's own names, and all standard ones, comes from a simulation or was
    /// rewritten already.
    pub(super) fn resolve(
        source: &str,
        names: &[String],
        columns: &Columns,
    ) -> Result<Self, LogError> {
        check_names(source, names)?;
        check_columns(source, columns)?;
        let own = columns.marks();
        let is_foreign = own.iter().all(|own| !names.iter().any(|name| name == own));
        if !own.is_empty() && is_foreign {
            let standard = Columns::standard(columns.dof());
            if let Ok(header) = Self::find(source, names, &standard) {
                return Ok(Self {
                    is_standard_instead: true,
                    ..header
                });
            }
        }
        Self::find(source, names, columns)
    }

    fn find(source: &str, names: &[String], columns: &Columns) -> Result<Self, LogError> {
        let mut missing = Vec::new();
        let place = |column: &Column| {
            let place = names.iter().position(|name| *name == column.name)?;
            Some(Place {
                column: place,
                unit: column.worth(),
                is_said: column.unit.is_some(),
            })
        };
        let mut find = |column: &Column| {
            place(column).unwrap_or_else(|| {
                missing.push(column.name.clone());
                Place::plain(0)
            })
        };
        let time = find(&columns.time);
        let q = columns.q.iter().map(&mut find).collect();
        // Velocities are optional, but not for some of the joints that are there only.
        let has_dq = columns.dq.iter().any(|own| place(own).is_some());
        let is_there = |joint: usize| {
            let own = columns
                .q
                .get(joint)
                .into_iter()
                .chain(columns.tau.get(joint));
            own.filter_map(place).count() > 0
        };
        let dq = if has_dq { columns.dq.as_slice() } else { &[] };
        let dq = dq.iter().enumerate();
        let dq = dq.filter(|(joint, own)| is_there(*joint) || place(own).is_some());
        let dq = dq.map(|(_, own)| find(own)).collect();
        let tau = columns.tau.iter().map(&mut find).collect();
        let of_arm = columns.extra.iter();
        let of_arm = of_arm.filter_map(|(name, own)| Some((name.clone(), place(own)?)));
        let mut extra: Vec<(String, Place)> = of_arm.collect();
        let declared = extra.len();
        extra.extend(others(source, names, columns)?);
        // A column of the input's name would be read in place of the one that is meant.
        for (name, own) in &columns.extra {
            let is_elsewhere = extra[declared..].iter().any(|(other, _)| other == name);
            if is_elsewhere {
                missing.push(own.name.clone());
            }
        }
        if missing.is_empty() {
            Ok(Self {
                time,
                q,
                dq,
                tau,
                extra,
                declared,
                is_standard_instead: false,
                notes: Vec::new(),
            })
        } else {
            Err(LogError::MissingColumns {
                source_name: source.to_owned(),
                missing,
                present: names.to_vec(),
            })
        }
    }

    /// Columns that have to hold numbers.
    pub(super) fn needed(&self) -> Vec<usize> {
        let of_arm = self.q.iter().chain(&self.dq).chain(&self.tau);
        let inputs = self.extra[..self.declared].iter().map(|(_, place)| place);
        let all = std::iter::once(&self.time).chain(of_arm).chain(inputs);
        all.map(|place| place.column).collect()
    }
}

/// Every column has a name of its own.
fn check_names(source: &str, names: &[String]) -> Result<(), LogError> {
    limits::check_columns(source, names.len())?;
    let mut known = BTreeSet::new();
    for (column, name) in names.iter().enumerate() {
        if name.is_empty() {
            return Err(LogError::UnnamedColumn {
                source_name: source.to_owned(),
                line: 1,
                column: column + 1,
            });
        }
        if !known.insert(name) {
            return Err(LogError::DuplicateColumn {
                source_name: source.to_owned(),
                name: name.clone(),
            });
        }
    }
    Ok(())
}

/// Every joint has its columns, and every column is one channel.
fn check_columns(source: &str, columns: &Columns) -> Result<(), LogError> {
    let dof = columns.dof();
    let is_whole = columns.tau.len() == dof && [0, dof].contains(&columns.dq.len());
    if !is_whole {
        return Err(LogError::Lengths {
            source_name: source.to_owned(),
        });
    }
    let all: Vec<&Column> = columns.all().collect();
    for (k, column) in all.iter().enumerate() {
        if all[..k].iter().any(|other| other.name == column.name) {
            return Err(LogError::TwoChannels {
                source_name: source.to_owned(),
                name: column.name.clone(),
            });
        }
    }
    Ok(())
}

/// Columns that are no channel of the arm; names that are nearly those of one are refused.
fn others(
    source: &str,
    names: &[String],
    columns: &Columns,
) -> Result<Vec<(String, Place)>, LogError> {
    let source_name = || source.to_owned();
    let own = columns.own_names();
    let has_own = |family: &[Column]| family.iter().any(|c| own.contains(&c.name.as_str()));
    let families = [&columns.q, &columns.dq, &columns.tau];
    let standard = FAMILIES.into_iter().zip(families);
    let standard = standard.filter(|(_, columns)| !has_own(columns));
    let standard: Vec<&str> = standard.map(|(family, _)| family).collect();
    let time = !own.contains(&columns.time.name.as_str());
    let lines = || {
        let meant = names
            .iter()
            .filter_map(|name| Some((name.clone(), Meant::of(name)?)));
        mapping::lines(&meant.collect::<Vec<_>>(), columns.dof())
    };
    let mut others = Vec::new();
    for (column, name) in names.iter().enumerate() {
        if columns.all().any(|known| known.name == *name) {
            continue;
        }
        match classify(name, columns.dof(), &standard, time) {
            Kind::Known | Kind::Extra => others.push((name.clone(), Place::plain(column))),
            Kind::NoSuchJoint => {
                return Err(LogError::NoSuchJoint {
                    source_name: source_name(),
                    name: name.clone(),
                    dof: columns.dof(),
                    lines: lines(),
                });
            }
            Kind::NearMiss(suggestion) => {
                return Err(LogError::Misspelled {
                    source_name: source_name(),
                    name: name.clone(),
                    suggestion,
                    lines: lines(),
                });
            }
        }
    }
    Ok(others)
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

/// `families`, and `time` where it is true, have their standard names.
fn classify(name: &str, dof: usize, families: &[&str], time: bool) -> Kind {
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
    /// `Q1`, `q_1` and `q[1]` are spellings of `q1`.
    fn of(name: &str) -> Option<Self> {
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
