//! A line of units below the names of columns, or those of a schema.

use std::f64::consts::{PI, TAU};

use super::columns::DriveSignal;
use super::note::Note;
use super::place::Place;
use super::words;
use super::{LogError, TextError};

/// What a unit is of: joints that turn, those that slide, and both.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Time,
    Turning,
    Sliding,
    Either,
}

/// Words of a channel, as settings of logs have them, too: what a one is worth, and of which joints.
type Words = [(&'static str, f64, Kind)];

const TIMES: [(&str, f64, Kind); 5] = [
    ("s", 1.0, Kind::Time),
    ("ms", 1e-3, Kind::Time),
    ("us", 1e-6, Kind::Time),
    ("ns", 1e-9, Kind::Time),
    ("min", 60.0, Kind::Time),
];
const POSITIONS: [(&str, f64, Kind); 7] = [
    ("rad", 1.0, Kind::Turning),
    ("deg", PI / 180.0, Kind::Turning),
    ("rev", TAU, Kind::Turning),
    ("m", 1.0, Kind::Sliding),
    ("cm", 1e-2, Kind::Sliding),
    ("mm", 1e-3, Kind::Sliding),
    ("um", 1e-6, Kind::Sliding),
];
const SPEEDS: [(&str, f64, Kind); 7] = [
    ("rad/s", 1.0, Kind::Turning),
    ("deg/s", PI / 180.0, Kind::Turning),
    ("rev/s", TAU, Kind::Turning),
    ("rpm", TAU / 60.0, Kind::Turning),
    ("m/s", 1.0, Kind::Sliding),
    ("cm/s", 1e-2, Kind::Sliding),
    ("mm/s", 1e-3, Kind::Sliding),
];
const TORQUES: [(&str, f64, Kind); 3] = [
    ("Nm", 1.0, Kind::Turning),
    ("N", 1.0, Kind::Sliding),
    ("kN", 1e3, Kind::Sliding),
];

const CURRENTS: [(&str, f64, Kind); 1] = [("A", 1.0, Kind::Either)];

/// A line in which every field is a word.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Line {
    /// None of a schema.
    number: Option<u64>,
    /// One a column, empty where there is none.
    words: Vec<String>,
}

/// Channels of a log whose columns have units.
pub(super) struct Channels<'a> {
    pub time: &'a mut Place,
    pub q: &'a mut [Place],
    pub dq: &'a mut [Place],
    pub tau: &'a mut [Place],
    pub signals: &'a [DriveSignal],
}

impl Line {
    /// The fields of a line where none is a number, and two or more are words.
    pub fn of<'a>(
        fields: impl Iterator<Item = &'a [u8]>,
        columns: usize,
        number: u64,
        is_number: impl Fn(&str) -> bool,
    ) -> Option<Self> {
        let words: Vec<String> = fields
            .take(columns)
            .map(|field| String::from_utf8_lossy(field).into_owned())
            .collect();
        let mut said = words.iter().filter(|word| !word.is_empty());
        let is_sound = said.clone().count() > 1 && said.all(|word| !is_number(word));
        is_sound.then_some(Self {
            number: Some(number),
            words,
        })
    }

    /// What a schema says of its columns, where it says something of any.
    #[cfg(feature = "parquet")]
    pub fn of_schema(words: Vec<&'static str>) -> Option<Self> {
        let is_said = words.iter().any(|word| !word.is_empty());
        let words = words.into_iter().map(str::to_owned).collect();
        is_said.then_some(Self {
            number: None,
            words,
        })
    }

    /// Gives columns their units where settings give them none, and tells so.
    ///
    /// # Errors
    /// [`TextError::Unit`]
    pub fn apply(
        &self,
        source: &str,
        names: &[String],
        channels: &mut Channels,
    ) -> Result<Option<Note>, LogError> {
        let mut reading = Reading {
            source,
            names,
            line: self,
            said: Vec::new(),
            against: Vec::new(),
        };
        reading.take(&mut *channels.time, &TIMES, None)?;
        for (joint, place) in channels.q.iter_mut().enumerate() {
            let kind = reading.take(place, &POSITIONS, None)?;
            let kind = match channels.dq.get_mut(joint) {
                Some(place) => reading.take(place, &SPEEDS, kind)?,
                None => kind,
            };
            let place = &mut channels.tau[joint];
            match channels.signals.get(joint).copied().unwrap_or_default() {
                DriveSignal::Torque => reading.take(place, &TORQUES, kind)?,
                DriveSignal::Current => reading.take(place, &CURRENTS, None)?,
                DriveSignal::Number => None,
            };
        }
        // A schema that says what settings say, too, was looked at by nobody.
        let is_silent =
            self.number.is_none() && reading.said.is_empty() && reading.against.is_empty();
        Ok((!is_silent).then_some(Note::Units {
            line: self.number,
            said: reading.said,
            against: reading.against,
        }))
    }
}

/// What becomes of a line.
struct Reading<'a> {
    source: &'a str,
    names: &'a [String],
    line: &'a Line,
    /// Columns with their units.
    said: Vec<String>,
    /// The same of columns that settings have in other ones.
    against: Vec<String>,
}

impl Reading<'_> {
    /// Reads the unit of one channel of a joint that turns or slides, as far as that is known; whether it does.
    fn take(
        &mut self,
        place: &mut Place,
        words: &'static Words,
        joint: Option<Kind>,
    ) -> Result<Option<Kind>, LogError> {
        let written = self.line.words.get(place.column).map_or("", String::as_str);
        if written.is_empty() {
            return Ok(joint);
        }
        let plain = plain(written);
        if place.is_said {
            // What settings say of a column holds.
            let mut same = words.iter().filter(|(word, ..)| *word == plain);
            let is_other = |(_, unit, _): &(&str, f64, Kind)| {
                (unit - place.unit).abs() > 1e-9 * place.unit.abs()
            };
            if let Some((word, ..)) = same.next().filter(|found| is_other(found)) {
                let name = words::field(&self.names[place.column]);
                self.against.push(format!("`{name}` in {word}"));
            }
            return Ok(joint);
        }
        let known = || {
            let own = words.iter();
            own.filter(move |(.., kind)| joint.is_none_or(|joint| *kind == joint))
        };
        let Some((word, unit, kind)) = known().find(|(word, ..)| *word == plain) else {
            return Err(TextError::Unit {
                source_name: self.source.to_owned(),
                // A schema has known units of times alone.
                line: self.line.number.unwrap_or(1),
                column: self.names[place.column].clone(),
                text: words::field(written),
                known: known().map(|(word, ..)| (*word).to_owned()).collect(),
                hint: hint(words, &plain),
            }
            .into());
        };
        place.unit = *unit;
        let name = words::field(&self.names[place.column]);
        self.said.push(format!("`{name}` in {word}"));
        Ok(Some(*kind))
    }
}

/// A name without the unit in brackets behind it, and that unit: `q1 [deg]`. Other words in brackets are part of the name: `q1 (ref)`.
pub(super) fn split(name: &str) -> (&str, Option<&str>) {
    let name = name.trim();
    let brackets = [('[', ']'), ('(', ')')];
    let found = brackets.into_iter().find_map(|(open, close)| {
        let (bare, unit) = name.strip_suffix(close)?.rsplit_once(open)?;
        let is_unit = is_known(&plain(unit)) && !bare.trim().is_empty();
        is_unit.then_some((bare.trim_end(), Some(unit)))
    });
    found.unwrap_or((name, None))
}

fn is_known(unit: &str) -> bool {
    let tables: [&Words; 5] = [&TIMES, &POSITIONS, &SPEEDS, &TORQUES, &CURRENTS];
    let mut words = tables.into_iter().flatten();
    words.any(|(word, ..)| *word == unit)
}

/// The unit of a channel in brackets behind its name, as settings have it; none where it is not known.
pub(super) fn behind(name: &str, family: &str) -> Option<&'static str> {
    let written = plain(split(name).1?);
    let words: &[&Words] = match family {
        "time" => &[&TIMES],
        "q" => &[&POSITIONS],
        "dq" => &[&SPEEDS],
        _ => &[&TORQUES, &CURRENTS],
    };
    let mut words = words.iter().flat_map(|words| words.iter());
    let known = words.find(|(word, ..)| *word == written);
    known.map(|(word, ..)| *word)
}

/// What a current is beside a torque: the arm says which of them a drive logs.
fn hint(words: &Words, written: &str) -> &'static str {
    let is_of = |table: &Words| table.iter().any(|(word, ..)| *word == written);
    if words == CURRENTS && is_of(&TORQUES) {
        " (the joint's `actuator_gain` converts a current to a torque; remove it for a log of torques)"
    } else if words == TORQUES && is_of(&CURRENTS) {
        " (a current needs an `actuator_gain` of the joint in the spec, such as `0.1 Nm/A`)"
    } else {
        ""
    }
}

/// A unit as the tables have it: without brackets, with a word for a sign.
fn plain(written: &str) -> String {
    let bare = written.trim_matches(['[', ']', '(', ')']).trim();
    let spelled = bare
        .replace('\u{b0}', "deg")
        .replace(['\u{b5}', '\u{3bc}'], "u");
    match spelled.as_str() {
        "N m" | "N*m" | "N.m" | "N\u{b7}m" | "N-m" => "Nm".to_owned(),
        "sec" => "s".to_owned(),
        _ => spelled,
    }
}
