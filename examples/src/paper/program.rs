//! What the program of every paper does: run, print, draw.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Parser;

use super::list::with_every_item;
use super::{Error, Paper};

/// Whose items the list of papers beside a page has.
const PAPERS: [&str; 5] = ["seed_000", "seed_001", "seed_002", "seed_003", "seed_004"];

/// Reproduce a paper: its tables beside ours, its figures, and what is wrong in it.
#[derive(Debug, Parser)]
struct Options {
    /// Folder for the figures; `target/papers/NAME` unless told.
    #[arg(long, value_name = "DIR")]
    figures: Option<PathBuf>,
    /// Print tables as Markdown, as the docs have them.
    #[arg(long)]
    markdown: bool,
    /// Write the tables, the items and the figures that this page of the docs shows anew, and its items in the list of papers, where that is beside
    /// it; it has a folder `figures` beside it.
    #[arg(long, value_name = "FILE.md")]
    page: Option<PathBuf>,
}

/// Runs the paper of this name and prints it. Returns the exit code: 1 where a library or a file says no.
#[must_use]
#[expect(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "a program's result"
)]
pub fn main(name: &str, run: impl Fn() -> Result<Paper, Error>) -> ExitCode {
    let options = Options::parse();
    let folder = options.figures.unwrap_or_else(|| {
        let folders = ["target", "papers", name];
        folders.iter().collect()
    });
    // What cannot be written is told before the minute of a run.
    let is_writable = || {
        fs::create_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
        options.page.as_deref().map_or(Ok(()), is_page)
    };
    let done = is_writable().and_then(|()| run()).and_then(|paper| {
        for figure in &paper.figures {
            fs::write(
                folder.join(&figure.name).with_extension("svg"),
                figure.svg(),
            )?;
        }
        if let Some(page) = &options.page {
            rewrite(page, name, &paper)?;
        }
        Ok(paper)
    });
    match done {
        Ok(paper) if options.markdown => println!("{}", paper.markdown()),
        Ok(paper) => println!("{paper}\nFigures are in {}.", folder.display()),
        Err(error) => {
            eprintln!("{name}: {error}");
            return ExitCode::FAILURE;
        }
    }
    ExitCode::SUCCESS
}

/// Whether there is a page to write anew, with a folder for its figures beside it.
fn is_page(page: &Path) -> Result<(), Error> {
    if let Err(error) = fs::read_to_string(page) {
        return Err(format!(
            "{}: {error}; `--page` writes a page anew that there is, so copy that of docs/papers there first",
            page.display()
        )
        .into());
    }
    let figures = page.with_file_name("figures");
    if !figures.is_dir() {
        return Err(format!(
            "{}: no such folder; `--page` writes the figures of a page there, so make it first",
            figures.display()
        )
        .into());
    }
    Ok(())
}

/// The figures of a page stand beside it, `figures/NAME_FIGURE.svg`.
fn rewrite(page: &Path, name: &str, paper: &Paper) -> Result<(), Error> {
    let text = paper.rewritten(&fs::read_to_string(page)?);
    for figure in &paper.figures {
        let file = format!("figures/{name}_{}.svg", figure.name);
        if text.contains(&format!("({file})")) {
            fs::write(page.with_file_name(file), figure.svg())?;
        }
    }
    fs::write(page, text)?;
    list(page)
}

/// The list of papers beside a page with the items of all pages, where there are such.
fn list(page: &Path) -> Result<(), Error> {
    let list = page.with_file_name("README.md");
    let page = |name: &&str| fs::read_to_string(page.with_file_name(format!("{name}.md")));
    let pages: Result<Vec<String>, _> = PAPERS.iter().map(page).collect();
    let (Ok(text), Ok(pages)) = (fs::read_to_string(&list), pages) else {
        return Ok(());
    };
    let pages = PAPERS.into_iter().zip(pages.iter().map(String::as_str));
    if let Some(text) = with_every_item(&text, pages) {
        fs::write(list, text)?;
    }
    Ok(())
}
