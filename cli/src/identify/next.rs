//! What comes behind an identification: the command that asks what the spec lacks.

use super::IdentifyArguments;
use crate::output::path_word as word;
use crate::report::beside;

/// What follows the name of a page's folder in that of the page that comes next.
const BESIDE: &str = "trace";

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
            let beside = beside(folder, BESIDE);
            words.extend(["--report".to_owned(), word(&beside)]);
        }
        Some(words.join(" "))
    }
}
