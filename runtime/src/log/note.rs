//! What is remarkable about a log, and no error.

use std::fmt;

use super::Stretches;
use super::words::{list, plural};

/// Something about a log that its user should know, and that is no error.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Note {
    /// Columns that are neither time, position, velocity nor torque.
    ExtraChannels {
        /// Their names.
        names: Vec<String>,
    },
    /// Columns that hold something else than numbers, and are left out.
    NoNumbers {
        /// Their names.
        names: Vec<String>,
    },
    /// Columns, other than those of the motion, that have no number in some rows: straight lines join those that they have.
    Sparse {
        /// Their names.
        names: Vec<String>,
    },
    /// The file has none of the columns that were asked for, but the standard ones: those were read, in SI units.
    StandardColumns {
        /// Those that were asked for.
        missing: Vec<String>,
    },
    /// Lines above the header that are no comments.
    Above {
        /// How many.
        lines: usize,
        /// The first.
        first: String,
        /// The line of the header.
        header: u64,
    },
    /// A column in front without a name, which counts the rows.
    RowNumbers,
    /// Commas stand before decimals.
    DecimalCommas,
    /// A line below the names says units, or the schema of the file.
    Units {
        /// The line; none of a schema.
        line: Option<u64>,
        /// Columns that are read in them.
        said: Vec<String>,
        /// Columns of which settings say another unit, which holds.
        against: Vec<String>,
    },
    /// Dates or times of day in place of seconds.
    Clock {
        /// The first.
        first: String,
    },
    /// Time in two columns.
    TwoTimes {
        /// That of seconds.
        seconds: String,
        /// That of nanoseconds.
        nanoseconds: String,
    },
    /// Rows that hold no finite number somewhere: they count as missing.
    LostRows {
        /// How many.
        rows: usize,
        /// What is wrong with the first.
        first: String,
    },
    /// Samples that nearly coincide in time with the one before: their mean stands for both.
    Coincident {
        /// How many.
        samples: usize,
        /// Time of the first, s.
        first: f64,
    },
    /// Samples are missing in time.
    Gaps {
        /// How often and how long.
        at: Stretches,
    },
    /// All positions have the noise of torques, and no torque has: they may be exchanged.
    Exchanged,
    /// The last line has no end, and its last number is shorter than the one above it: the file may be cut in it.
    NoLineEnd {
        /// That line.
        line: u64,
    },
    /// The time stamps were not uniform: all channels were interpolated onto a grid of the median step.
    Resampled {
        /// Samples as logged.
        logged: usize,
        /// Samples on the grid.
        resampled: usize,
        /// The grid's step, s.
        step: f64,
        /// Root mean square of `step_k - step`, s.
        jitter_rms: f64,
        /// Largest `|step_k - step|`, s.
        jitter_max: f64,
        /// Line of the sample that ends the worst step, where the log came from a file.
        worst_line: Option<u64>,
    },
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::ExtraChannels { names } => write!(f, "extra channels: {}", list(names)),
            Self::NoNumbers { names } => {
                write!(f, "columns without numbers are ignored: {}", list(names))
            }
            Self::Sparse { names } => write!(
                f,
                "columns with numbers in only some rows are interpolated: {}",
                list(names)
            ),
            Self::StandardColumns { missing } => write!(
                f,
                "it lacks the columns named by the spec's `log` or its settings ({}), but has `time`, `q1` and so on: these are read, in SI units (torques in what the joint's `actuator_gain` takes, if it has one)",
                list(missing)
            ),
            Self::Above {
                lines,
                first,
                header,
            } => write!(
                f,
                "the header is line {header}: {lines} line{} above it {} passed over: `{first}`{}",
                plural(*lines),
                if *lines == 1 { "is" } else { "are" },
                if *lines == 1 { "" } else { " and so on" }
            ),
            Self::NoLineEnd { line } => write!(
                f,
                "line {line}, the last one, has no end, and its last number is shorter than the one above: if the file was cut there, remove that line"
            ),
            Self::Exchanged => write!(
                f,
                "positions have far more noise than torques, relative to their size: are these columns exchanged? Name those of `q` and `tau` in the \
                 spec's `log`, or in a `robot-model.toml`"
            ),
            Self::RowNumbers => write!(
                f,
                "the first column has no name and counts the rows: it is ignored"
            ),
            Self::DecimalCommas => write!(f, "commas in numbers are read as decimal points"),
            Self::Units {
                line,
                said,
                against,
            } => of_units(f, *line, said, against),
            Self::Clock { first } => write!(
                f,
                "time is given as times of day: it is read as seconds since the first, `{first}`"
            ),
            Self::TwoTimes {
                seconds,
                nanoseconds,
            } => write!(
                f,
                "time is the sum of `{seconds}` and `{nanoseconds}`, in seconds since the first"
            ),
            Self::LostRows { rows: 1, first } => {
                write!(f, "one row counts as missing, since {first}")
            }
            Self::LostRows { rows, first } => {
                write!(
                    f,
                    "{rows} rows count as missing, the first of them since {first}"
                )
            }
            Self::Coincident { samples, first } => write!(
                f,
                "{samples} samples nearly coincide in time with the one before, the first at {first:.3} s; each pair was replaced by its mean"
            ),
            Self::Gaps { at } => write!(f, "samples are missing, {at}"),
            Self::Resampled {
                logged,
                resampled,
                step,
                jitter_rms,
                jitter_max,
                worst_line,
            } => {
                write!(
                    f,
                    "time stamps are not uniform: {logged} samples were resampled to {resampled} at the median step of {} ms; \
                     steps differ from it by {} ms RMS, {} ms at most",
                    milliseconds(*step),
                    milliseconds(*jitter_rms),
                    milliseconds(*jitter_max),
                )?;
                worst_line.map_or(Ok(()), |line| write!(f, " (line {line})"))
            }
        }
    }
}

/// Seconds as milliseconds with the digits that a time stamp can have.
fn milliseconds(seconds: f64) -> String {
    let text = format!("{:.4}", seconds * 1e3);
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// What a line of units, or a schema, says: which columns are read so, and which settings contradict.
fn of_units(
    f: &mut fmt::Formatter<'_>,
    line: Option<u64>,
    said: &[String],
    against: &[String],
) -> fmt::Result {
    match line {
        Some(line) => write!(f, "line {line} says units: ")?,
        None => write!(f, "the file's schema says units: ")?,
    }
    match (said.is_empty(), against.is_empty()) {
        (true, true) => write!(f, "settings say the same"),
        (false, true) => write!(f, "{} are read so", said.join(", ")),
        (true, false) => contradicted(f, against),
        (false, false) => {
            write!(f, "{} are read so; ", said.join(", "))?;
            contradicted(f, against)
        }
    }
}

/// That settings and a line of units contradict each other.
fn contradicted(f: &mut fmt::Formatter<'_>, against: &[String]) -> fmt::Result {
    let against = against.join(", ");
    write!(
        f,
        "{against}, but settings give another unit, which is used; remove the wrong one"
    )
}
