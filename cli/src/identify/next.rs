//! What comes behind an identification: the command that asks what the spec lacks.

use std::path::Path;

use super::IdentifyArguments;
use crate::output::quoted;

/// The folder of its page: what follows the name of the identification's, or all of it where that has none, as `.` and `/`.
const BESIDE: &str = "-trace";
const ALONE: &str = "trace";

impl IdentifyArguments {
    /// `trace` of the same spec and logs, with a page beside this one; none of logs that are only read in pieces, as `trace` reads them whole.
    pub(super) fn command_of_trace(&self) -> Option<String> {
        if self.factor.is_some() {
            return None;
        }
        let mut words = vec!["robot-model trace".to_owned(), word(&self.spec)];
        words.extend(self.logs.iter().map(|log| word(log)));
        // With a payload the log to validate on is of an arm that carries it.
        if let Some(log) = self.validate.as_deref().filter(|_| self.payload.is_empty()) {
            words.extend(["--validate".to_owned(), word(log)]);
        }
        if let Some(file) = self.log_settings.given() {
            words.extend(["--log-settings".to_owned(), word(file)]);
        }
        if let Some(folder) = &self.report {
            let beside = match folder.file_name() {
                Some(name) => {
                    let mut name = name.to_owned();
                    name.push(BESIDE);
                    folder.with_file_name(name)
                }
                None => ALONE.into(),
            };
            words.extend(["--report".to_owned(), word(&beside)]);
        }
        Some(words.join(" "))
    }
}

/// A path as a shell and the program take it: none that begins with `-` is an option.
fn word(path: &Path) -> String {
    let text = path.display().to_string();
    if text.starts_with('-') {
        quoted(&format!("./{text}"))
    } else {
        quoted(&text)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_are_words_of_a_shell() {
        let said = |path: &str| word(Path::new(path));
        assert_eq!(said("monday.csv"), "monday.csv");
        assert_eq!(said("my log.csv"), "'my log.csv'");
        assert_eq!(said("-a.csv"), "./-a.csv");
    }
}
