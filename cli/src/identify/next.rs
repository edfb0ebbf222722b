//! What comes behind an identification: the command that asks what the spec lacks.

use std::path::Path;

use super::IdentifyArguments;
use crate::output::quoted;

/// The folder of its page where the identification has one of the same name.
const BESIDE: &str = "-trace";

impl IdentifyArguments {
    /// `trace` of the same spec and logs, with a page beside this one.
    pub(super) fn command_of_trace(&self) -> String {
        let word = |path: &Path| quoted(&path.display().to_string());
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
            let folder = folder.display().to_string();
            let beside = format!("{}{BESIDE}", folder.trim_end_matches(['/', '\\']));
            words.extend(["--report".to_owned(), quoted(&beside)]);
        }
        words.join(" ")
    }
}
