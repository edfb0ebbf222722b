//! `robot-model completions`: what shells complete.

use clap::{Args, CommandFactory};
use clap_complete::Shell;

use crate::{CommandLine, Error, output};

/// Print the completion script of a shell.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  robot-model completions bash > ~/.local/share/bash-completion/completions/robot-model
  robot-model completions zsh > ~/.zfunc/_robot-model
  robot-model completions fish > ~/.config/fish/completions/robot-model.fish")]
pub(crate) struct Completions {
    /// The shell.
    shell: Shell,
}

impl Completions {
    pub(crate) fn run(&self) -> Result<(), Error> {
        let mut command = CommandLine::command();
        let name = command.get_name().to_owned();
        let mut text = Vec::new();
        clap_complete::generate(self.shell, &mut command, &name, &mut text);
        let text = String::from_utf8_lossy(&text);
        // The generator for bash has a hyphen in one way where it sets a verb and in another where it looks for it.
        let [set, looked_for] = ["__", "__subcmd__"].map(|hyphen| name.replace('-', hyphen));
        output::print(&text.replace(&looked_for, &set))
    }
}
