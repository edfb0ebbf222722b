//! Kinds of files that are read, each with files to start from, damage, and what is right of it.

use std::path::Path;

use clap::ValueEnum;
use rand::RngExt as _;
use rand_chacha::ChaCha8Rng;

use crate::answer::Answer;
use crate::damage::Damage;
use crate::mutate::mutate_words;
use crate::{answer, bytes, json, log, mutate, urdf};

/// A kind of files.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Kind {
    /// Specs, through the whole compiler.
    Spec,
    /// Logs in text, plain or gzip.
    Csv,
    /// Logs in Parquet.
    Parquet,
    /// Logs in bags of ROS 2.
    Mcap,
    /// URDFs, to a spec and back.
    Urdf,
    /// Parameters, factors and states in JSON, through the program.
    Json,
}

impl Kind {
    /// What files of the kind end with.
    #[must_use]
    pub const fn extension(self) -> &'static str {
        match self {
            Self::Spec => "robot",
            Self::Csv => "csv",
            Self::Parquet => "parquet",
            Self::Mcap => "mcap",
            Self::Urdf => "urdf",
            Self::Json => "json",
        }
    }

    /// The kind of a file, by its name.
    #[must_use]
    pub fn of(path: &Path) -> Option<Self> {
        let extension = path.extension()?;
        let mut all = Self::value_variants().iter();
        all.find(|kind| extension == kind.extension()).copied()
    }

    /// Sound files, beside those of the repository.
    #[must_use]
    pub fn seeds(self) -> Vec<Vec<u8>> {
        match self {
            Self::Spec => Vec::new(),
            Self::Csv => log::csv(),
            Self::Parquet => log::parquet(),
            Self::Mcap => log::mcap(),
            Self::Urdf => urdf::seeds(),
            Self::Json => json::seeds(),
        }
    }

    /// A damaged copy of a file; parts of `other` may be spliced in.
    #[must_use]
    pub fn mutate(self, file: &[u8], other: &[u8], dice: &mut ChaCha8Rng) -> Vec<u8> {
        let as_bytes = dice.random_range(0..4) == 0;
        let (Ok(text), Ok(spliced), false) = (
            std::str::from_utf8(file),
            std::str::from_utf8(other),
            as_bytes && self != Self::Spec,
        ) else {
            return bytes::mutate(file, other, dice);
        };
        match self {
            Self::Spec => mutate::mutate(text, spliced, dice).into_bytes(),
            Self::Csv if dice.random_range(0..2) == 0 => {
                let damage = Damage::ALL[dice.random_range(0..Damage::ALL.len())];
                damage.of_table(text, dice)
            }
            Self::Csv => mutate_words(text, spliced, &log::WORDS, dice).into_bytes(),
            Self::Urdf => mutate_words(text, spliced, &urdf::WORDS, dice).into_bytes(),
            Self::Json => mutate_words(text, spliced, &json::WORDS, dice).into_bytes(),
            Self::Parquet | Self::Mcap => bytes::mutate(file, other, dice),
        }
    }

    /// What a reader makes of a file.
    ///
    /// # Panics
    /// Where the reader does, and where it breaks what it promises: that is what is looked for.
    #[must_use]
    pub fn answer(self, file: &[u8]) -> Answer {
        match self {
            Self::Csv | Self::Parquet => log::answer(file),
            Self::Mcap => log::answer_of_bag(file),
            Self::Json => json::answer(&json::program(), file),
            // Programs refuse these before anything reads them.
            Self::Spec | Self::Urdf => match std::str::from_utf8(file) {
                Err(_) => Answer::refused("no text"),
                Ok(text) if self == Self::Spec => answer::answer(text),
                Ok(text) => urdf::answer(text),
            },
        }
    }
}
