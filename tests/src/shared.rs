//! Material that stands beside the repository: oracles, measured logs, benchmark cases.

use std::path::PathBuf;

const SHARED: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../shared");

/// Whether the material is there: then nothing of it may be passed over.
#[must_use]
pub fn is_present() -> bool {
    PathBuf::from(SHARED).exists()
}

/// A file or folder of the shared material; where the material is absent, says so and what is therefore not tested.
///
/// # Panics
/// Where the material is there and this part of it is not: a test that passes over what it should read cannot fail.
#[must_use]
pub fn find(path: &str, what: &str) -> Option<PathBuf> {
    let found = PathBuf::from(SHARED).join(path);
    if found.exists() {
        return Some(found);
    }
    assert!(
        !is_present(),
        "shared/{path} is missing from the shared material"
    );
    eprintln!("absent: shared/{path}, so this run does not test {what}");
    None
}
