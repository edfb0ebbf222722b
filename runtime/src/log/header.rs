//! Header names to channels.
//!
//! A name outside the families `time`, `q`, `dq`, `tau` is an extra channel. A name that is nearly of a family is an error:
//! a misspelled torque that is silently set aside costs an afternoon. Beside the channel itself it is an extra one.

use std::collections::BTreeSet;

use super::meant::{FAMILIES, Kind, Meant, classify};
use super::note::Note;
use super::place::Place;
use super::rows::Rows;
use super::units::Channels;
use super::{Column, Columns, LogError, limits, mapping};

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
    /// The arm's own columns, where the file has the standard ones in place of them.
    pub instead_of: Option<Vec<String>>,
    /// What was assumed of the columns.
    pub notes: Vec<Note>,
}

/// Where the names stand, as messages have it.
#[derive(Clone, Copy)]
struct HeaderPlace<'a> {
    source: &'a str,
    line: u64,
}

impl Header {
    /// Finds the channels of a file that may say units below its names.
    pub(super) fn of(source: &str, rows: &dyn Rows, columns: &Columns) -> Result<Self, LogError> {
        let names = rows.names();
        let place = HeaderPlace {
            source,
            line: rows.header_line(),
        };
        let mut header = Self::resolve(place, names, &rows.columns(columns))?;
        if let Some(units) = rows.units() {
            let mut channels = Channels {
                time: &mut header.time,
                q: &mut header.q,
                dq: &mut header.dq,
                tau: &mut header.tau,
                signals: &columns.signals,
            };
            let note = units.apply(source, names, &mut channels)?;
            header.notes.extend(note);
        }
        Ok(header)
    }

    /// Finds the channels. A log that has none of the arm's own names, and all standard ones, comes from a simulation or was
    /// rewritten already.
    fn resolve(
        place: HeaderPlace<'_>,
        names: &[String],
        columns: &Columns,
    ) -> Result<Self, LogError> {
        check_names(place, names)?;
        check_columns(place.source, columns)?;
        let own = columns.marks();
        let is_foreign = own.iter().all(|own| !names.iter().any(|name| name == own));
        if !own.is_empty() && is_foreign {
            let standard = Columns::standard(columns.dof());
            if let Ok(header) = Self::find(place, names, &standard) {
                return Ok(Self {
                    instead_of: Some(own.into_iter().map(str::to_owned).collect()),
                    ..header
                });
            }
        }
        Self::find(place, names, columns)
    }

    fn find(at: HeaderPlace<'_>, names: &[String], columns: &Columns) -> Result<Self, LogError> {
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
        extra.extend(others(at, names, columns)?);
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
                instead_of: None,
                notes: Vec::new(),
            })
        } else {
            Err(LogError::MissingColumns {
                source_name: at.source.to_owned(),
                line: at.line,
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
fn check_names(place: HeaderPlace<'_>, names: &[String]) -> Result<(), LogError> {
    let HeaderPlace { source, line } = place;
    limits::check_columns(source, line, names.len())?;
    let mut known = BTreeSet::new();
    for (column, name) in names.iter().enumerate() {
        if name.is_empty() {
            return Err(LogError::UnnamedColumn {
                source_name: source.to_owned(),
                line,
                column: column + 1,
            });
        }
        if !known.insert(name) {
            return Err(LogError::DuplicateColumn {
                source_name: source.to_owned(),
                line,
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
    place: HeaderPlace<'_>,
    names: &[String],
    columns: &Columns,
) -> Result<Vec<(String, Place)>, LogError> {
    let HeaderPlace { source, line } = place;
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
            // Beside the channel itself it is another one, such as the same in degrees.
            Kind::NearMiss(meant) if names.contains(&meant) => {
                others.push((name.clone(), Place::plain(column)));
            }
            Kind::NoSuchJoint => {
                return Err(LogError::NoSuchJoint {
                    source_name: source_name(),
                    line,
                    name: name.clone(),
                    dof: columns.dof(),
                    lines: lines(),
                });
            }
            Kind::NearMiss(suggestion) => {
                return Err(LogError::Misspelled {
                    source_name: source_name(),
                    line,
                    name: name.clone(),
                    suggestion,
                    lines: lines(),
                });
            }
        }
    }
    Ok(others)
}
