//! The papers' programs, as they are called: what they print, draw and write.

use std::fs;
use std::path::Path;
use std::process::Command;
use std::time::Instant;

use robot_model_examples::paper::have_same_words;

/// A test of each program with its page.
macro_rules! programs {
    ($($name:ident),*) => {$(
        #[test]
        fn $name() {
            prints_draws_and_writes_its_page_anew(
                stringify!($name),
                env!(concat!("CARGO_BIN_EXE_", stringify!($name))),
                include_str!(concat!("../../../docs/papers/", stringify!($name), ".md")),
            );
        }
    )*};
}

programs!(seed_000, seed_001, seed_002, seed_003, seed_004);

/// A page without the rows of tables that count.
fn without_places(page: &str) -> String {
    let is_place = |line: &&str| {
        let cell = line.trim_start_matches("| ").split(" |").next();
        cell.is_some_and(|cell| line.starts_with("| ") && cell.parse::<u32>().is_ok())
    };
    let lines = page.lines().filter(|line| !is_place(line));
    lines.collect::<Vec<&str>>().join("\n")
}

/// Everything of a page that is the program's is cut out of it before, and is there again behind.
fn prints_draws_and_writes_its_page_anew(name: &str, program: &str, shown: &str) {
    let folder = tempfile::tempdir().expect("a folder");
    let (figures, page) = (folder.path().join("drawn"), folder.path().join("page.md"));
    fs::create_dir(folder.path().join("figures")).expect("a folder");
    let worn = shown
        .replace("| reached |", "| not reached |")
        .replace("- outcome: reached", "- outcome: not known");
    assert_ne!(worn, shown);
    fs::write(&page, worn).expect("a page");
    let run = Command::new(program)
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
    // Numbers of searches that end nowhere hang on rounding, and with them how many places they have.
    let written = fs::read_to_string(&page).expect("a page");
    let [written, wanted] = [&*written, shown].map(without_places);
    assert!(have_same_words(&written, &wanted), "{written}");
    let count = |of: &Path| {
        let files = fs::read_dir(of).expect("a folder");
        let files = files.map(|file| file.expect("a file").path());
        files
            .filter(|file| file.extension().is_some_and(|end| end == "svg"))
            .count()
    };
    let shown = shown.matches(&format!("(figures/{name}_")).count();
    assert!(shown > 0 && count(&folder.path().join("figures")) == shown);
    assert!(count(&figures) >= shown);
}

#[test]
fn a_folder_that_cannot_be_made_is_an_error_of_one_line() {
    let folder = tempfile::tempdir().expect("a folder");
    let blocked = folder.path().join("a file");
    fs::write(&blocked, "").expect("a file");
    let run = Command::new(env!("CARGO_BIN_EXE_seed_000"))
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

/// Before anything is computed: the programs take up to a minute.
#[test]
fn a_page_that_is_not_there_and_one_without_figures_are_told_at_once_with_what_to_do() {
    let folder = tempfile::tempdir().expect("a folder");
    let page = folder.path().join("new.md");
    let said = || {
        let run = Command::new(env!("CARGO_BIN_EXE_seed_003"))
            .arg("--figures")
            .arg(folder.path().join("drawn"))
            .arg("--page")
            .arg(&page)
            .output()
            .expect("the program starts");
        assert_eq!(run.status.code(), Some(1));
        assert!(run.stdout.is_empty());
        String::from_utf8_lossy(&run.stderr).into_owned()
    };
    let start = Instant::now();
    let without = said();
    assert!(
        without.contains("new.md: ") && without.contains("copy"),
        "{without}"
    );
    fs::write(&page, "# A page").expect("a page");
    let without = said();
    let figures = folder.path().join("figures");
    let figures = figures.to_str().expect("a path in letters");
    assert!(
        without.contains(figures) && without.contains("make it"),
        "{without}"
    );
    assert_eq!(without.lines().count(), 1, "{without}");
    assert!(start.elapsed().as_secs() < 5);
}
