//! The columns of a file to a log.

use super::header::Header;
use super::place::Place;
use super::rows::Table;
use super::sparse::fill;
use super::{Channel, Log, LogError, Note};

impl Log {
    /// A log of what was read, and of what was assumed in reading.
    pub(super) fn from_table(
        source: String,
        table: Table,
        header: &Header,
        mut report: Vec<Note>,
    ) -> Result<Self, LogError> {
        let mut columns = table.columns;
        let is_there = |place: &Place| {
            let values = &columns[place.column];
            table.is_number[place.column] && values.iter().any(|value| value.is_finite())
        };
        let (numbers, words): (Vec<_>, Vec<_>) =
            header.extra.iter().partition(|(_, place)| is_there(place));
        let sparse = numbers
            .iter()
            .filter(|(_, place)| fill(&mut columns[place.column]));
        let sparse: Vec<String> = sparse.map(|(name, _)| name.clone()).collect();
        let mut take = |place: &Place| {
            let mut values = std::mem::take(&mut columns[place.column]);
            for value in &mut values {
                *value *= place.unit;
            }
            values
        };
        let lost = table.lost.few(table.lines.len())?;
        if let Some((rows, first)) = lost {
            let first = first.to_string();
            report.push(Note::LostRows { rows, first });
        }
        if let Some(missing) = header.instead_of.clone() {
            report.push(Note::StandardColumns { missing });
        }
        if !words.is_empty() {
            let names = words.into_iter().map(|(name, _)| name.clone()).collect();
            report.push(Note::NoNumbers { names });
        }
        if !sparse.is_empty() {
            report.push(Note::Sparse { names: sparse });
        }
        let log = Self {
            time: take(&Place {
                unit: if table.is_clock {
                    1.0
                } else {
                    header.time.unit
                },
                ..header.time
            }),
            q: header.q.iter().map(&mut take).collect(),
            dq: header.dq.iter().map(&mut take).collect(),
            tau: header.tau.iter().map(&mut take).collect(),
            extra: numbers
                .into_iter()
                .map(|(name, place)| Channel {
                    name: name.clone(),
                    values: take(place),
                })
                .collect(),
            source,
            report,
            holes: Vec::new(),
            clipped: Vec::new(),
            turn_speeds: Vec::new(),
            tau_units: header.tau.iter().map(|place| place.unit).collect(),
        };
        log.finish(Some(&table.lines), &table.lost)
    }
}
