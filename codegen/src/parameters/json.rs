//! JSON that people write: a key that stands twice in an object is told, where a parser would take one of the two and say
//! nothing.

use std::cell::{Cell, RefCell};
use std::fmt;

use serde::de::{self, DeserializeSeed, Deserializer, MapAccess, SeqAccess, Visitor};
use serde_json::{Map, Number, Value};

use super::names;

/// Bytes that the values of a file may take: some letters, as of `{"a":0}`, take a hundred times their number.
const MOST_MEMORY: usize = 1 << 29;

/// Bytes of one value, with as much again for the list in which it stands, which grows by doubling.
const OF_A_VALUE: usize = 2 * size_of::<Value>();

/// Bytes of an object with something in it: one node of a tree, which has room for eleven keys.
const OF_AN_OBJECT: usize = 11 * (size_of::<String>() + size_of::<Value>());

/// Line and column of a key's second place, where it is at two in all of a text: the same key may be another object's.
fn second(text: &str, key: &str) -> Option<(usize, usize)> {
    let quoted = serde_json::to_string(key).ok()?;
    let places = text.match_indices(&quoted).map(|(place, _)| place);
    let is_key = |place: &usize| {
        let behind = text[place + quoted.len()..].trim_start();
        behind.starts_with(':')
    };
    let places: Vec<usize> = places.filter(is_key).collect();
    let [_, second] = places[..] else {
        return None;
    };
    let before = &text[..second];
    let begin = before.rfind('\n').map_or(0, |end| end + 1);
    Some((
        before.matches('\n').count() + 1,
        before[begin..].chars().count() + 1,
    ))
}

/// Keys that stand twice are told as far as these.
const MOST_TOLD: usize = 100;

/// Why a text is not read.
#[derive(Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Fault {
    /// Line and column, where the text is no JSON.
    pub line: Option<(usize, usize)>,
    /// What is wrong.
    pub reason: String,
}

/// Reads a text.
///
/// # Errors
/// What is no JSON, with its line; keys that stand twice; more values than memory is for.
pub fn parse(text: &str) -> Result<Value, Fault> {
    parse_within(text, MOST_MEMORY)
}

/// Line and column, from 1, of a text in quotation marks, where it stands first.
#[must_use]
pub fn place_of(file: &str, text: &str) -> Option<(usize, usize)> {
    let before = &file[..file.find(&Value::from(text).to_string())?];
    let line = before.matches('\n').count() + 1;
    let column = before.chars().rev().take_while(|c| *c != '\n').count() + 1;
    Some((line, column))
}

/// Line and column, from 1, of the last letter that is no space.
fn end(text: &str) -> (usize, usize) {
    let written = text.trim_end();
    let last = written.lines().last().unwrap_or(written);
    (written.lines().count().max(1), last.chars().count().max(1))
}

fn parse_within(text: &str, most: usize) -> Result<Value, Fault> {
    let notes = Notes {
        room: Cell::new(Some(most)),
        ..Notes::default()
    };
    // The mark that some editors put before a text of UTF-8.
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut input = serde_json::Deserializer::from_str(text);
    let value = Reader { notes: &notes }.deserialize(&mut input);
    let value = value.and_then(|value| input.end().map(|()| value));
    let value = value.map_err(|error| {
        let said = error.to_string();
        let place = format!(" at line {} column {}", error.line(), error.column());
        let said = said.strip_suffix(&place).unwrap_or(&said);
        let reason = if notes.room.get().is_none() {
            format!("the values up to here take more than {most} bytes; write fewer into one file")
        } else if said == "recursion limit exceeded" {
            "lists and objects are nested more than a hundred deep; nest them less".to_owned()
        } else {
            format!("it is not JSON: {said}; repair it here")
        };
        Fault {
            line: Some(if error.is_eof() {
                end(text)
            } else {
                (error.line(), error.column())
            }),
            reason,
        }
    })?;
    let twice = notes.twice.into_inner();
    if twice.is_empty() {
        return Ok(value);
    }
    let line = match &twice[..] {
        [key] => second(text, key),
        _ => None,
    };
    let twice: Vec<&str> = twice.iter().map(String::as_str).collect();
    let verb = if twice.len() == 1 {
        "appears"
    } else {
        "appear"
    };
    Err(Fault {
        line,
        reason: format!(
            "{} {verb} more than once; keep the right value",
            names(&twice)
        ),
    })
}

/// What is noted on the way through a text.
#[derive(Default)]
struct Notes {
    /// Keys and places in lists that lead to where the reader is: `balls`, `[1]`.
    path: RefCell<Vec<String>>,
    /// Bytes that values may still take; none once they took more.
    room: Cell<Option<usize>>,
    /// Paths of keys that stand twice.
    twice: RefCell<Vec<String>>,
}

impl Notes {
    /// Reads what is below a key or a place in a list.
    fn below<T>(&self, step: String, read: impl FnOnce() -> T) -> T {
        self.path.borrow_mut().push(step);
        let found = read();
        self.path.borrow_mut().pop();
        found
    }

    /// Counts memory that is about to be taken.
    fn take<E: de::Error>(&self, bytes: usize) -> Result<(), E> {
        let left = self.room.get().and_then(|room| room.checked_sub(bytes));
        self.room.set(left);
        left.map(|_| ()).ok_or_else(|| E::custom("too large"))
    }

    fn stands_twice(&self, key: &str) {
        if self.twice.borrow().len() == MOST_TOLD {
            return;
        }
        let mut whole = String::new();
        for step in self.path.borrow().iter().map(String::as_str).chain([key]) {
            if !whole.is_empty() && !step.starts_with('[') {
                whole.push('.');
            }
            whole.push_str(step);
        }
        let mut twice = self.twice.borrow_mut();
        if !twice.contains(&whole) {
            twice.push(whole);
        }
    }
}

/// Reads any value, and notes keys that stand twice.
#[derive(Clone, Copy)]
struct Reader<'a> {
    notes: &'a Notes,
}

impl<'de> DeserializeSeed<'de> for Reader<'_> {
    type Value = Value;

    fn deserialize<D: Deserializer<'de>>(self, input: D) -> Result<Value, D::Error> {
        input.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for Reader<'_> {
    type Value = Value;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("JSON")
    }

    fn visit_unit<E>(self) -> Result<Value, E> {
        Ok(Value::Null)
    }

    fn visit_bool<E>(self, value: bool) -> Result<Value, E> {
        Ok(Value::Bool(value))
    }

    fn visit_u64<E>(self, value: u64) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_i64<E>(self, value: i64) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_f64<E>(self, value: f64) -> Result<Value, E> {
        Ok(Number::from_f64(value).map_or(Value::Null, Value::Number))
    }

    fn visit_str<E>(self, value: &str) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Value, A::Error> {
        let mut values = Vec::new();
        loop {
            let step = format!("[{}]", values.len());
            match self.notes.below(step, || list.next_element_seed(self))? {
                Some(value) => {
                    self.notes.take(OF_A_VALUE)?;
                    values.push(value);
                }
                None => break,
            }
        }
        Ok(Value::Array(values))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut entries: A) -> Result<Value, A::Error> {
        let mut object = Map::new();
        while let Some(key) = entries.next_key::<String>()? {
            let node = if object.is_empty() { OF_AN_OBJECT } else { 0 };
            self.notes.take(node + OF_A_VALUE)?;
            let below = || entries.next_value_seed(self);
            let value = self.notes.below(key.clone(), below)?;
            if object.insert(key.clone(), value).is_some() {
                self.notes.stands_twice(&key);
            }
        }
        Ok(Value::Object(object))
    }
}

/// What a value is, to say what it should not be.
#[must_use]
pub const fn kind(value: &Value) -> &'static str {
    match value {
        Value::Null => "null",
        Value::Bool(_) => "`true` or `false`",
        Value::Number(_) => "a number",
        Value::String(_) => "text",
        Value::Array(_) => "a list",
        Value::Object(_) => "an object",
    }
}

#[cfg(test)]
mod tests {
    use serde_json::Value;

    use super::parse;

    #[test]
    fn values_are_those_of_any_parser() {
        let text = r#"{"a":[1,-2,3.5,1e300,"x\n",true,null,{}],"b":{"a":1}}"#;
        let plain: Value = serde_json::from_str(text).expect("JSON");
        assert_eq!(parse(text), Ok(plain.clone()));
        assert_eq!(parse(&format!("\u{feff}{text}")), Ok(plain));
    }

    fn refused(text: &str) -> (Option<(usize, usize)>, String) {
        let fault = parse(text).expect_err("refused");
        (fault.line, fault.reason)
    }

    #[test]
    fn keys_that_stand_twice_are_told() {
        let (_, one) = refused(r#"{"a":1,"b":2,"a":1}"#);
        assert_eq!(one, "`a` appears more than once; keep the right value");
        let (line, _) = refused("{\"b.a\": 1,\n  \"b.a\": 2}");
        assert_eq!(line, Some((2, 3)));
        let (_, several) = refused(r#"{"c":[{"b":1},{"d":{"a":1,"a":2,"a":3}}],"b":2,"b":{}}"#);
        assert_eq!(
            several,
            "`c[1].d.a`, `b` appear more than once; keep the right value"
        );
    }

    #[test]
    fn what_is_no_json_has_its_line() {
        for (text, line, said) in [
            ("{\"a\": 1,}", (1, 9), "trailing comma"),
            ("{}\n{}", (2, 1), "trailing characters"),
            ("[1e999]", (1, 6), "number out of range"),
            ("[NaN]", (1, 2), "expected value"),
            ("{\"a\": [1,\n 2\n\n", (2, 2), "EOF while parsing a list"),
        ] {
            let wanted = format!("it is not JSON: {said}; repair it here");
            assert_eq!(refused(text), (Some(line), wanted), "{text}");
        }
    }

    #[test]
    fn what_is_nested_without_end_is_refused() {
        for (open, place) in [
            ("[", (1, 128)),
            ("{\"a\":", (1, 636)),
            ("[{\"a\":\n", (64, 2)),
        ] {
            let (told, said) = refused(&open.repeat(1_000_000));
            assert_eq!(told, Some(place), "{said}");
            assert!(said.contains("nested more than a hundred deep"), "{said}");
        }
    }

    #[test]
    fn memory_has_an_end() {
        let objects = format!("[{}{{}}]", "{\"a\":0},\n".repeat(1000));
        assert!(super::parse_within(&objects, 1 << 20).is_ok());
        let fault = super::parse_within(&objects, 1 << 18).expect_err("too large");
        assert_eq!(
            fault.reason,
            "the values up to here take more than 262144 bytes; write fewer into one file"
        );
        assert!(
            fault
                .line
                .is_some_and(|(line, _)| (300..500).contains(&line)),
            "{fault:?}"
        );
    }
}
