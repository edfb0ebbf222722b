//! How certain the choice of base parameters is.

use crate::sample::NoNumber;
use crate::selection::{DEPENDENT_BELOW, INDEPENDENT_ABOVE};

/// How clearly the independent columns are told from the dependent ones.
#[derive(Debug, Clone, PartialEq)]
pub enum RankStatus {
    /// Every column was on one side of the gap.
    Clear {
        /// Least that was left of a kept column.
        smallest_kept: f64,
        /// Most that was left of a dropped column.
        largest_dropped: f64,
    },
    /// Some columns were inside the gap; they are kept.
    Unclear(Vec<UnclearColumn>),
    /// A column is no number where it was looked at; nothing is kept.
    NoNumber(NoNumber),
}

impl RankStatus {
    /// Whether base parameters may be computed with.
    #[must_use]
    pub const fn is_clear(&self) -> bool {
        matches!(self, Self::Clear { .. })
    }
}

/// A column that is neither clearly independent nor clearly dependent.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct UnclearColumn {
    /// Name of the standard parameter.
    pub name: String,
    /// What is left of its scaled column.
    pub residual: f64,
}

impl std::fmt::Display for RankStatus {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Clear {
                smallest_kept,
                largest_dropped,
            } => write!(
                f,
                "rank is clear: smallest remainder of a kept column {smallest_kept:.1e}, largest of a dropped one {largest_dropped:.1e}"
            ),
            Self::Unclear(columns) => {
                write!(
                    f,
                    "the base parameters are uncertain: between {DEPENDENT_BELOW:.0e} and {INDEPENDENT_ABOVE:.0e},"
                )?;
                for column in columns {
                    write!(f, " `{}` has {:.1e} left", column.name, column.residual)?;
                }
                f.write_str(
                    "; write exact values where lengths or angles are nearly equal or nearly zero, and one effect where two are nearly \
                     alike",
                )
            }
            Self::NoNumber(no_number) => write!(f, "{no_number}"),
        }
    }
}
