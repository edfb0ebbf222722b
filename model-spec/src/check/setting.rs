//! Keys of a block: known, and not twice.

use std::collections::BTreeMap;

use crate::ast::{Setting, Value};
use crate::diagnostic::Diagnostic;
use crate::suggest;

use super::Errors;

/// The keys that are meant by keys which are not known: what is told of a slip is not told again as missing.
pub(super) fn meant<'a>(settings: &[Setting], known: &[&'a str]) -> Vec<&'a str> {
    let keys = settings.iter().map(|setting| setting.key.to_string());
    let unknown = keys.filter(|key| !known.contains(&key.as_str()));
    let meant = unknown.filter_map(|key| suggest::nearest(&key, known.iter().copied()));
    meant.collect()
}

/// The settings of one block by key.
pub(super) struct Settings<'a> {
    by_key: BTreeMap<String, &'a Setting>,
    /// Keys that are there with a slip.
    meant: Vec<String>,
}

impl<'a> Settings<'a> {
    /// Reports keys that are unknown or there twice. `owner` reads like "joint `waist`".
    pub(super) fn new(
        settings: &'a [Setting],
        owner: &str,
        allowed: &[&str],
        errors: &mut Errors,
    ) -> Self {
        for setting in settings {
            let key = setting.key.to_string();
            if !allowed.contains(&key.as_str()) {
                errors.push(
                    Diagnostic::new(
                        setting.key.span(),
                        format!("{owner} has no setting `{key}`"),
                        "unknown setting",
                    )
                    .help(suggest::help(&key, allowed.iter().copied())),
                );
            }
        }
        let meant = meant(settings, allowed).into_iter().map(str::to_owned);
        Self {
            meant: meant.collect(),
            ..Self::unchecked(settings, owner, errors)
        }
    }

    /// Reports only keys that are there twice.
    pub(super) fn unchecked(settings: &'a [Setting], owner: &str, errors: &mut Errors) -> Self {
        let mut by_key: BTreeMap<String, &Setting> = BTreeMap::new();
        for setting in settings {
            let key = setting.key.to_string();
            if let Some(first) = by_key.get(&key) {
                errors.push(
                    Diagnostic::new(
                        setting.key.span(),
                        format!("{owner} sets `{key}` twice"),
                        "second",
                    )
                    .also(first.key.span(), "first")
                    .help("delete one of them"),
                );
            } else {
                by_key.insert(key, setting);
            }
        }
        Self {
            by_key,
            meant: Vec::new(),
        }
    }

    /// Whether a key is not there, not even with a slip, which is told already.
    pub(super) fn lacks(&self, key: &str) -> bool {
        self.get(key).is_none() && !self.meant.iter().any(|meant| meant == key)
    }

    pub(super) fn get(&self, key: &str) -> Option<&'a Value> {
        self.by_key.get(key).map(|setting| &setting.value)
    }
}
