//! `robot-model show`: the equations as people read them.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use robot_model_codegen::expr::Style;
use robot_model_codegen::show::{What, form, whole};

use crate::spec::compile_to_look_at;
use crate::{Error, output};

/// Show an arm's equations.
#[derive(Debug, Args)]
pub(crate) struct Show {
    /// The `.robot` file.
    spec: PathBuf,
    /// Which equations; without it the whole description.
    #[arg(long, value_enum)]
    what: Option<WhatArgument>,
    /// Notation.
    #[arg(long = "as", value_enum, default_value_t)]
    notation: Notation,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum WhatArgument {
    /// `M(q)`
    MassMatrix,
    /// `C(q, dq)`, by Christoffel symbols
    Coriolis,
    /// `G(q)`
    Gravity,
    /// `tau(q, dq, ddq)` with the declared effects
    InverseDynamics,
    /// `Y` with `tau = Y * standard`
    Regressor,
    /// `Y_b` with `tau = Y_b * beta`
    BaseRegressor,
    /// How `beta` is made of the standard parameters
    BaseParameters,
    /// Operations of the emitted functions
    Cost,
}

impl From<WhatArgument> for What {
    fn from(what: WhatArgument) -> Self {
        match what {
            WhatArgument::MassMatrix => Self::MassMatrix,
            WhatArgument::Coriolis => Self::CoriolisMatrix,
            WhatArgument::Gravity => Self::Gravity,
            WhatArgument::InverseDynamics => Self::InverseDynamics,
            WhatArgument::Regressor => Self::Regressor,
            WhatArgument::BaseRegressor => Self::BaseRegressor,
            WhatArgument::BaseParameters => Self::BaseParameters,
            WhatArgument::Cost => Self::Cost,
        }
    }
}

#[derive(Debug, Clone, Copy, Default, ValueEnum)]
enum Notation {
    /// Plain text
    #[default]
    Text,
    /// LaTeX
    Latex,
}

impl Show {
    pub(crate) fn run(&self) -> Result<(), Error> {
        let compiled = compile_to_look_at(&self.spec)?;
        let style = match self.notation {
            Notation::Text => Style::Text,
            Notation::Latex => Style::Latex,
        };
        output::print(&match self.what {
            Some(what) => form(&compiled, what.into(), style),
            None => whole(&compiled, style),
        })
    }
}
