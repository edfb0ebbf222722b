//! What is wanted of a motion, as the command line says it.

use clap::ValueEnum;
use robot_model::excite::{Criterion, Scaling};

use crate::Error;

#[derive(Debug, Clone, Copy, Default, ValueEnum)]
pub(super) enum CriterionArgument {
    /// The volume of the parameters' confidence ellipsoid; it does not depend on units.
    #[default]
    DOptimal,
    /// The condition number of the base regressor.
    Condition,
    /// Its smallest singular value.
    EOptimal,
    /// Hadamard's bound from the lengths of its columns; ignores dependence between columns.
    Hadamard,
}

impl CriterionArgument {
    /// How its columns count. Not every criterion has a use for columns of unit length.
    pub(super) fn scaling(self, unit_columns: bool) -> Result<Scaling, Error> {
        let refused = |reason: &str| Err(Error::Argument(reason.to_owned()));
        match self {
            _ if !unit_columns => Ok(Scaling::Raw),
            Self::Condition | Self::EOptimal => Ok(Scaling::UnitLength),
            Self::DOptimal => refused(
                "`--unit-columns` belongs to the condition number and the smallest singular value; add `--criterion condition` or \
                 `--criterion e-optimal`",
            ),
            Self::Hadamard => refused(
                "Hadamard's bound of columns of unit length is the same for every motion; remove `--unit-columns`",
            ),
        }
    }
}

impl From<CriterionArgument> for Criterion {
    fn from(argument: CriterionArgument) -> Self {
        match argument {
            CriterionArgument::DOptimal => Self::DOptimal,
            CriterionArgument::Condition => Self::Condition,
            CriterionArgument::EOptimal => Self::EOptimal,
            CriterionArgument::Hadamard => Self::Hadamard,
        }
    }
}
