//! `robot-model show`: the equations as people read them.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use robot_model_codegen::expr::Style;
use robot_model_codegen::show::{What, document, form, whole};

use crate::spec::compile_to_look_at;
use crate::{Error, output};

/// Show an arm's equations.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  robot-model show arm.robot --what mass-matrix
  robot-model show arm.robot --as latex > arm.tex
  robot-model show arm.robot --what base-parameters")]
pub(crate) struct Show {
    /// The `.robot` file.
    spec: PathBuf,
    /// Equations to show; default: all, in LaTeX a whole document.
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
    /// `C dq + G`
    Bias,
    /// `tau(q, dq, ddq)` with the declared effects
    InverseDynamics,
    /// `A` and `b` of `A ddq = tau - b`
    ForwardDynamics,
    /// `d tau / dq` and `d tau / d dq`
    Slopes,
    /// `Y` with `tau = Y * standard`
    Regressor,
    /// `Y_b` with `tau = Y_b * beta`, without the parts that the spec fixes
    BaseRegressor,
    /// `Y_p` and `Y_h` of `L{tau} = Y_L * standard`, `Y_L = w (Y_p - L{Y_p}) - L{Y_h}`, `L(s) = w / (s + w)`
    FilteredRegressor,
    /// The same with `L{tau} = Y_L * beta`, without the parts that the spec fixes
    BaseFilteredRegressor,
    /// Kinetic and potential energy of the rigid body
    Energies,
    /// Poses `R1, p1, ..` of the links in the base frame, or positions of the points that the spec names
    ForwardKinematics,
    /// Velocity and angular velocity of the tip per joint velocity, or of the points
    Jacobian,
    /// Rates of the internal states of effects
    StateRates,
    /// Link positions that differ from `q`, and delays of logged torques
    Measurement,
    /// `beta` as sums of standard parameters
    BaseParameters,
    /// Operation counts of the emitted functions
    Cost,
}

impl From<WhatArgument> for What {
    fn from(what: WhatArgument) -> Self {
        match what {
            WhatArgument::MassMatrix => Self::MassMatrix,
            WhatArgument::Coriolis => Self::CoriolisMatrix,
            WhatArgument::Gravity => Self::Gravity,
            WhatArgument::Bias => Self::Bias,
            WhatArgument::InverseDynamics => Self::InverseDynamics,
            WhatArgument::ForwardDynamics => Self::ForwardDynamics,
            WhatArgument::Slopes => Self::Slopes,
            WhatArgument::Regressor => Self::Regressor,
            WhatArgument::BaseRegressor => Self::BaseRegressor,
            WhatArgument::FilteredRegressor => Self::FilteredRegressor,
            WhatArgument::BaseFilteredRegressor => Self::BaseFilteredRegressor,
            WhatArgument::Energies => Self::Energies,
            WhatArgument::ForwardKinematics => Self::ForwardKinematics,
            WhatArgument::Jacobian => Self::Jacobian,
            WhatArgument::StateRates => Self::StateRates,
            WhatArgument::Measurement => Self::Measurement,
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
        let has_places = compiled.kinematics.is_some() || !compiled.points.is_empty();
        if let (Some(WhatArgument::ForwardKinematics | WhatArgument::Jacobian), false) =
            (self.what, has_places)
        {
            return Err(Error::Argument(format!(
                "{}: the robot has no points, so its position is unknown; write `point tip = [x, y, z];`",
                compiled.model.source
            )));
        }
        let style = match self.notation {
            Notation::Text => Style::Text,
            Notation::Latex => Style::Latex,
        };
        output::print(&match (self.what, style) {
            (Some(what), _) => form(&compiled, what.into(), style),
            (None, Style::Text) => whole(&compiled),
            (None, Style::Latex) => document(&compiled),
        })
    }
}
