//! CSV files of wanted motions and of torques.

use std::path::Path;

use robot_model::log::Channel;
use robot_model::simulate::{Torques, Trajectory};

use crate::Error;
use crate::output::names;
use crate::spec::read_text;

/// Columns of numbers under their names.
struct Table {
    names: Vec<String>,
    /// `[column][row]`
    columns: Vec<Vec<f64>>,
    /// Line of each row.
    lines: Vec<u64>,
}

fn refused(path: &Path, reason: &str) -> Error {
    Error::Argument(format!("{}: {reason}", path.display()))
}

fn refused_at(path: &Path, line: u64, reason: &str) -> Error {
    Error::Argument(format!("{}:{line}: {reason}", path.display()))
}

fn read(path: &Path) -> Result<Table, Error> {
    let text = read_text(path)?;
    let mut reader = csv::ReaderBuilder::new()
        .trim(csv::Trim::All)
        .from_reader(text.trim_start_matches('\u{feff}').as_bytes());
    let unreadable = |error: csv::Error| match error.kind() {
        csv::ErrorKind::UnequalLengths {
            pos,
            expected_len,
            len,
        } => {
            let line = pos.as_ref().map_or(0, csv::Position::line);
            let reason = format!(
                "the row has {len} fields, the header has {expected_len}; give every row one field per column"
            );
            refused_at(path, line, &reason)
        }
        _ => refused(path, &error.to_string()),
    };
    let header = reader.headers().map_err(unreadable)?;
    let names: Vec<String> = header.iter().map(str::to_owned).collect();
    if names.len() == 1 && names[0].contains([';', '\t']) {
        let reason = "its columns are not separated by commas; separate columns with commas, and write decimals with a point";
        return Err(refused_at(path, 1, reason));
    }
    for (k, name) in names.iter().enumerate() {
        if names[..k].contains(name) {
            let reason = format!("column `{name}` appears twice; rename one of them");
            return Err(refused_at(path, 1, &reason));
        }
    }
    let mut columns = vec![Vec::new(); names.len()];
    let mut lines = Vec::new();
    for record in reader.records() {
        let record = record.map_err(unreadable)?;
        let line = record.position().map_or(0, csv::Position::line);
        lines.push(line);
        for ((field, column), name) in record.iter().zip(&mut columns).zip(&names) {
            match field.parse::<f64>() {
                Ok(value) if value.is_finite() => column.push(value),
                _ => {
                    let reason = format!(
                        "`{field}` in column `{name}` is no finite number; repair or remove the row"
                    );
                    return Err(refused_at(path, line, &reason));
                }
            }
        }
    }
    Ok(Table {
        names,
        columns,
        lines,
    })
}

impl Table {
    fn take(&mut self, name: &str) -> Option<Vec<f64>> {
        let place = self.names.iter().position(|other| other == name)?;
        self.names.remove(place);
        Some(self.columns.remove(place))
    }

    /// One column a joint, or none at all where the first is not there and they are optional.
    fn family(
        &mut self,
        path: &Path,
        stem: &str,
        dof: usize,
        form: &str,
        is_optional: bool,
    ) -> Result<Vec<Vec<f64>>, Error> {
        let wanted: Vec<String> = (1..=dof).map(|joint| format!("{stem}{joint}")).collect();
        if is_optional && !wanted.iter().any(|name| self.names.contains(name)) {
            return Ok(Vec::new());
        }
        let missing: Vec<&str> = wanted
            .iter()
            .filter(|name| !self.names.contains(name))
            .map(String::as_str)
            .collect();
        if !missing.is_empty() {
            return Err(refused(
                path,
                &format!("it has no column {}; write `{form}`", names(&missing)),
            ));
        }
        Ok(wanted.iter().filter_map(|name| self.take(name)).collect())
    }

    fn time(&mut self, path: &Path, form: &str) -> Result<Vec<f64>, Error> {
        let time = self.take("time");
        let time =
            time.ok_or_else(|| refused(path, &format!("it has no column `time`; write `{form}`")))?;
        let mut pairs = time.windows(2).zip(self.lines.iter().skip(1));
        match pairs.find(|(pair, _)| pair[1] <= pair[0]) {
            None => Ok(time),
            Some((pair, line)) => {
                let reason = format!(
                    "the row has time {} s, the one before it {} s; sort the rows by time, and remove duplicates",
                    pair[1], pair[0]
                );
                Err(refused_at(path, *line, &reason))
            }
        }
    }

    /// A column of a joint that the arm does not have, or that is not read.
    fn stray(&self, dof: usize, stems: &[&str]) -> Option<String> {
        let of_joint = |name: &&String| {
            let stem = name.trim_end_matches(|c: char| c.is_ascii_digit());
            stems.contains(&stem) && stem.len() < name.len()
        };
        let name = self.names.iter().find(of_joint)?;
        Some(format!(
            "column `{name}` belongs to no joint: the arm has {}",
            crate::output::counted(dof, "joint")
        ))
    }
}

/// `time,q1..qn[,dq1..dqn[,ddq1..ddqn]][,extra..]`; torques of a log that is moved along again are left out.
pub(crate) fn trajectory(path: &Path, dof: usize) -> Result<Trajectory, Error> {
    const FORM: &str = "time,q1,..[,dq1,..][,ddq1,..][,extra]";
    let mut table = read(path)?;
    let time = table.time(path, FORM)?;
    let q = table.family(path, "q", dof, FORM, false)?;
    let dq = table.family(path, "dq", dof, FORM, true)?;
    let ddq = table.family(path, "ddq", dof, FORM, true)?;
    table.family(path, "tau", dof, FORM, true)?;
    if let Some(reason) = table.stray(dof, &["q", "dq", "ddq", "tau"]) {
        return Err(refused(path, &reason));
    }
    if dq.is_empty() && !ddq.is_empty() {
        return Err(refused(
            path,
            "it has accelerations but no velocities; add `dq1,..`, or remove `ddq1,..`",
        ));
    }
    let extra = table.names.into_iter().zip(table.columns);
    let extra = extra
        .map(|(name, values)| Channel { name, values })
        .collect();
    Trajectory::new(time, q, dq, ddq, extra).map_err(|error| refused(path, &error.to_string()))
}

/// `time,tau1..taun`; other columns, as those of a log, are left out.
pub(super) fn torques(path: &Path, dof: usize) -> Result<Torques, Error> {
    const FORM: &str = "time,tau1,..";
    let mut table = read(path)?;
    let time = table.time(path, FORM)?;
    let tau = table.family(path, "tau", dof, FORM, false)?;
    Torques::new(time, tau).map_err(|error| refused(path, &error.to_string()))
}
