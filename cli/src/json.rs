//! Files of JSON that people write.

use std::path::Path;

use robot_model_codegen::parameters::json::{self, parse};
use serde::de::DeserializeOwned;
use serde_json::Value;

use crate::Error;
use crate::misplaced::instead_of_json;
use crate::spec::read_text;

/// Reads a file.
pub(crate) fn read(path: &Path) -> Result<Value, Error> {
    let text = read_text(path)?;
    parse(&text).map_err(|fault| match instead_of_json(path, &text) {
        Some(reason) => Error::json(path, &reason),
        None => Error::Json {
            path: path.to_owned(),
            line: fault.line,
            reason: fault.reason,
        },
    })
}

/// Line and column of a text in quotation marks, where it stands first.
pub(crate) fn place_of(path: &Path, text: &str) -> Option<(usize, usize)> {
    json::place_of(&read_text(path).ok()?, text)
}

/// What a file says, as it has to be written; `form` shows how. Names the part that is not, such as `balls[1].radius`.
pub(crate) fn typed<T: DeserializeOwned>(
    path: &Path,
    value: Value,
    form: &str,
) -> Result<T, Error> {
    serde_path_to_error::deserialize(value).map_err(|error| {
        let part = error.path().to_string();
        let part = match part.as_str() {
            "." => String::new(),
            part => format!("`{part}`: "),
        };
        Error::json(path, &format!("{part}{}; {form}", error.inner()))
    })
}

#[cfg(test)]
mod tests {
    use super::parse;

    #[test]
    fn what_is_written_otherwise_has_its_part() {
        #[derive(Debug, serde::Deserialize)]
        #[serde(deny_unknown_fields)]
        struct Ball {
            #[expect(dead_code, reason = "only whether it can be read is asked")]
            radius: f64,
        }
        let value = |text| parse(text).expect("JSON");
        let said = |text| {
            let balls: Result<Vec<Ball>, _> =
                super::typed(std::path::Path::new("f.json"), value(text), "write `..`");
            balls.expect_err("refused").to_string()
        };
        assert_eq!(
            said(r#"[{"radius": 1}, {"radius": "2"}]"#),
            "f.json: `[1].radius`: invalid type: string \"2\", expected f64; write `..`"
        );
        assert!(said(r#"[{"radios": 1}]"#).contains("`[0].radios`: unknown field"));
        assert!(said("3").starts_with("f.json: invalid type: integer `3`"));
    }
}
