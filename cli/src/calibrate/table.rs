//! Columns of any CSV table with a header.

use std::path::{Path, PathBuf};

use robot_model::calibrate::CalibrateError;
use robot_model_spec::ColumnKind;

use crate::Error;
use crate::log_settings::LogSettings;
use crate::output::names;
use crate::spec::read_text;

/// The option that names a column, that name, and what is in it.
pub(super) type Wanted<'a> = (&'a str, &'a str, ColumnKind);

/// The columns that were asked for; others may hold anything.
#[derive(Debug)]
pub(super) struct Table {
    path: PathBuf,
    /// As they were asked for.
    pub columns: Vec<Vec<f64>>,
    /// Line of each row.
    lines: Vec<u64>,
}

impl Table {
    /// Reads columns in SI units, each by the option that names it.
    pub fn read(path: &Path, wanted: &[Wanted], settings: &LogSettings) -> Result<Self, Error> {
        for (k, (option, name, _)) in wanted.iter().enumerate() {
            if let Some((other, ..)) = wanted[..k].iter().find(|(_, other, _)| other == name) {
                return Err(Error::Argument(format!(
                    "{other} and {option} name the same column `{name}`; give each its own"
                )));
            }
        }
        let text = read_text(path)?;
        let mut reader = csv::ReaderBuilder::new()
            .trim(csv::Trim::All)
            .from_reader(text.trim_start_matches('\u{feff}').as_bytes());
        let header = reader.headers().map_err(|error| unreadable(path, &error))?;
        let header: Vec<String> = header.iter().map(str::to_owned).collect();
        let places = places(path, &header, wanted)?;
        let units = wanted.iter();
        let units = units.map(|(_, name, kind)| settings.unit(path, name, *kind));
        let units = units.collect::<Result<Vec<f64>, Error>>()?;
        let mut table = Self {
            path: path.to_owned(),
            columns: vec![Vec::new(); wanted.len()],
            lines: Vec::new(),
        };
        for record in reader.records() {
            let record = record.map_err(|error| unreadable(path, &error))?;
            let line = record.position().map_or(0, csv::Position::line);
            for ((place, unit), column) in places.iter().zip(&units).zip(&mut table.columns) {
                let field = record.get(*place).unwrap_or_default();
                match field.parse::<f64>() {
                    Ok(value) if value.is_finite() => column.push(unit * value),
                    _ => {
                        let name = &header[*place];
                        return Err(refused(
                            &place_of(path, line),
                            &format!(
                                "`{field}` in column `{name}` is no finite number; repair or remove the row"
                            ),
                        ));
                    }
                }
            }
            table.lines.push(line);
        }
        Ok(table)
    }

    /// What a calibration refuses, with the line of the row that is at fault.
    pub fn refused(&self, error: &CalibrateError) -> Error {
        let line = error.sample().and_then(|sample| self.lines.get(sample));
        let place = match line {
            Some(line) => place_of(&self.path, *line),
            None => self.path.display().to_string(),
        };
        refused(&place, &error.to_string())
    }
}

/// Where the columns stand.
fn places(path: &Path, header: &[String], wanted: &[Wanted]) -> Result<Vec<usize>, Error> {
    let place = path.display().to_string();
    if header.iter().all(String::is_empty) {
        return Err(refused(
            &place,
            "the table is empty; write a header and rows",
        ));
    }
    if header.len() == 1 && header[0].contains([';', '\t', '|']) {
        return Err(refused(
            &place_of(path, 1),
            "the columns are not separated by commas; separate columns with commas, and write decimals with a point",
        ));
    }
    if header.iter().all(|name| name.parse::<f64>().is_ok()) {
        return Err(refused(
            &place_of(path, 1),
            "the table has no header; write the names of its columns as the first line",
        ));
    }
    let there: Vec<&str> = header.iter().map(String::as_str).collect();
    let found = wanted.iter().map(|(option, name, _)| {
        let mut places = (0..header.len()).filter(|k| header[*k] == *name);
        let found = places.next().ok_or_else(|| {
            refused(
                &place,
                &format!(
                    "there is no column `{name}` for {option}; the header has {}",
                    names(&there)
                ),
            )
        })?;
        if places.next().is_some() {
            return Err(refused(
                &place_of(path, 1),
                &format!("column `{name}` appears twice; rename one of them"),
            ));
        }
        Ok(found)
    });
    found.collect()
}

fn unreadable(path: &Path, error: &csv::Error) -> Error {
    match error.kind() {
        csv::ErrorKind::UnequalLengths {
            pos,
            expected_len,
            len,
        } => {
            let line = pos.as_ref().map_or(0, csv::Position::line);
            let reason = format!(
                "the row has {len} fields, the header has {expected_len}; give every row one field per column"
            );
            refused(&place_of(path, line), &reason)
        }
        _ => refused(&path.display().to_string(), &error.to_string()),
    }
}

fn place_of(path: &Path, line: u64) -> String {
    format!("{}:{line}", path.display())
}

fn refused(place: &str, reason: &str) -> Error {
    Error::Argument(format!("{place}: {reason}"))
}
