//! `robot-model show`: the equations as people read them.

mod equation;
mod shared;

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use robot_model_codegen::Compiled;
use robot_model_codegen::expr::{ExprId, Style};

use crate::spec::compile;
use crate::{Error, output};
use equation::{Entry, Page};

/// Show an arm's equations.
#[derive(Debug, Args)]
pub(crate) struct Show {
    /// The `.robot` file.
    spec: PathBuf,
    /// Which equations; without it base parameters, mass matrix, Coriolis matrix and gravity.
    #[arg(long, value_enum)]
    what: Option<What>,
    /// Notation.
    #[arg(long = "as", value_enum, default_value_t)]
    notation: Notation,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum What {
    /// `M(q)`
    MassMatrix,
    /// `C(q, dq)`, Christoffel symbols
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
}

#[derive(Debug, Clone, Copy, Default, ValueEnum)]
enum Notation {
    /// Plain text
    #[default]
    Text,
    /// LaTeX, for a display in a document with amsmath
    Latex,
}

impl Show {
    pub(crate) fn run(&self) -> Result<(), Error> {
        let compiled = compile(&self.spec)?;
        let style = match self.notation {
            Notation::Text => Style::Text,
            Notation::Latex => Style::Latex,
        };
        let whats = match self.what {
            Some(what) => vec![what],
            None => vec![
                What::BaseParameters,
                What::MassMatrix,
                What::Coriolis,
                What::Gravity,
            ],
        };
        let pages: Vec<String> = whats
            .into_iter()
            .map(|what| what.page(&compiled, style))
            .collect();
        output::print(&pages.join("\n"))
    }
}

impl What {
    fn page(self, compiled: &Compiled, style: Style) -> String {
        let dynamics = &compiled.dynamics;
        let entries = match self {
            Self::BaseParameters => return equation::base_parameters(compiled, style),
            Self::MassMatrix => matrix("M", &dynamics.mass_matrix, true),
            Self::Coriolis => matrix("C", &dynamics.coriolis_matrix, false),
            Self::Gravity => vector("G", &dynamics.gravity),
            Self::InverseDynamics => vector("tau", &dynamics.inverse_dynamics),
            Self::Regressor => {
                let names: Vec<&str> = compiled
                    .standard
                    .iter()
                    .map(|parameter| parameter.name.as_str())
                    .collect();
                columns("Y", &names, compiled, &(0..names.len()).collect::<Vec<_>>())
            }
            Self::BaseRegressor => {
                let names: Vec<&str> = compiled.base.names.iter().map(String::as_str).collect();
                columns("Y_b", &names, compiled, &compiled.base.kept)
            }
        };
        Page {
            dag: &compiled.dag,
            names: compiled.names(),
            entries,
        }
        .render(style)
    }
}

fn matrix(symbol: &'static str, rows: &[Vec<ExprId>], symmetric: bool) -> Vec<Entry> {
    let mut entries = Vec::new();
    for (i, row) in rows.iter().enumerate() {
        let first = if symmetric { i } else { 0 };
        for (j, &value) in row.iter().enumerate().skip(first) {
            let place = vec![(i + 1).to_string(), (j + 1).to_string()];
            let mirrored =
                (symmetric && i != j).then(|| vec![(j + 1).to_string(), (i + 1).to_string()]);
            entries.push(Entry {
                symbol,
                place,
                mirrored,
                value,
            });
        }
    }
    entries
}

fn vector(symbol: &'static str, values: &[ExprId]) -> Vec<Entry> {
    let entry = |(i, &value): (usize, &ExprId)| Entry {
        symbol,
        place: vec![(i + 1).to_string()],
        mirrored: None,
        value,
    };
    values.iter().enumerate().map(entry).collect()
}

/// Regressor columns, one after the other; `parameters` are their standard parameters.
fn columns(
    symbol: &'static str,
    names: &[&str],
    compiled: &Compiled,
    parameters: &[usize],
) -> Vec<Entry> {
    let mut entries = Vec::new();
    for (name, &parameter) in names.iter().zip(parameters) {
        for (joint, row) in compiled.linear.regressor.iter().enumerate() {
            let place = vec![(joint + 1).to_string(), (*name).to_owned()];
            entries.push(Entry {
                symbol,
                place,
                mirrored: None,
                value: row[parameter],
            });
        }
    }
    entries
}
