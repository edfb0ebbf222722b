//! Writes the pages of the standard effects, and their list in the book, from the definitions.

use std::fs;
use std::path::Path;
use std::process::ExitCode;

use robot_model_examples::effects;

fn main() -> ExitCode {
    match write() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("effects: {error}");
            ExitCode::FAILURE
        }
    }
}

/// Pages of effects that are no more go, so that none is of an older library.
fn write() -> Result<(), Box<dyn std::error::Error>> {
    let root = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."));
    let folder = root.join("docs/effects");
    fs::create_dir_all(&folder)?;
    let pages = effects::pages();
    for entry in fs::read_dir(&folder)? {
        let entry = entry?;
        if !pages.iter().any(|(name, _)| **name == *entry.file_name()) {
            fs::remove_file(entry.path())?;
        }
    }
    for (name, text) in &pages {
        fs::write(folder.join(name), text)?;
    }
    let summary = root.join("book/src/SUMMARY.md");
    let text = effects::contents(&fs::read_to_string(&summary)?)
        .ok_or("book/src/SUMMARY.md has no line for docs/effects/README.md")?;
    fs::write(summary, text)?;
    Ok(())
}
