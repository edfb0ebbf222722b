//! JSON that people write: a key that stands twice in an object is told, where a parser would take one of the two and say
//! nothing.

use std::cell::RefCell;
use std::fmt;
use std::path::Path;

use serde::de::{DeserializeSeed, Deserializer, MapAccess, SeqAccess, Visitor};
use serde_json::{Map, Number, Value};

use crate::Error;
use crate::output::names;
use crate::spec::read_text;

/// Reads a file.
pub(crate) fn read(path: &Path) -> Result<Value, Error> {
    parse(&read_text(path)?).map_err(|reason| Error::json(path, &reason))
}

fn parse(text: &str) -> Result<Value, String> {
    let twice = RefCell::new(Vec::new());
    let mut input = serde_json::Deserializer::from_str(text);
    let value = Reader { twice: &twice }.deserialize(&mut input);
    let value = value.and_then(|value| input.end().map(|()| value));
    let value = value.map_err(|error| error.to_string())?;
    let twice = twice.into_inner();
    if twice.is_empty() {
        return Ok(value);
    }
    let twice: Vec<&str> = twice.iter().map(String::as_str).collect();
    let verb = if twice.len() == 1 { "stands" } else { "stand" };
    Err(format!(
        "{} {verb} there more than once; keep the value that is meant",
        names(&twice)
    ))
}

/// Reads any value, and notes keys that stand twice.
#[derive(Clone, Copy)]
struct Reader<'a> {
    twice: &'a RefCell<Vec<String>>,
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
        while let Some(value) = list.next_element_seed(self)? {
            values.push(value);
        }
        Ok(Value::Array(values))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut entries: A) -> Result<Value, A::Error> {
        let mut object = Map::new();
        while let Some(key) = entries.next_key::<String>()? {
            let value = entries.next_value_seed(self)?;
            let mut twice = self.twice.borrow_mut();
            if object.insert(key.clone(), value).is_some() && !twice.contains(&key) {
                twice.push(key);
            }
        }
        Ok(Value::Object(object))
    }
}

/// What a value is, to say what it should not be.
pub(crate) const fn kind(value: &Value) -> &'static str {
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
        assert_eq!(parse(text), Ok(plain));
    }

    #[test]
    fn keys_that_stand_twice_are_told() {
        let one = parse(r#"{"a":1,"b":2,"a":1}"#);
        assert_eq!(
            one,
            Err("`a` stands there more than once; keep the value that is meant".to_owned())
        );
        let several = parse(r#"{"c":[{"a":1,"a":2,"a":3},{"b":1}],"b":2,"b":{}}"#);
        assert_eq!(
            several,
            Err("`a`, `b` stand there more than once; keep the value that is meant".to_owned())
        );
    }

    #[test]
    fn what_is_no_json_has_its_line() {
        for (text, said) in [
            ("{\"a\": 1,}", "trailing comma at line 1 column 9"),
            ("{}\n{}", "trailing characters at line 2 column 1"),
            ("[1e999]", "number out of range at line 1 column 6"),
            ("[NaN]", "expected value at line 1 column 2"),
        ] {
            assert_eq!(parse(text), Err(said.to_owned()), "{text}");
        }
    }
}
