//! Columns and units of logs in a TOML file beside them, `robot-model.toml`: the `log` block of a spec in other clothes.
//!
//! ```text
//! TOML -parse-> the block's Ast -check-> LogColumns
//! ```
//! What is read becomes the tree that a `log { .. }` is parsed into, its tokens placed where they stand in the file; rules and
//! words of mistakes are those of the block.

mod kind;

use std::borrow::Cow;
use std::ops::Range;

use proc_macro2::{Span, TokenStream};
use syn::LitStr;
use toml::Spanned;
use toml::de::{DeArray, DeTable, DeValue};

use crate::ast::{Expr, LogChannel, LogColumn};
use crate::check::{MOST_JOINTS, check_settings, check_unit};
use crate::diagnostic::{Diagnostic, Diagnostics};
use crate::model::{LogColumns, Model};
use crate::parse::parse_value;
use crate::suggest;
use kind::kind;

/// Bytes of a file; one with a column for each of forty joints has four thousand.
const LARGEST: usize = 64 * 1024;

/// How columns are written.
const FORMS: &str =
    "`q = [\"pos 1\", \"pos 2\"]` or `q = { columns = [\"pos 1\", \"pos 2\"], unit = \"deg\" }`";

/// What a file of settings says of the logs of a robot.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct LogSettings {
    /// Where logs have their channels: as the file says, then as the spec says.
    pub columns: LogColumns,
    /// Channels that the file says.
    pub said: Vec<String>,
}

/// Reads a file of settings, `[log]` with a channel a key, for the logs of a robot. Channels that the spec's `log` has, too, are those of
/// the file, each as a whole. `source_name` is what messages call the file.
///
/// # Errors
/// Every mistake of the first stage (TOML, form, rules of a `log` block) that has one.
///
/// # Examples
/// ```
/// let spec = "robot Wheel { gravity = [0, 0, 0]; convention = standard_dh; joint axle: revolute { a = 0; alpha = 0; d = 0; } }";
/// let model = robot_model_spec::load("wheel.robot", spec)?;
/// let file = "[log]\ntime = { column = 'stamp', unit = 'ms' }\ndq = { columns = ['speed'], unit = 'rpm' }\n";
/// let settings = robot_model_spec::log_settings(&model, "robot-model.toml", file)?;
/// assert_eq!(settings.columns.time.expect("said").unit, 1e-3);
/// assert_eq!(settings.columns.dq[0].name, "speed");
/// # Ok::<(), robot_model_spec::Diagnostics>(())
/// ```
pub fn log_settings(
    model: &Model,
    source_name: &str,
    text: &str,
) -> Result<LogSettings, Diagnostics> {
    let refuse = |errors| Diagnostics::new(source_name, text, errors);
    let channels = parse(text, Some(model.joints.len())).map_err(refuse)?;
    let mut errors = Vec::new();
    let columns = check_settings(&channels, model, &mut errors);
    if !errors.is_empty() {
        return Err(refuse(errors));
    }
    let said = channels.into_iter().map(|channel| channel.key).collect();
    Ok(LogSettings { columns, said })
}

/// What a column holds that is read without a robot.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ColumnKind {
    /// Seconds.
    Time,
    /// Radians.
    Angle,
    /// Radians a second.
    AngularSpeed,
    /// Newton meters.
    Torque,
    /// Newtons.
    Force,
    /// Amperes.
    Current,
    /// Volts, which the language has no unit for: a plain number.
    Voltage,
}

/// What a one in a column is worth in SI units; none where the file does not name the column. `source_name` is what messages call the file.
///
/// # Errors
/// Mistakes of the file, and a unit of another kind.
///
/// # Examples
/// ```
/// use robot_model_spec::{ColumnKind, log_column_unit};
/// let file = "[log]\ntau = { columns = ['i1', 'i2'], unit = 'mA' }\n";
/// let unit = |column| log_column_unit("robot-model.toml", file, column, ColumnKind::Current);
/// assert_eq!((unit("i2")?, unit("i3")?), (Some(1e-3), None));
/// # Ok::<(), robot_model_spec::Diagnostics>(())
/// ```
pub fn log_column_unit(
    source_name: &str,
    text: &str,
    column: &str,
    kind: ColumnKind,
) -> Result<Option<f64>, Diagnostics> {
    let refuse = |errors| Diagnostics::new(source_name, text, errors);
    let channels = parse(text, None).map_err(refuse)?;
    let mut columns = channels.iter().flat_map(|channel| &channel.columns);
    let found = columns.find(|own| own.name.value().trim() == column);
    let unit = found.map(|own| check_unit(own, kind)).transpose();
    unit.map_err(|error| refuse(vec![error]))
}

/// The channels of a file, as a `log` block of a robot with so many joints would have them, if that is known.
fn parse(text: &str, joints: Option<usize>) -> Result<Vec<LogChannel>, Vec<Diagnostic>> {
    if text.len() > LARGEST {
        let error = Diagnostic::in_text(0..0, "the file is no file of log settings: too large", "");
        let help = format!("write only the entries of a `log` block, in at most {LARGEST} bytes");
        return Err(vec![error.help(help)]);
    }
    let document = DeTable::parse(text).map_err(|error| {
        let place = error.span().unwrap_or(0..text.len());
        let said = error.message().replace('\n', ", ");
        let help = format!("repair the TOML here; columns are written as {FORMS}");
        vec![Diagnostic::in_text(place, said, "").help(help)]
    })?;
    let mut reader = Reader {
        text,
        joints,
        errors: Vec::new(),
    };
    let channels = reader.file(document.get_ref());
    if reader.errors.is_empty() {
        Ok(channels)
    } else {
        Err(reader.errors)
    }
}

/// Makes channels of a table.
struct Reader<'a> {
    text: &'a str,
    joints: Option<usize>,
    errors: Vec<Diagnostic>,
}

/// A value with its place.
type Value<'a> = Spanned<DeValue<'a>>;

impl Reader<'_> {
    fn file(&mut self, table: &DeTable) -> Vec<LogChannel> {
        let mut channels = Vec::new();
        let mut is_there = false;
        if let Some(key) = above_log(table) {
            let message = format!("`{}` is not under `[log]`", key.get_ref());
            let error = Diagnostic::in_text(key.span(), message, "a channel of logs");
            let help = "put `[log]` on a line of its own above the channels";
            self.errors.push(error.help(help));
            return channels;
        }
        for (key, value) in table {
            if key.get_ref() != "log" {
                let message = format!("log settings have no `{}`", key.get_ref());
                let error = Diagnostic::in_text(key.span(), message, "unknown");
                self.errors
                    .push(error.help(suggest::help(key.get_ref(), ["log"])));
                continue;
            }
            is_there = true;
            match value.get_ref() {
                DeValue::Table(log) => channels = self.channels(log),
                other => {
                    let message = format!("expected the table `log`, found {}", kind(other));
                    let error = Diagnostic::in_text(value.span(), message, "");
                    self.errors
                        .push(error.help("write `[log]`, and a line for each channel below it"));
                }
            }
        }
        if !is_there && self.errors.is_empty() {
            let error = Diagnostic::in_text(0..0, "the file has no log settings", "");
            let help = format!("write `[log]`, and below it columns as {FORMS}");
            self.errors.push(error.help(help));
        }
        channels
    }

    fn channels(&mut self, log: &DeTable) -> Vec<LogChannel> {
        let channels = log.iter().map(|(key, value)| LogChannel {
            key: key.get_ref().to_string(),
            span: span_of(key.span()),
            columns: self.columns(key.get_ref(), value),
        });
        channels.collect()
    }

    /// `"name"`, `[..]`, or `{ columns = [..], unit = ".." }`
    fn columns(&mut self, channel: &str, value: &Value) -> Vec<LogColumn> {
        match value.get_ref() {
            DeValue::String(_) => self.column(value).into_iter().collect(),
            DeValue::Array(list) => {
                let columns = list.iter().map(|one| match one.get_ref() {
                    DeValue::Table(table) => self.one_of(channel, one, table),
                    _ => self.column(one),
                });
                columns.collect::<Vec<_>>().into_iter().flatten().collect()
            }
            DeValue::Table(table) => self.with_units(channel, value, table),
            other => {
                let message = format!(
                    "expected the columns of channel `{channel}`, found {}",
                    kind(other)
                );
                let error = Diagnostic::in_text(value.span(), message, "");
                self.errors.push(error.help(format!("write {FORMS}")));
                Vec::new()
            }
        }
    }

    /// `{ column = "name", unit = ".." }` in a list
    fn one_of(&mut self, channel: &str, value: &Value, table: &DeTable) -> Option<LogColumn> {
        let mut columns = self.with_units(channel, value, table);
        let is_unnamed = ["column", "columns"]
            .iter()
            .all(|key| !table.contains_key(*key));
        if is_unnamed && !columns.is_empty() {
            let error = Diagnostic::in_text(value.span(), "a unit alone in a list of columns", "");
            let help = format!(
                "write `{channel} = {{ unit = [\"deg\", \"mm\"] }}` for all, or `column = \"name\"` here"
            );
            self.errors.push(error.help(help));
        } else if columns.len() > 1 {
            let error = Diagnostic::in_text(value.span(), "several columns in one place", "");
            let help = "write one column here, `{ column = \"name\", unit = \"deg\" }`, or one table for all";
            self.errors.push(error.help(help));
        }
        columns.pop()
    }

    fn with_units(&mut self, channel: &str, value: &Value, table: &DeTable) -> Vec<LogColumn> {
        const KEYS: [&str; 3] = ["column", "columns", "unit"];
        let before = self.errors.len();
        for key in table.keys() {
            if !KEYS.contains(&key.get_ref().as_ref()) {
                let message = format!("channel `{channel}` has no setting `{}`", key.get_ref());
                let error = Diagnostic::in_text(key.span(), message, "unknown setting");
                self.errors
                    .push(error.help(suggest::help(key.get_ref(), KEYS)));
            }
        }
        let named = (table.get("column"), table.get("columns"));
        let unit = table.get("unit");
        let standard = unit.and_then(|unit| self.standard(channel, value, unit));
        let mut columns: Vec<LogColumn> = match named {
            (None, None) if standard.is_some() => standard.unwrap_or_default(),
            (Some(one), None) => self.column(one).into_iter().collect(),
            (None, Some(several)) => self.several(several),
            (one, _) => {
                if self.errors.len() == before {
                    let message = match one {
                        None => format!("channel `{channel}` names no column"),
                        Some(_) => format!("channel `{channel}` names its columns twice"),
                    };
                    let error = Diagnostic::in_text(value.span(), message, "");
                    let help = "write `column = \"name\"`, or `columns = [..]` with one a joint";
                    self.errors.push(error.help(help));
                }
                return Vec::new();
            }
        };
        if let Some(unit) = unit {
            self.units(unit, &mut columns);
        }
        columns
    }

    /// The columns that a channel has where nobody names them; none of an input, which is of the arm or of a joint.
    fn standard(&self, channel: &str, value: &Value, unit: &Value) -> Option<Vec<LogColumn>> {
        let joints = match (self.joints, unit.get_ref()) {
            (Some(joints), _) => joints,
            // Whoever has no robot looks for a column by its name.
            (None, DeValue::Array(list)) => list.len(),
            (None, _) => MOST_JOINTS,
        };
        let names = match channel {
            "time" => vec![channel.to_owned()],
            "q" | "dq" | "tau" => (1..=joints).map(|k| format!("{channel}{k}")).collect(),
            _ => return None,
        };
        let column = |name: String| LogColumn {
            name: LitStr::new(&name, span_of(value.span())),
            unit: None,
        };
        Some(names.into_iter().map(column).collect())
    }

    fn several(&mut self, value: &Value) -> Vec<LogColumn> {
        let DeValue::Array(list) = value.get_ref() else {
            return self.column(value).into_iter().collect();
        };
        let columns = list.iter().map(|one| self.column(one));
        columns.collect::<Vec<_>>().into_iter().flatten().collect()
    }

    /// One unit for all columns, or a list with one for each.
    fn units(&mut self, value: &Value, columns: &mut [LogColumn]) {
        let units = if let DeValue::Array(list) = value.get_ref() {
            self.listed(value.span(), list, columns.len())
        } else {
            vec![self.unit(value); columns.len()]
        };
        for (column, unit) in columns.iter_mut().zip(units) {
            column.unit = unit;
        }
    }

    fn listed(&mut self, place: Range<usize>, list: &DeArray, wanted: usize) -> Vec<Option<Expr>> {
        if list.len() != wanted {
            let message = format!("{} units for {wanted} columns", list.len());
            let error = Diagnostic::in_text(place, message, "");
            let help = "write one unit for all, or as many as columns, in their order";
            self.errors.push(error.help(help));
        }
        list.iter().map(|one| self.unit(one)).collect()
    }

    fn column(&mut self, value: &Value) -> Option<LogColumn> {
        let DeValue::String(name) = value.get_ref() else {
            let message = format!(
                "expected the name of a column, found {}",
                kind(value.get_ref())
            );
            let error = Diagnostic::in_text(value.span(), message, "");
            let help = format!("write it in quotes, as in the log's header: {FORMS}");
            self.errors.push(error.help(help));
            return None;
        };
        Some(LogColumn {
            name: LitStr::new(name, span_of(value.span())),
            unit: None,
        })
    }

    /// `"360 deg/65536"`, or a number
    fn unit(&mut self, value: &Value) -> Option<Expr> {
        let place = value.span();
        let written = &self.text[place.clone()];
        let text = match value.get_ref() {
            DeValue::String(unit) if unit.contains('\u{b0}') => &unit.replace('\u{b0}', "deg"),
            DeValue::String(unit) => unit.as_ref(),
            DeValue::Integer(_) | DeValue::Float(_) => written,
            other => {
                let message = format!("expected a unit, found {}", kind(other));
                let error = Diagnostic::in_text(place, message, "");
                let help = "write the value of 1 in the column, such as `unit = \"deg\"` or `unit = \"360 deg/4096\"`";
                self.errors.push(error.help(help));
                return None;
            }
        };
        let start = place.start + written.find(text).unwrap_or_default();
        match parse_value(&(" ".repeat(start) + text)) {
            Ok(unit) => Some(unit),
            Err(errors) => {
                let errors = errors.into_iter();
                // Where a unit ends too early, there is no token to point at.
                self.errors
                    .extend(errors.map(|error| error.or_in_text(place.clone())));
                None
            }
        }
    }
}

/// The first key of a file whose channels stand under no table.
fn above_log<'a, 'b>(table: &'a DeTable<'b>) -> Option<&'a Spanned<Cow<'b, str>>> {
    let is_channel = |key: &str| ["time", "q", "dq", "tau", "topic"].contains(&key);
    let mut keys = table.iter().map(|(key, _)| key);
    let is_elsewhere = table.keys().all(|key| key.get_ref() != "log");
    keys.find(|key| is_elsewhere && is_channel(key.get_ref()))
}

/// The span of a place in a text that is not made of tokens: that of a word of the same length at the same place.
fn span_of(place: Range<usize>) -> Span {
    let word = "x".repeat(place.len().max(1));
    let tokens: Result<TokenStream, _> = (" ".repeat(place.start) + &word).parse();
    let word = tokens.ok().and_then(|tokens| tokens.into_iter().next());
    word.map_or_else(Span::call_site, |word| word.span())
}
