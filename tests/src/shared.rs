//! Material that stands beside the repository: oracles, measured logs, benchmark cases.

use std::path::PathBuf;

/// A file or folder of the shared material; where it is absent, says so and what is therefore not tested.
#[must_use]
pub fn find(path: &str, what: &str) -> Option<PathBuf> {
    let found = PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../shared")).join(path);
    if found.exists() {
        return Some(found);
    }
    eprintln!("absent: shared/{path}, so this run does not test {what}");
    None
}
