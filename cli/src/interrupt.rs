//! Ctrl-C: the end, with files whole or absent and a line that says which; in a search first a wish to have the best so far.

use std::fs;
use std::io::IsTerminal as _;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

use crate::output::{names, say};

/// What a shell takes for the end by Ctrl-C.
const CODE: i32 = 130;

/// Whether a search wants to know of it, and whether it was pressed since.
static IS_WATCHED: AtomicBool = AtomicBool::new(false);
static IS_PRESSED: AtomicBool = AtomicBool::new(false);

/// Folders that were made for files which are not there yet. Whoever writes holds it, and the end waits.
static UNFINISHED: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// Files that are in place.
static WRITTEN: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// From the beginning of a terminal's line, which a bar may be on, to its end nothing.
const CLEARED: &str = "\r\u{1b}[2K";

/// From now on Ctrl-C is heeded. Where the system gives no signals, nobody presses.
pub(crate) fn heed() {
    // A second time it is heeded already.
    let _ = ctrlc::set_handler(pressed);
}

fn pressed() {
    if IS_WATCHED.load(Ordering::Relaxed) && !IS_PRESSED.swap(true, Ordering::Relaxed) {
        return;
    }
    let unfinished = unfinished();
    for folder in unfinished.iter() {
        // What somebody has put there in the meantime stays.
        let _ = fs::remove_dir(folder);
    }
    let clear = if std::io::stderr().is_terminal() {
        CLEARED
    } else {
        ""
    };
    let written = WRITTEN.lock().unwrap_or_else(PoisonError::into_inner);
    say(&format!("{clear}{}", told(&written)));
    std::process::exit(CODE)
}

/// What is said at the end.
fn told(written: &[PathBuf]) -> String {
    let files = written.iter().map(|path| path.display().to_string());
    let files: Vec<String> = files.collect();
    let files: Vec<&str> = files.iter().map(String::as_str).collect();
    match files.as_slice() {
        [] => "interrupted: no file was written".to_owned(),
        [_] => format!(
            "interrupted: {} is whole, and no other file was written",
            names(&files)
        ),
        _ => format!(
            "interrupted: {} are whole, and no other file was written",
            names(&files)
        ),
    }
}

/// A file is in place; only where Ctrl-C waits.
pub(crate) fn wrote(path: &Path) {
    let mut written = WRITTEN.lock().unwrap_or_else(PoisonError::into_inner);
    written.push(path.to_owned());
}

fn unfinished() -> MutexGuard<'static, Vec<PathBuf>> {
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Does what Ctrl-C may not part.
pub(crate) fn whole<T>(work: impl FnOnce() -> T) -> T {
    let _unfinished = unfinished();
    work()
}

/// An empty folder that was made for what is to come, with those around it that were missing, the innermost first; they go away where that
/// does not come.
#[derive(Debug)]
pub(crate) struct MadeFolder(Vec<PathBuf>);

impl MadeFolder {
    /// Makes it.
    pub(crate) fn make(path: &Path) -> std::io::Result<Self> {
        let mut unfinished = unfinished();
        let missing = path
            .ancestors()
            .take_while(|folder| !folder.as_os_str().is_empty() && !folder.exists());
        let missing: Vec<PathBuf> = missing.map(Path::to_owned).collect();
        fs::create_dir_all(path)?;
        unfinished.extend(missing.iter().rev().cloned());
        Ok(Self(missing))
    }
}

impl Drop for MadeFolder {
    fn drop(&mut self) {
        let mut unfinished = unfinished();
        unfinished.retain(|path| !self.0.contains(path));
        for folder in &self.0 {
            // It stays where something is in it.
            let _ = fs::remove_dir(folder);
        }
    }
}

/// Ctrl-C as a wish, for as long as this lives; pressed again, the end.
#[derive(Debug)]
pub(crate) struct Wish(());

impl Wish {
    /// From now on.
    pub(crate) fn watch() -> Self {
        heed();
        IS_PRESSED.store(false, Ordering::Relaxed);
        IS_WATCHED.store(true, Ordering::Relaxed);
        Self(())
    }

    pub(crate) fn is_pressed(&self) -> bool {
        let Self(()) = self;
        IS_PRESSED.load(Ordering::Relaxed)
    }
}

impl Drop for Wish {
    fn drop(&mut self) {
        IS_WATCHED.store(false, Ordering::Relaxed);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_end_says_which_files_are_there() {
        let said = |paths: &[&str]| told(&paths.iter().map(PathBuf::from).collect::<Vec<_>>());
        assert_eq!(said(&[]), "interrupted: no file was written");
        assert_eq!(
            said(&["fit.json"]),
            "interrupted: `fit.json` is whole, and no other file was written"
        );
        let two = said(&["a.robot", "page/index.html"]);
        assert!(two.starts_with("interrupted: `a.robot`"), "{two}");
        assert!(two.contains("`page/index.html` are whole"), "{two}");
    }
}
