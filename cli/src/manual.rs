//! `robot-model man`: pages of the manual.

use std::path::{Path, PathBuf};

use clap::builder::Resettable;
use clap::{Args, Command, CommandFactory};
use clap_mangen::Man as Page;

use crate::interrupt::MadeFolder;
use crate::output::{Files, counted};
use crate::{CommandLine, Error, output};

/// Head of a page's second section.
const SYNOPSIS: &str = ".SH SYNOPSIS\n";

/// Print the manual page of the program, or write the pages of all verbs.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  robot-model man > robot-model.1
  robot-model man --out ~/.local/share/man/man1")]
pub(crate) struct Man {
    /// Folder to write `robot-model.1`, `robot-model-identify.1` and the others to; created if missing.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

impl Man {
    pub(crate) fn run(&self) -> Result<(), Error> {
        let mut command = CommandLine::command().disable_help_subcommand(true);
        command.build();
        match &self.out {
            None => output::print(&page(&command).1),
            Some(folder) => write(folder, &pages(&command)),
        }
    }
}

/// The pages of a command and all below it, each with its file's name.
fn pages(command: &Command) -> Vec<(String, String)> {
    let below = command.get_subcommands().flat_map(pages);
    std::iter::once(page(command)).chain(below).collect()
}

/// A page and its file's name. The synopsis is the usage of the help, which says what may be repeated; examples stand line by line, so that
/// they can be copied.
fn page(command: &Command) -> (String, String) {
    let examples = command.get_after_help().map(ToString::to_string);
    let usage = command.clone().render_usage().to_string();
    let page = Page::new(command.clone().after_help(Resettable::Reset));
    let name = page.get_filename();
    let mut text = Vec::new();
    page.render(&mut text).expect("a list takes all");
    let text = String::from_utf8_lossy(&text);
    let (head, rest) = text.split_once(SYNOPSIS).expect("every page has one");
    let (_, rest) = rest.split_once(".SH ").expect("it is not the last");
    let usage = usage.trim_start_matches("Usage:").lines().map(str::trim);
    let mut text = format!("{head}{SYNOPSIS}{}.SH {rest}", typed(usage));
    if let Some(examples) = examples {
        let commands = examples.trim_start_matches("Examples:").trim_matches('\n');
        text.push_str(".SH EXAMPLES\n");
        text.push_str(&typed(commands.lines()));
    }
    (name, text)
}

/// Lines as they are typed: a hyphen is one, and a line that begins with a dot is none of the page's.
fn typed<'a>(lines: impl Iterator<Item = &'a str>) -> String {
    let escaped = lines.map(|line| line.replace('\\', "\\e").replace('-', "\\-"));
    let lines: Vec<String> = escaped.map(|line| format!("\\&{line}\n")).collect();
    format!(".nf\n{}.fi\n", lines.concat())
}

/// All of them, or none where one cannot be written.
fn write(folder: &Path, pages: &[(String, String)]) -> Result<(), Error> {
    let made = if folder.exists() {
        None
    } else {
        let made = MadeFolder::make(folder).map_err(|error| Error::Write {
            path: folder.to_owned(),
            reason: format!("the folder cannot be created: {error}"),
        })?;
        Some(made)
    };
    let mut files = Files::default();
    let claimed = pages.iter().map(|(name, text)| {
        let file = files.claim(&folder.join(name))?;
        Ok((file, text))
    });
    let claimed = claimed.collect::<Result<Vec<_>, Error>>()?;
    for (file, text) in claimed {
        file.commit(text.as_bytes())?;
    }
    drop(made);
    output::print(&format!(
        "wrote {} to {}\n",
        counted(pages.len(), "page"),
        folder.display()
    ))
}
