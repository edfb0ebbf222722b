//! What is asked for on the command line.

use std::path::{Path, PathBuf};

use clap::Parser;

use crate::arm::{ROBOTS, workspace};
use crate::peers;

/// Operations and nanoseconds of emitted dynamics, beside the peers that are installed.
#[derive(Debug, Parser)]
#[command(name = "dynamics", bin_name = "cargo bench --bench dynamics --")]
pub struct Options {
    /// Write the rows there too; a relative path is taken from the repository's root.
    #[arg(long, value_name = "FILE")]
    pub json: Option<PathBuf>,
    /// Arms that are measured.
    #[arg(long, value_delimiter = ',', value_name = "NAME,..", default_values = ROBOTS, value_parser = ROBOTS)]
    pub robots: Vec<String>,
    /// Peers that are measured where they are installed; `none` for ours alone.
    #[arg(long, value_delimiter = ',', value_name = "NAME,..", default_values = peers::NAMES, value_parser = [peers::NAMES[0], peers::NAMES[1], peers::NAMES[2], "none"])]
    pub peers: Vec<String>,
    /// Rounds in which everybody makes one pass over all states; the least of a block's times counts.
    #[arg(long, default_value_t = 31, value_parser = clap::value_parser!(u32).range(1..))]
    pub passes: u32,
    /// How long the compiler takes for each arm, and rustc with what it wrote; and what chains of 5 to 40 joints cost. Some minutes.
    #[arg(long)]
    pub growth: bool,
    /// Write the tables of `docs/benchmarks.md` anew, those of `--growth` among them; of all arms and peers.
    #[arg(long, conflicts_with_all = ["robots", "peers"])]
    pub docs: bool,
    /// What cargo says to every benchmark.
    #[arg(long, hide = true)]
    bench: bool,
}

impl Options {
    /// Where the rows go.
    #[must_use]
    pub fn target(&self) -> Option<PathBuf> {
        // Cargo runs benchmarks in the folder of their crate, which is nowhere that a user stands.
        self.json
            .as_deref()
            .map(|file: &Path| workspace().join(file))
    }

    /// Names of the arms, in the order of the table.
    #[must_use]
    pub fn arms(&self) -> Vec<&'static str> {
        let wanted = |name: &&str| self.robots.iter().any(|robot| robot == name);
        ROBOTS.into_iter().filter(wanted).collect()
    }
}

#[cfg(test)]
mod tests {
    use clap::Parser as _;

    use super::Options;
    use crate::arm::workspace;

    #[test]
    fn as_cargo_calls_it() {
        let options = Options::try_parse_from(["dynamics", "--json", "out.json", "--bench"])
            .expect("all are known");
        assert_eq!(options.target(), Some(workspace().join("out.json")));
        assert_eq!(options.arms(), ["puma560", "ur10", "panda"]);
    }

    #[test]
    fn arms_in_the_order_of_the_table() {
        let options = Options::try_parse_from(["dynamics", "--robots", "panda,puma560"]);
        assert_eq!(
            options.expect("both are known").arms(),
            ["puma560", "panda"]
        );
    }

    #[test]
    fn what_is_not_known_is_told() {
        for (arguments, said) in [
            (["dynamics", "--robots", "pumba"], "puma560"),
            (["dynamics", "--passes", "0"], "0 is not in 1.."),
            (["dynamics", "--peers", "casad"], "'casadi'"),
            (["dynamics", "--help", ""], "--json <FILE>"),
        ] {
            let error = Options::try_parse_from(arguments).expect_err("it is none");
            assert!(error.to_string().contains(said), "{error}");
        }
    }

    /// A page of some arms would lose the rows of the others.
    #[test]
    fn the_page_has_all_arms_and_peers() {
        for choice in ["--robots=panda", "--peers=none"] {
            let arguments = ["dynamics", "--docs", choice];
            let error = Options::try_parse_from(arguments).expect_err("not the whole page");
            assert!(error.to_string().contains("--docs"), "{error}");
        }
        assert!(Options::try_parse_from(["dynamics", "--docs"]).is_ok());
    }
}
