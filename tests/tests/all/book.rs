//! The pages of the docs: every one is in the book, and every link leads somewhere, in the repository as in the book.

use std::collections::HashMap;
use std::fs;
use std::path::{Component, Path, PathBuf};

use pulldown_cmark::{Event, Options, Parser, Tag, TagEnd};

const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/..");
/// The pages of the book, at the places that they have in the repository.
const SOURCES: &str = "book/src";

/// The path without `.` and `..`, where it does not leave the folder.
fn plain(path: &Path) -> Option<PathBuf> {
    let mut plain = PathBuf::new();
    for component in path.components() {
        match component {
            Component::CurDir => {}
            Component::ParentDir => {
                if !plain.pop() {
                    return None;
                }
            }
            other => plain.push(other),
        }
    }
    Some(plain)
}

fn read(page: &Path) -> String {
    fs::read_to_string(Path::new(ROOT).join(page))
        .unwrap_or_else(|error| panic!("{}: {error}", page.display()))
}

/// Files of a kind below a folder of the repository, by their paths from its root.
fn files_in(folder: &str, kind: &str) -> Vec<PathBuf> {
    let mut files = Vec::new();
    let mut folders = vec![PathBuf::from(folder)];
    while let Some(folder) = folders.pop() {
        let entries = fs::read_dir(Path::new(ROOT).join(&folder)).expect("a folder");
        for entry in entries {
            let entry = entry.expect("an entry");
            let path = folder.join(entry.file_name());
            if entry.file_type().expect("a type").is_dir() {
                let is_ours = path != Path::new("target") && path != Path::new(".git");
                folders.extend(is_ours.then_some(path));
            } else if path.extension().is_some_and(|extension| extension == kind) {
                files.push(path);
            }
        }
    }
    files.sort();
    files
}

fn pages_in(folder: &str) -> Vec<PathBuf> {
    files_in(folder, "md")
}

/// Those of the root, of the docs, and those of other folders that are in the book.
fn pages() -> Vec<PathBuf> {
    let root = fs::read_dir(ROOT).expect("the root");
    let mut pages: Vec<PathBuf> = root
        .map(|entry| PathBuf::from(entry.expect("an entry").file_name()))
        .filter(|path| path.extension().is_some_and(|extension| extension == "md"))
        .collect();
    pages.extend(pages_in("docs"));
    pages.extend(in_the_book());
    pages.sort();
    pages.dedup();
    pages
}

fn parser(text: &str) -> Parser<'_> {
    Parser::new_ext(text, Options::ENABLE_TABLES)
}

/// Targets of links and images.
fn links(text: &str) -> Vec<String> {
    let target = |event| match event {
        Event::Start(Tag::Link { dest_url, .. } | Tag::Image { dest_url, .. }) => {
            Some(dest_url.to_string())
        }
        _ => None,
    };
    parser(text).filter_map(target).collect()
}

/// What links to the headings of a page end in: their words in small letters, with hyphens between them; a number behind the second of a name.
fn anchors(text: &str) -> Vec<String> {
    let mut seen: HashMap<String, usize> = HashMap::new();
    let mut anchors = Vec::new();
    let mut heading: Option<String> = None;
    for event in parser(text) {
        match (event, &mut heading) {
            (Event::Start(Tag::Heading { .. }), _) => heading = Some(String::new()),
            (Event::Text(text) | Event::Code(text), Some(heading)) => heading.push_str(&text),
            (Event::End(TagEnd::Heading(_)), _) => {
                let words = heading.take().expect("a heading began").to_lowercase();
                let kept = |c: &char| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_');
                let anchor = words.chars().filter(kept).collect::<String>();
                let anchor = anchor.replace(' ', "-");
                let count = seen.entry(anchor.clone()).or_default();
                anchors.push(match count {
                    0 => anchor,
                    _ => format!("{anchor}-{count}"),
                });
                *count += 1;
            }
            _ => {}
        }
    }
    anchors
}

/// The pages that SUMMARY.md lists, in its order.
fn in_the_book() -> Vec<PathBuf> {
    let summary = read(&Path::new(SOURCES).join("SUMMARY.md"));
    links(&summary).into_iter().map(PathBuf::from).collect()
}

/// Why a link on a page leads nowhere, where it does.
fn trouble(page: &Path, link: &str, book: &[PathBuf]) -> Option<String> {
    let (path, anchor) = link.split_once('#').unwrap_or((link, ""));
    let target = match path {
        "" => Some(page.to_path_buf()),
        _ => plain(&page.parent().expect("a page is in a folder").join(path)),
    };
    let Some(target) = target else {
        return Some("leaves the repository".to_owned());
    };
    if !Path::new(ROOT).join(&target).exists() {
        return Some("is not there".to_owned());
    }
    let is_page = target
        .extension()
        .is_some_and(|extension| extension == "md");
    if book.iter().any(|page_of_book| page_of_book == page) {
        // A folder is listed by the repository's view alone.
        if target.is_dir() || Path::new(ROOT).join(&target).is_dir() {
            return Some("is a folder: link to its README.md, or to a file".to_owned());
        }
        if is_page && !book.contains(&target) {
            return Some(format!(
                "is not in the book: add it to {SOURCES}/SUMMARY.md"
            ));
        }
        if !Path::new(ROOT).join(SOURCES).join(&target).exists() {
            return Some(format!(
                "is not in the book: link it into {SOURCES}, at the same place"
            ));
        }
    }
    let is_there =
        anchor.is_empty() || (is_page && anchors(&read(&target)).contains(&anchor.into()));
    (!is_there).then(|| format!("has no heading `#{anchor}`"))
}

#[test]
fn every_page_is_in_the_book_once() {
    let book = in_the_book();
    assert!(book.len() > 20, "{book:?}");
    for (k, page) in book.iter().enumerate() {
        assert!(!book[..k].contains(page), "{} twice", page.display());
        let source = Path::new(ROOT).join(SOURCES).join(page);
        assert!(
            fs::read_to_string(&source).is_ok_and(|text| text == read(page)),
            "{} is not the repository's page",
            source.display()
        );
    }
    let docs = pages_in("docs");
    let missing: Vec<&PathBuf> = docs.iter().filter(|page| !book.contains(page)).collect();
    assert!(missing.is_empty(), "add to SUMMARY.md: {missing:?}");
}

#[test]
fn every_link_leads_somewhere() {
    let (book, mut count, mut broken) = (in_the_book(), 0, Vec::new());
    for page in pages() {
        for link in links(&read(&page)) {
            let is_of_the_web = link.contains("://") || link.starts_with("mailto:");
            if !is_of_the_web {
                count += 1;
                let trouble = trouble(&page, &link, &book);
                broken.extend(trouble.map(|why| format!("{}: ({link}) {why}", page.display())));
            }
        }
    }
    assert!(broken.is_empty(), "{}", broken.join("\n"));
    assert!(count > 80, "only {count} links were found");
}

/// Programs that a page names by their files; how things were called before is for the changelog.
#[test]
fn every_source_that_a_page_names_is_there() {
    let sources = files_in("", "rs");
    let (mut count, mut missing) = (0, Vec::new());
    for page in pages() {
        if page == Path::new("CHANGELOG.md") {
            continue;
        }
        for event in parser(&read(&page)) {
            let Event::Code(code) = event else { continue };
            let is_pattern = code.contains([' ', '<', '*']);
            if code.ends_with(".rs") && code.contains('/') && !is_pattern {
                count += 1;
                // Components, so that `tests/a.rs` is no end of `mytests/a.rs`.
                let is_there = sources.iter().any(|source| source.ends_with(&*code));
                missing.extend((!is_there).then(|| format!("{}: {code}", page.display())));
            }
        }
    }
    assert!(missing.is_empty(), "{}", missing.join("\n"));
    assert!(count > 40, "only {count} were found");
}

#[test]
fn links_that_lead_nowhere_are_seen() {
    let book = in_the_book();
    let tracing = Path::new("docs/tracing.md");
    let why = |link: &str| trouble(tracing, link, &book);
    assert_eq!(why("friction.md"), None);
    assert_eq!(why("#gates"), None);
    assert_eq!(why("../model-spec/LANGUAGE.md#names-of-parameters"), None);
    for (link, words) in [
        ("no_page.md", "not there"),
        ("friction.md#no-heading", "no heading"),
        ("../../elsewhere.md", "leaves"),
        ("../model-spec/effects", "folder"),
        ("../tests/README.md", "SUMMARY"),
        ("../tests/Cargo.toml", "at the same place"),
    ] {
        let why = why(link).unwrap_or_else(|| panic!("{link} is taken"));
        assert!(why.contains(words), "{link}: {why}");
    }
    let text = "# From C and C++\n## `a_b` of it\n## Gates\n## Gates\n";
    assert_eq!(
        anchors(text),
        ["from-c-and-c", "a_b-of-it", "gates", "gates-1"]
    );
}
