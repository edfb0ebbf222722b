//! A paper's program, as it is called: what it prints, draws and writes.

use std::fs;
use std::path::Path;
use std::process::Command;

const PROGRAM: &str = env!("CARGO_BIN_EXE_seed_000");
const PAGE: &str = include_str!("../../docs/papers/seed_000.md");

/// Everything of a page that is the program's is cut out of it before, and is there again behind.
#[test]
fn a_program_prints_draws_and_writes_its_page_anew() {
    let folder = tempfile::tempdir().expect("a folder");
    let (figures, page) = (folder.path().join("drawn"), folder.path().join("page.md"));
    fs::create_dir(folder.path().join("figures")).expect("a folder");
    let worn = PAGE
        .replace("| reached |", "| not reached |")
        .replace("- outcome: reached", "- outcome: not known");
    assert_ne!(worn, PAGE);
    fs::write(&page, worn).expect("a page");
    let run = Command::new(PROGRAM)
        .arg("--figures")
        .arg(&figures)
        .arg("--page")
        .arg(&page)
        .output()
        .expect("the program starts");
    let said = String::from_utf8_lossy(&run.stdout);
    assert!(
        run.status.success(),
        "{}",
        String::from_utf8_lossy(&run.stderr)
    );
    assert!(said.contains("Item by item") && said.contains("outcome: impossible as printed"));
    assert_eq!(fs::read_to_string(&page).expect("a page"), PAGE);
    let count = |of: &Path| {
        let files = fs::read_dir(of).expect("a folder");
        let files = files.map(|file| file.expect("a file").path());
        files
            .filter(|file| file.extension().is_some_and(|end| end == "svg"))
            .count()
    };
    let shown = PAGE.matches("(figures/seed_000_").count();
    assert!(shown > 0 && count(&folder.path().join("figures")) == shown);
    assert!(count(&figures) >= shown);
}

#[test]
fn a_folder_that_cannot_be_made_is_an_error_of_one_line() {
    let folder = tempfile::tempdir().expect("a folder");
    let blocked = folder.path().join("a file");
    fs::write(&blocked, "").expect("a file");
    let run = Command::new(PROGRAM)
        .arg("--figures")
        .arg(blocked.join("drawn"))
        .output()
        .expect("the program starts");
    let said = String::from_utf8_lossy(&run.stderr);
    assert_eq!(run.status.code(), Some(1));
    assert!(
        said.starts_with("seed_000: ") && said.lines().count() == 1,
        "{said}"
    );
    assert!(run.stdout.is_empty());
}
