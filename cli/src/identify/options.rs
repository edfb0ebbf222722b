//! Options of `identify`, and which of them belong together.

use clap::{Args, ValueEnum};
use robot_model::identify::{AtTurns, IdentifyError, Method, Weights};
use robot_model::signal::Bands;

use super::IdentifyArguments;
use crate::{Error, output};

#[derive(Debug, Clone, Copy, Default, ValueEnum)]
pub(super) enum MethodArgument {
    /// Ordinary least squares.
    #[value(alias = "ols")]
    Ls,
    /// Least squares weighted joint by joint.
    #[default]
    Wls,
    /// The same, with reduced weight of outliers.
    #[value(aliases = ["huber", "irls"])]
    Robust,
    /// Least squares weighted by each joint's residual, restricted to physically possible arms: positive masses and inertias, dissipative friction.
    Physical,
    /// Least squares weighted by each joint's residual, with the spec's nominal values as measurements.
    Ridge,
    /// Total least squares: columns have errors like the torque.
    Tls,
    /// Instrumental variables, with a test whether least squares is biased (Durbin, Wu, Hausman).
    Iv,
    /// Output error: the simulated arm must move like the measured one.
    OutputError,
}

impl MethodArgument {
    /// The method of least squares that it is; none where the arm is simulated.
    pub fn of_equations(self) -> Option<Method> {
        match self {
            Self::Ls => Some(Method::Ls),
            Self::Wls => Some(Method::Wls),
            Self::Robust => Some(Method::Robust),
            Self::Physical => Some(Method::Physical),
            Self::Ridge => Some(Method::Ridge),
            Self::Tls => Some(Method::Total),
            Self::Iv => Some(Method::Instrumental),
            Self::OutputError => None,
        }
    }
}

#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum WeightsArgument {
    /// The standard deviation of its residual.
    #[default]
    Residual,
    /// The norm of its torque.
    TorqueNorm,
    /// The largest magnitude of its torque.
    MaxTorque,
}

impl From<WeightsArgument> for Weights {
    fn from(weights: WeightsArgument) -> Self {
        match weights {
            WeightsArgument::Residual => Self::Residual,
            WeightsArgument::TorqueNorm => Self::TorqueNorm,
            WeightsArgument::MaxTorque => Self::MaxTorque,
        }
    }
}

#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(super) enum FormArgument {
    /// With accelerations; errors are of the raw torque.
    #[default]
    Acceleration,
    /// Without accelerations; errors are of the filtered torque.
    Filtered,
}

/// What becomes of rows where joints with dry friction turn; without an option by how much they move an estimate is in its deviations, and only
/// open curves of friction are looked for without them.
#[derive(Debug, Args)]
pub(crate) struct TurnOptions {
    /// Leave out rows near velocity reversals of joints with dry friction, where friction laws do not hold.
    #[arg(long, conflicts_with = "judge_turns")]
    pub leave_out_turns: bool,
    /// Leave out these rows only if that makes standard deviations at least a third smaller; for friction that follows its law.
    #[arg(long)]
    pub judge_turns: bool,
}

impl TurnOptions {
    pub(crate) const fn asked(&self) -> AtTurns {
        match (self.leave_out_turns, self.judge_turns) {
            (true, _) => AtTurns::LeftOut,
            (_, true) => AtTurns::Judged,
            _ => AtTurns::Kept,
        }
    }
}

/// Which rows of logs are fitted.
#[derive(Debug, Args)]
pub(super) struct RowOptions {
    #[command(flatten)]
    pub turns: TurnOptions,
    /// Use logs as they are, without removing spikes and held values.
    #[arg(long)]
    pub as_logged: bool,
}

pub(super) fn parse_corner(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(corner) if corner > 0.0 && corner.is_finite() => Ok(corner),
        _ => Err("write a positive number in rad/s, such as `60`".to_owned()),
    }
}

pub(super) fn parse_bands(text: &str) -> Result<Bands, String> {
    let numbers: Result<Vec<f64>, _> = text
        .split(',')
        .map(|part| part.trim().parse::<f64>())
        .collect();
    match numbers.as_deref() {
        Ok(all @ &[shared_hz, smooth_hz, wide_hz]) => {
            if all.iter().any(|band| !(*band > 0.0 && band.is_finite())) {
                return Err("write three numbers above zero, such as `10,30,90`".to_owned());
            }
            let bands = Bands {
                smooth_hz,
                wide_hz,
                shared_hz,
            };
            bands.check().map_err(|error| error.to_string())?;
            Ok(bands)
        }
        _ => Err("write three numbers, such as `10,30,90`".to_owned()),
    }
}

/// What `--prior` is, as it is told of where nominal values are used.
pub(crate) fn check_prior(prior: Option<f64>) -> Result<(), Error> {
    match prior.filter(|prior| !(*prior > 0.0 && prior.is_finite())) {
        Some(prior) => Err(IdentifyError::Prior { prior }.into()),
        None => Ok(()),
    }
}

pub(super) fn parse_mass(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(mass) if mass > 0.0 && mass.is_finite() => Ok(mass),
        _ => Err("write a positive number in kg, such as `2.5`".to_owned()),
    }
}

pub(super) fn parse_center(text: &str) -> Result<[f64; 3], String> {
    let numbers = text.split(',').map(|part| part.trim().parse::<f64>());
    let numbers: Result<Vec<f64>, _> = numbers.collect();
    match numbers.as_deref() {
        Ok(&[x, y, z]) if [x, y, z].iter().all(|x| x.is_finite()) => Ok([x, y, z]),
        _ => Err("write three numbers in m, such as `0,0,0.12`".to_owned()),
    }
}

impl IdentifyArguments {
    /// Options that the method does not read are mistakes.
    pub(super) fn check_options(&self) -> Result<(), Error> {
        let refuse = |what: &str| Err(Error::Argument(what.to_owned()));
        check_prior(self.prior)?;
        let Some(method) = self.method.of_equations() else {
            return self.check_simulation();
        };
        if let Some(option) = self.output_error.given() {
            return refuse(&format!("`{option}` belongs to `--method output-error`"));
        }
        if !method.takes_weights() && self.weights != WeightsArgument::Residual {
            return refuse(&format!(
                "`--weights` belongs to `wls`, `robust`, `tls` and `iv`; `{}` has its own",
                method.name()
            ));
        }
        if !matches!(method, Method::Ls | Method::Wls | Method::Robust) || self.factor.is_some() {
            let asked = [
                ("--bootstrap", self.bootstrap.is_some()),
                ("--essential", self.essential),
                ("--payload", !self.payload.is_empty()),
            ];
            if let Some((option, _)) = asked.into_iter().find(|(_, is_given)| *is_given) {
                return refuse(&format!(
                    "`{option}` belongs to `--method ls`, `wls` and `robust`, and needs the logs themselves, not a factor"
                ));
            }
        }
        if !self.payload.is_empty() {
            let asked = [
                ("--form filtered", self.form == FormArgument::Filtered),
                ("--bootstrap", self.bootstrap.is_some()),
                ("--essential", self.essential),
            ];
            if let Some((option, _)) = asked.into_iter().find(|(_, is_given)| *is_given) {
                return refuse(&format!("`{option}` and `--payload` do not go together"));
            }
        }
        if self.factor.is_some() {
            let single = [Method::Robust, Method::Total, Method::Instrumental];
            if single.contains(&method) {
                return refuse(
                    "`--factor` works with `--method ls`, `wls`, `ridge` and `physical`: the others need single samples",
                );
            }
        }
        if self.prior.is_some() && method != Method::Ridge {
            return refuse("`--prior` belongs to `--method ridge`");
        }
        if !self.instruments.is_empty() && method != Method::Instrumental {
            return refuse("`--instruments` belongs to `--method iv`");
        }
        if method == Method::Instrumental && self.instruments.len() != self.logs.len() {
            return refuse(&format!(
                "`--method iv` needs a noise-free motion for each log, `--instruments MOTION ..`: {} for {}; give the commanded motion, or \
                 the log that `simulate` makes of it with the parameters of `--method wls`",
                output::counted(self.instruments.len(), "motion"),
                output::counted(self.logs.len(), "log")
            ));
        }
        Ok(())
    }

    /// The same where the arm is simulated.
    fn check_simulation(&self) -> Result<(), Error> {
        self.output_error.check()?;
        let others = [
            ("--weights", self.weights != WeightsArgument::Residual),
            ("--prior", self.prior.is_some()),
            ("--instruments", !self.instruments.is_empty()),
            ("--form filtered", self.form == FormArgument::Filtered),
            ("--factor", self.factor.is_some()),
            ("--bootstrap", self.bootstrap.is_some()),
            ("--essential", self.essential),
            ("--payload", !self.payload.is_empty()),
            ("--partial", self.partial),
            ("--leave-out-turns", self.rows.turns.leave_out_turns),
            ("--judge-turns", self.rows.turns.judge_turns),
        ];
        match others.into_iter().find(|(_, is_given)| *is_given) {
            None => Ok(()),
            Some((option, _)) => Err(Error::Argument(format!(
                "`{option}` belongs to methods with equations; `output-error` simulates"
            ))),
        }
    }
}
